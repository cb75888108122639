#pragma once
/// \file
/// Building of collision stores from scenes of any size, in bounded memory. Target roam::store.
///
///     roam::build_store({.scene = {"Data/"}, .output = "dam.roam", .memory = 1ull << 30});
///
/// A build has three steps; build_store runs all of them. On many machines another one may come before them:
///
///   read_share    reads some parts of the scene into sorted runs in the store's scratch folder, for plan_store
///   plan_store    reads the other parts, one by one, and divides the scene into shards: ranges of the Morton curve of
///                 about a million triangles each
///   build_task    builds some of the shards, a task of the plan; independent of all others, on any machine that sees
///                 the folder
///   merge_store   checks that all shards are there, writes the manifest, publishes it by rename, removes the scratch
///
/// Each step may end at any moment, also by a power cut, and be run again: complete work is kept. The result is the
/// same to the last byte for any number of threads, tasks and machines, and any memory. Unchanged files and tiles of a
/// scene are not read again, and their shards are not built again.

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

/// Progress of a build.
struct StoreBuildProgress {
  enum class Step : std::uint8_t { read, plan, shards, merge };
  Step step = Step::read;
  std::uint64_t bytes_done = 0, bytes_total = 0;          ///< of the scene's files, while reading
  std::uint64_t triangles_done = 0, triangles_total = 0;  ///< of this step; total 0: unknown
  std::uint64_t bytes_written = 0;                        ///< of the store
};

struct StoreBuildOptions {
  std::vector<std::filesystem::path> scene = {};  ///< files and folders, as for import_scene
  std::filesystem::path output = {};              ///< the store's folder
  ImportOptions import = {};                      ///< `progress` and `memory_limit` are not used
  std::uint64_t memory = 1ull << 30;              ///< bytes, >= least_memory: of this process and its readers together
  int threads = 0;                                ///< 0: one per core
  std::uint64_t tasks = 0;                        ///< of the plan; 0: as many as are equally long, at most 1000. Also
                                                  ///< the shares of read_share
  bool lossless = false;                          ///< as BuildOptions::lossless
  /// With a key, the store gets an authentication code (Store::is_authentic). An older store in `output` without a code
  /// of the same key is refused, and unfinished work without one is done again. All steps need the same
  /// key. Without a key, everything in `output` is trusted: only for folders that nobody else can write.
  std::optional<StoreKey> key{};
  /// With a key: trusts the store in `output`, whoever built it, and gives it a code of the key.
  bool adopt = false;
  /// Whether `output` itself may be a symbolic link. Its parent folders always may.
  bool through_link = true;
  /// Shards nearest to this position are built first. Does not change the result.
  std::optional<Vec3> nearest_first{};
  /// Called from one thread at a time, several times a second. If it returns false, roam::Cancelled is thrown.
  std::function<bool(const StoreBuildProgress&)> progress{};

  static constexpr std::uint64_t least_memory = 256ull << 20;
};

/// The work of a build. Each step clears the report that it is given; only its seconds are added to those there.
struct StoreBuildReport {
  bool unchanged = false;          ///< the store was up to date: nothing was done
  std::uint64_t triangles = 0;     ///< of the scene
  std::uint64_t shards = 0;        ///< of the store
  std::uint64_t shards_built = 0;  ///< by this call
  // The plan has these; all are 0 without a plan.
  std::uint64_t shards_to_build = 0, triangles_to_build = 0;
  std::uint64_t tasks = 0;
  std::uint64_t longest_task = 0;  ///< triangles
  std::uint64_t task_shards = 0;   ///< of the task of build_task
  std::uint64_t share_parts = 0;   ///< of the share of read_share
  std::uint64_t parts = 0;         ///< of the scene
  std::uint64_t parts_read = 0;    ///< by this call
  double read_seconds = 0.0, plan_seconds = 0.0, shard_seconds = 0.0, merge_seconds = 0.0;
  std::vector<std::string> notes;  ///< sentences for the user, with those of the import
  StoreInfo store;                 ///< as published, or `unchanged`
};

