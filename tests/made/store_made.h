#pragma once
/// \file
/// Small stores made by hand, for tests and benchmarks: the tiles of World::build, in pages of any size.

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "index/partition.h"
#include "index/tile_builder.h"
#include "roam/store.h"
#include "store/files.h"
#include "store/manifest.h"
#include "store/page.h"
#include "store/part.h"

namespace made {

/// A folder that goes with the test. Nobody can make it first, or a link in its place.
class Folder {
 public:
  explicit Folder(const std::string& name) {
    std::string path = (std::filesystem::temp_directory_path() / ("roam_" + name + "_XXXXXX")).string();
    if (::mkdtemp(path.data()) == nullptr) throw roam::Error("cannot make the folder " + path);
    path_ = path;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

struct StoreOptions {
  bool lossless = false;
  std::size_t page_tiles = 64;
  /// Triangles of a tile at most; 0: as many as World::build puts into one.
  std::uint32_t tile_triangles = 0;
  /// Changes the entry of each tile, as a stranger might.
  std::function<void(roam::store::TileEntry&)> change{};
};

/// Marks every cell that the box of a triangle, grown by `error`, meets.
inline void mark(roam::store::TileEntry& tile, const roam::Triangle& triangle, double error) {
  roam::Box box;
  for (const roam::Vec3& v : triangle) box.include(v);
  int from[3], to[3];
  for (int k = 0; k < 3; ++k) {
    const double extent = tile.upper[k] - tile.lower[k];
    const auto cell = [&](double x) {
      return extent > 0.0 ? static_cast<int>(std::clamp((x - tile.lower[k]) / extent * 8.0, 0.0, 7.0)) : 0;
    };
    from[k] = cell(box.lower[k] - error - 1e-9);
    to[k] = extent > 0.0 ? cell(box.upper[k] + error + 1e-9) : 7;
  }
  for (int z = from[2]; z <= to[2]; ++z) {
    for (int y = from[1]; y <= to[1]; ++y) {
      for (int x = from[0]; x <= to[0]; ++x) tile.mask[z] |= std::uint64_t{1} << (x + 8 * y);
    }
  }
}

/// The same for a triangle as large as it likes: in pieces, so that little is marked in vain.
inline void mark_finely(roam::store::TileEntry& tile, const roam::Triangle& t, double error, int depth = 0) {
  const roam::Vec3 size(tile.upper[0] - tile.lower[0], tile.upper[1] - tile.lower[1], tile.upper[2] - tile.lower[2]);
  roam::Box box;
  for (const roam::Vec3& v : t) box.include(v);
  bool small = true;
  for (int k = 0; k < 3; ++k) small = small && box.upper[k] - box.lower[k] <= size[k] / 8.0;
  if (small || depth == 4) return mark(tile, t, error);
  const roam::Vec3 a = 0.5 * (t[0] + t[1]), b = 0.5 * (t[1] + t[2]), c = 0.5 * (t[2] + t[0]);
  for (const roam::Triangle& part :
       {roam::Triangle{t[0], a, c}, roam::Triangle{a, t[1], b}, roam::Triangle{c, b, t[2]}, roam::Triangle{a, b, c}}) {
    mark_finely(tile, part, error, depth + 1);
  }
}

/// The tiles of a scene as blobs of a pack, and what is said of them.
class Maker {
 public:
  Maker(const std::filesystem::path& folder, std::span<const roam::Mesh> meshes, const StoreOptions& options)
      : folder_(folder), options_(options), soup_(meshes), pack_((make_folders(folder), folder)) {}

  void run() {
    namespace store = roam::store;
    const auto parts = roam::index::partition(soup_, options_.lossless, [](double) {});
    std::vector<store::TileEntry> page;
    for (const auto& run : parts.tiles) {
      const std::uint32_t most = options_.tile_triangles > 0 ? options_.tile_triangles : run.end - run.begin;
      for (std::uint32_t begin = run.begin; begin < run.end; begin += most) {
        page.push_back(add_tile({parts.order.data() + begin, parts.order.data() + std::min(begin + most, run.end)}));
        if (page.size() == options_.page_tiles) add_page(page);
      }
    }
    if (!page.empty()) add_page(page);
    publish();
  }

 private:
  static void make_folders(const std::filesystem::path& folder) {
    for (const char* name : {"packs", "parts", "manifests"}) std::filesystem::create_directories(folder / name);
  }

  roam::store::TileEntry add_tile(std::span<const std::uint32_t> numbers) {
    namespace store = roam::store;
    std::vector<std::uint32_t> ids(numbers.begin(), numbers.end());
    std::sort(ids.begin(), ids.end());
    auto tile = roam::index::build_tile(soup_, ids, options_.lossless);
    const std::vector<std::byte> coded = store::encode_tile(tile);
    std::vector<store::SourceNumber> sources;
    for (const auto& leaf : tile.leaves) {
      for (int i = 0; i < leaf.triangle_count; ++i) {
        sources.push_back(
            {store::xxh3(std::as_bytes(std::span(part_))), roam::index::read_id(tile.ids.data(), leaf, i)});
      }
    }
    const std::vector<std::byte> coded_numbers = store::encode_numbers(sources);
    store::TileEntry e{};
    const double error = double(tile.tile.error);
    for (int k = 0; k < 3; ++k) {
      e.origin[k] = tile.tile.origin[k];
      e.lower[k] = tile.bounds.lower[k] - error;
      e.upper[k] = tile.bounds.upper[k] + error;
    }
    e.step = tile.tile.step;
    e.error = tile.tile.error;
    e.fine_error = tile.tile.fine_error;
    const store::TileShape shape = store::shape_of(tile);
    e.triangles = shape.triangles;
    e.nodes = static_cast<std::uint16_t>(shape.nodes);
    e.leaves = static_cast<std::uint16_t>(shape.leaves);
    e.fine = shape.fine ? 1 : 0;
    e.bytes = static_cast<std::uint32_t>(coded.size());
    e.number_bytes = static_cast<std::uint32_t>(coded_numbers.size());
    e.hash = store::xxh3(coded);
    e.number_hash = store::xxh3(coded_numbers);
    e.geometry_hash = store::geometry_hash(tile.tile, tile.leaves, tile.fine_leaves);
    soup_.for_each(ids, [&](std::size_t, const roam::Triangle& t) { mark_finely(e, t, error); });
    if (options_.change) options_.change(e);
    std::vector<std::byte> blob = coded;
    blob.insert(blob.end(), coded_numbers.begin(), coded_numbers.end());
    e.offset = pack_.add(blob);
    shard_.triangles += e.triangles;
    ++shard_.tiles;
    shard_.geometry_bytes += e.bytes;
    shard_.number_bytes += e.number_bytes;
    shard_.resident_bytes += shape.bytes();
    shard_.largest_error = std::max(shard_.largest_error, double(e.fine_error));
    shard_.geometry_hash += e.geometry_hash;
    return e;
  }

  void add_page(std::vector<roam::store::TileEntry>& tiles) {
    const auto page = roam::store::encode_page(tiles);
    roam::store::PageRef ref;
    for (const auto& t : tiles) {
      ref.box.include({t.lower[0], t.lower[1], t.lower[2]});
      ref.box.include({t.upper[0], t.upper[1], t.upper[2]});
    }
    ref.bytes = static_cast<std::uint32_t>(page.bytes.size());
    ref.hash = roam::store::xxh3(page.bytes);
    ref.tiles = static_cast<std::uint32_t>(tiles.size());
    ref.offset = pack_.add(page.bytes);
    shard_.pages.push_back(ref);
    tiles.clear();
  }

  void publish() {
    namespace store = roam::store;
    shard_.bytes = pack_.size();
    shard_.key = std::string(64, '0');
    shard_.bounds = soup_.bounds();
    shard_.pack = pack_.commit();
    store::PartFile part;
    part.triangles = soup_.size();
    part.cells.push_back({0, soup_.size()});
    for (std::size_t m = 0; m < soup_.meshes().size(); ++m) {
      part.objects.push_back({soup_.first()[m], soup_.meshes()[m].name});
    }
    const auto bytes = store::encode_part(part);
    store::NewFile file(folder_, "parts/made.part");
    file.write(bytes);
    store::Manifest manifest;
    manifest.parts.push_back({part_, "made", file.commit_by_hash(), bytes.size(), soup_.size(),
                              static_cast<std::uint64_t>(soup_.meshes().size())});
    manifest.lossless = options_.lossless;
    manifest.bounds = shard_.bounds;
    manifest.geometry_hash = shard_.geometry_hash;
    manifest.shards.push_back(shard_);
    store::publish(folder_, manifest);
  }

  std::filesystem::path folder_;
  StoreOptions options_;
  roam::index::Soup soup_;
  roam::store::PackWriter pack_;
  roam::store::ShardInfo shard_;
  std::string part_ = "scene";
};

/// Makes a store of the meshes in `folder` and opens it.
inline std::shared_ptr<const roam::Store> store(const std::filesystem::path& folder, std::span<const roam::Mesh> meshes,
                                                const StoreOptions& options = {}) {
  Maker(folder, meshes, options).run();
  return roam::Store::open(folder);
}

}  // namespace made
