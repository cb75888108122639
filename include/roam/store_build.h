#pragma once
/// \file
/// Makes a collision store of a scene of any size, in bounded memory. Target roam::store.
///
///     roam::build_store({.scene = {"Data/"}, .output = "dam.roam", .memory = 1ull << 30});
///
/// A build is three steps, each of which may be ended at any moment, by a power cut too, and run again: what is
/// complete is kept, what is not is made again, and the result is the same to the last byte, for any number of threads
/// and any memory limit.
///
///   plan_store    reads the scene, part by part, into sorted runs in the store's scratch folder; counts; decides the
///                 shards: ranges of the Morton curve of about a million triangles each
///   build_shard   makes the pack of one shard; independent of all others, on any machine that sees the folder
///   merge_store   checks that all shards are there, writes the manifest, publishes it by rename, removes the scratch
///
/// build_store runs the three. A part of a scene (a file, or one tile of a folder of photogrammetry) that has not
/// changed is not read again, and a shard whose parts have not changed is not built again.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/import.h"
#include "roam/math.h"
#include "roam/store.h"

namespace roam {

/// How far a build has come.
struct StoreBuildProgress {
  enum class Step : std::uint8_t { read, plan, shards, merge };
  Step step = Step::read;
  std::uint64_t bytes_done = 0, bytes_total = 0;          ///< of the scene's files, while reading
  std::uint64_t triangles_done = 0, triangles_total = 0;  ///< of this step; total 0: not known yet
  std::uint64_t bytes_written = 0;                        ///< of the store
};

struct StoreBuildOptions {
  std::vector<std::filesystem::path> scene = {};  ///< files and folders, as import_scene takes them
  std::filesystem::path output = {};              ///< the store's folder
  ImportOptions import = {};                      ///< `progress` and `memory_limit` are not used
  std::uint64_t memory = 1ull << 30;              ///< bytes, >= least_memory: of this process and its readers together
  int threads = 0;                                ///< 0: one per core
  bool lossless = false;                          ///< as BuildOptions::lossless
  /// With a key the store gets an authentication code (Store::is_authentic), and nothing in the output is built upon
  /// that has none of the same key: a store there is refused (NotAuthentic), what an ended build left is made again.
  /// All steps of a build need the same key. Without a key everything in the output is built upon: do so only where
  /// nobody else can have put anything there.
  std::optional<StoreKey> key{};
  /// With a key: the store that is there gets a code of it, whoever built it, and is built upon.
  bool adopt = false;
  /// Whether `output` may be a symbolic link. The folders above it may be.
  bool through_link = true;
  /// Shards whose boxes are nearest to this place are built first; does not change the result.
  std::optional<Vec3> nearest_first{};
  /// Called from one thread at a time, several times a second. Returning false ends the build: roam::Cancelled.
  std::function<bool(const StoreBuildProgress&)> progress{};

  static constexpr std::uint64_t least_memory = 256ull << 20;
};

/// What a build did.
struct StoreBuildReport {
  bool unchanged = false;          ///< the store was there and is of this very scene: nothing was done
  std::uint64_t triangles = 0;     ///< of the scene
  std::uint64_t shards = 0;        ///< of the store
  std::uint64_t shards_built = 0;  ///< now; the others were there
  std::uint64_t parts = 0;         ///< of the scene
  std::uint64_t parts_read = 0;    ///< now; the others had not changed
  double read_seconds = 0.0, plan_seconds = 0.0, shard_seconds = 0.0, merge_seconds = 0.0;
  std::vector<std::string> notes;  ///< whole sentences for the user; those of the import among them
  StoreInfo store;                 ///< as published, or `unchanged`; read before the lock was given up
};

/// There is a store in the output that has no authentication code of the key.
class NotAuthentic : public Error {
 public:
  using Error::Error;
};

/// Plans, builds and merges. Throws what the three throw.
StoreBuildReport build_store(const StoreBuildOptions& options);

/// Reads what has changed and decides the shards. Returns how many shards the store that is in force does not have; 0
/// with `unchanged` when it is up to date. Planning again gives the same plan with the same numbers; shards that are
/// built by then stay, and building them again is done at once. Throws roam::Error for a scene that cannot be read, a
/// folder that is no store and not empty, a store there that is not authentic (NotAuthentic), another build at work on
/// it (naming its process), too little memory or disk; roam::Cancelled.
std::uint64_t plan_store(const StoreBuildOptions& options, StoreBuildReport& report);

/// Builds shard `i` of the plan in `options.output`, 0 <= i < what plan_store returned. Of the other options only
/// memory, threads and progress are used. Does nothing when it is there. Throws roam::Error where there is no plan or
/// what it needs is missing.
void build_shard(const StoreBuildOptions& options, std::uint64_t i, StoreBuildReport& report);

/// Publishes the store. Throws roam::Error naming the shards that are missing or whose packs are not what their names
/// say.
void merge_store(const StoreBuildOptions& options, StoreBuildReport& report);

/// Builds again just the shards in which verify_store finds damage, from the scene that the store was made of, and
/// publishes. The scene is read as it was for the store, which knows that: `lossless`, and up, unit and ignore of
/// `import`, are not used. A damaged manifest is taken from its spare. Throws roam::Error when the scene is not the one
/// that the store was made of, where the build of it has not ended, and where no copy of the manifest is whole: then
/// nothing tells what the store was. A store that is not authentic is repaired, too, and stays so.
StoreBuildReport repair_store(const StoreBuildOptions& options);

}  // namespace roam
