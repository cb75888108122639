#pragma once
/// \file
/// Collision store: a scene of any size on disk. store_build.h builds it once, pager.h moves bodies in it in fixed
/// memory.
///
///     const auto store = roam::Store::open("dam.roam");
///     std::cout << store->info().triangles << " triangles in " << store->info().bounds.size().x << " m\n";
///     roam::Pager pager(store, {.memory = 64 << 20});
///
/// Target roam::store. A store is a folder, here or on a web server; docs/format.md describes its files. They never
/// change once written: they are named by their SHA-256, and the file CURRENT names the manifest in force. An open
/// store holds a lock on its manifest, and stays readable while a new one is built in its place. The XXH3 of a tile or
/// page is checked before it is decoded. Any number of threads and processes may read a store.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"
#include "roam/space.h"

namespace roam {

/// A user's secret key for authentication codes: a code of this key in a store's manifest shows that somebody with the
/// key built or adopted the store. Take 32 bytes from a cryptographic generator, and keep them in a file that only the
/// user can read.
struct StoreKey {
  std::array<std::byte, 32> bytes{};
};

/// Contents and size of a store.
struct StoreInfo {
  std::uint32_t format = 0;  ///< version of the format
  std::uint64_t triangles = 0;
  std::uint64_t objects = 0;
  std::uint64_t tiles = 0;
  std::uint64_t pages = 0;  ///< of the index
  std::uint64_t packs = 0;
  std::uint64_t bytes = 0;           ///< of the manifest and all files that it names
  std::uint64_t geometry_bytes = 0;  ///< of the tiles: vertices, triangles, trees
  std::uint64_t number_bytes = 0;    ///< of the map from stored to source triangles
  std::uint64_t resident_bytes = 0;  ///< of all tiles in memory
  Box bounds;                        ///< of the source triangles
  double largest_error = 0.0;        ///< m: largest distance of a stored vertex from its source
  bool lossless = false;
  std::string hash;           ///< SHA-256 of the manifest, 64 hexadecimal digits; covers the whole store
  std::string geometry_hash;  ///< of the quantized triangles in any order, 16 hexadecimal digits
};

/// The source of a stored triangle.
struct SourceTriangle {
  std::string part;          ///< name of the file or tile, without the folders in which the scene lies
  std::uint64_t number = 0;  ///< within the part, in the order of the file
  TriangleId scene = 0;      ///< within the scene: the number that World::build gives it after import_scene
  std::string object;        ///< name; may be empty
};

/// How a store is read from a web server, by HTTP or HTTPS: with libcurl, which is loaded then. Proxies
/// (http_proxy, https_proxy, no_proxy), ~/.netrc and CURL_CA_BUNDLE hold as for curl. Only files of the store's folder
/// are requested.
struct WebAccess {
  /// Part of a signed address that is appended to each request after a "?". A secret: it is in no message and no cache.
  std::string query;
  bool redirects = false;                  ///< whether redirects to other hosts and folders are followed
  double patience = 20.0;                  ///< s, 0.1 to 3600: how long a failing request is tried again
  std::filesystem::path cache;             ///< file for a cache, which processes may share; empty: none
  std::uint64_t cache_bytes = 1ull << 30;  ///< size of that file, >= 4 MiB; one of another size becomes empty
};

/// An open store. Holds the manifest in memory; reads tiles and pages on demand.
class Store {
 public:
  /// Bytes; enough for the manifest of 10^10 triangles or 200,000 parts.
  static constexpr std::uint64_t usual_memory = 256ull << 20;
  /// `folder` may be an address, "https://host/dam.roam", perhaps with a query. `memory`: limit for the manifest,
  /// bytes. Throws roam::Error if there is no store, its format is newer than this library, its manifest is damaged or
  /// too large, or the web server does not send it. An open store on a web server stays what it was when it was opened.
  [[nodiscard]] static std::shared_ptr<const Store> open(const std::filesystem::path& folder,
                                                         std::uint64_t memory = usual_memory,
                                                         const WebAccess& web = {});
  /// Whether a text begins with http:// or https://: open() takes it for an address.
  [[nodiscard]] static bool is_address(std::string_view text);
  /// Whether the folder holds a file CURRENT, or is an address.
  [[nodiscard]] static bool is_store(const std::filesystem::path& folder);
  ~Store();

  [[nodiscard]] const StoreInfo& info() const;
  /// The folder as passed to open(), or the address without its query, for messages.
  [[nodiscard]] const std::string& name() const;
  /// Whether the manifest has an authentication code of this key. The manifest holds the SHA-256 of all other files;
  /// only verify_store compares them. Returns false if the code is damaged or cannot be read.
  [[nodiscard]] bool is_authentic(const StoreKey& key) const;

  // The functions below read from disk or network and allocate: not for a thread that moves a body.

  /// Calls f with the stored triangles, and their numbers, of each tile whose box meets `box`. Throws roam::Error if
  /// one cannot be read or is damaged, with tile and position. With `missing`, passes over such pages and tiles, and
  /// calls it with a sentence for each.
  void for_each_triangle(const Box& box,
                         const std::function<void(std::span<const Triangle>, std::span<const TriangleId>)>& f,
                         const std::function<void(const std::string&)>& missing = {}) const;
  /// The centres of up to `count` tiles, spread evenly over all tiles, so that they are dense where triangles are
  /// dense.
  [[nodiscard]] std::vector<Vec3> sample(std::uint64_t count) const;
  /// Throws roam::Error if it cannot be read, or if `triangle` is not of this store.
  [[nodiscard]] SourceTriangle source(TriangleId triangle) const;
  /// SourceTriangle::scene alone, which is faster.
  [[nodiscard]] TriangleId scene_triangle(TriangleId triangle) const;

  struct State;  // for the rooms of this library alone
  explicit Store(std::unique_ptr<State> state);
  [[nodiscard]] const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// Damage in a store.
struct StoreDamage {
  std::string what;  ///< "tile 17 of page 3 (its box)", "page 3 (its box)" or "packs/0123abcd....pack"
  std::string why;
  Box where;  ///< solid because of it; empty: unknown
};

struct StoreVerification {
  bool complete = true;     ///< false: its first build has not ended; nothing was checked
  std::uint64_t bytes = 0;  ///< read and hashed
  std::uint64_t tiles = 0;  ///< decoded and checked
  std::vector<StoreDamage> damage;

  [[nodiscard]] bool whole() const { return complete && damage.empty(); }
};

/// Reads every byte of a store and compares it with the manifest: SHA-256 of files, XXH3 of tiles and pages, counts,
/// boxes, geometry hash. Decodes every tile. Takes at most Store::usual_memory and 20 MiB a core. `progress` gets bytes
/// done and bytes in all; if it returns false, roam::Cancelled is thrown. If CURRENT or the manifest is damaged, only
/// that is reported and the rest is not checked. Throws roam::Error if it is no store, of a newer format, or not
/// readable.
[[nodiscard]] StoreVerification verify_store(const std::filesystem::path& folder,
                                             const std::function<bool(std::uint64_t, std::uint64_t)>& progress = {},
                                             const WebAccess& web = {});

}  // namespace roam