/// The plan has no task, or the scene no share, of this number.
class NoSuchTask : public Error {
 public:
  using Error::Error;
};

/// No build is planned: it has not begun, or its store is complete.
class NothingPlanned : public Error {
 public:
  using Error::Error;
};

/// Runs plan_store, build_task for each task, and merge_store. If a shard was damaged before the merge, plans a second
/// time, and builds it again; the report has the numbers of the second plan. Throws as they do.
StoreBuildReport build_store(const StoreBuildOptions& options);

/// Reads the changed parts of share `i` of the scene, 0 <= i < `options.tasks`. To read all of each share takes about
/// equally long; a part is never divided. Like build_task it may run several times, also at once, on any machines, and
/// beside other builds of the store. Nothing depends on it: plan_store reads each part of which the files here are
/// missing, damaged, or older than the scene. Throws NoSuchTask, and as plan_store.
void read_share(const StoreBuildOptions& options, std::uint64_t i, StoreBuildReport& report);

/// Reads changed parts, and those that share a shard with them, divides the scene into shards, and shares those that
/// must be built out among tasks, about equally long. Returns the number of tasks; 0 if `unchanged`. Planning again
/// gives the same plan, and keeps shards that are built; another number of tasks only shares them out anew. Throws
/// roam::Error if the scene cannot be read, the folder is neither empty nor a store, another build works on it (named
/// by its process), memory or disk are too small, or the store has no code of the key. Throws roam::Cancelled.
std::uint64_t plan_store(const StoreBuildOptions& options, StoreBuildReport& report);

/// Builds the shards of task `i` of the plan in `options.output`, 0 <= i < plan_store(). Uses `key`, `memory`,
/// `threads` and `progress`. Leaves out shards that are there. May run several times, also at once, on any machines:
/// each file is written under a name of its own, and renamed. Throws NothingPlanned, NoSuchTask, and roam::Error if a
/// run of the plan is missing.
void build_task(const StoreBuildOptions& options, std::uint64_t i, StoreBuildReport& report);

/// Checks every byte that was built, and publishes the store. Throws NothingPlanned, and roam::Error with the tasks of
/// which shards are missing or damaged.
void merge_store(const StoreBuildOptions& options, StoreBuildReport& report);

/// Builds the damaged shards again (verify_store) from the same scene, and publishes. The store knows how its scene was
/// read: `lossless`, and `up`, `unit` and `ignore` of `import`, are not used. A damaged manifest is replaced by its
/// spare. Throws roam::Error if the scene is another one, the first build has not ended, no copy of the manifest is
/// whole, or a pack changes meanwhile. A store that is not authentic stays so.
StoreBuildReport repair_store(const StoreBuildOptions& options);

/// The work of publish_store.
struct StorePublication {
  std::string hash;           ///< StoreInfo::hash
  bool unchanged = false;     ///< it was published already, and no file was missing or of a wrong size
  std::uint64_t files = 0;    ///< copied
  std::uint64_t bytes = 0;    ///< copied
  std::uint64_t present = 0;  ///< files that were there already
};

/// Copies a store, from a folder or a web server, into a folder from which a web server serves it. The folder is empty,
/// not there, or another store, and does not lie in the store; it becomes a store. Readers see the old store or the new
/// one, each whole: every file is written under a temporary name, compared with its SHA-256 and renamed, CURRENT last.
/// Files of the version before stay, for those who walk in it; older ones are removed. Files of the right size are not
/// read again. `progress` gets bytes done and bytes in all; if it returns false, roam::Cancelled is thrown. Throws
/// roam::Error if a file cannot be read, is damaged or cannot be written. Copied files stay then, and the next call
/// continues.
StorePublication publish_store(const std::filesystem::path& store, const std::filesystem::path& folder,
                               const std::function<bool(std::uint64_t, std::uint64_t)>& progress = {},
                               const WebAccess& web = {});

}  // namespace roam
