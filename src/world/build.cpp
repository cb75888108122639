#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <string>

#include "index/collapse.h"
#include "index/partition.h"
#include "index/tile_builder.h"
#include "math/floating_point.h"
#include "math/largest.h"
#include "roam/error.h"
#include "world/data.h"
#include "world/query.h"

namespace roam {
namespace {

using index::BuiltTile;

/// Reports the fraction done to the caller's callback, one thread at a time. If the callback returns false, it throws
/// Cancelled.
class Progress {
 public:
  explicit Progress(const std::function<bool(double)>& report) : report_(report) {}

  void tick(double fraction) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    reported_ = std::max(reported_, fraction);  // threads come in any order
    if (cancelled_ || !report_(reported_)) {
      cancelled_ = true;
      throw Cancelled();
    }
  }

 private:
  const std::function<bool(double)>& report_;
  std::mutex mutex_;
  double reported_ = 0.0;
  bool cancelled_ = false;
};

/// Part of the build's time for sorting the triangles along the curve; the tiles take the rest.
constexpr double partition_share = 0.2;

/// The box of both the source triangles and the stored ones.
Box grown(const BuiltTile& tile) {
  return {tile.bounds.lower - double(tile.tile.error), tile.bounds.upper + double(tile.tile.error)};
}

std::vector<BuiltTile> build_tiles(const index::Soup& soup, const index::Partition& parts, bool lossless,
                                   Progress& progress) {
  std::vector<BuiltTile> tiles(parts.tiles.size());
  std::atomic<std::uint64_t> done{0};
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
    const auto run = parts.tiles[i];
    std::vector<std::uint32_t> ids(parts.order.begin() + run.begin, parts.order.begin() + run.end);
    std::sort(ids.begin(), ids.end());
    tiles[i] = build_tile(soup, ids, lossless);
    const std::uint64_t sum = done.fetch_add(ids.size()) + ids.size();
    progress.tick(partition_share + (1.0 - partition_share) * double(sum) / double(soup.size()));
  });
  return tiles;
}

/// Metres. A hit lies within hit_reach of the body, or within the largest error of the radius. The rest covers the
/// roundings of the box test and of a hit: fewer than 2^12 units of the coordinates of a body that meets the box.
double slack_of(const WorldData& data) {
  const double farthest =
      std::max(largest(data.reach.lower), largest(data.reach.upper)) + Space::motion_limit + 4.0 * Space::reach_limit;
  return query::hit_reach + data.stats.largest_error + 0x1p-41 * farthest;
}

/// Moves all tiles into one set of arenas, in the order of the tree over them.
void assemble(WorldData& data, std::vector<BuiltTile>& built) {
  data.reach = {};
  for (const BuiltTile& t : built) data.reach.include(grown(t));
  data.grid = index::Grid::over(data.reach);

  std::vector<index::StepBox> boxes(built.size());
  for (std::size_t i = 0; i < built.size(); ++i) boxes[i] = data.grid.steps(grown(built[i]));
  const index::WideTree top = index::tree_over(boxes);

  data.tiles.allocate(built.size());
  std::size_t blocks = top.nodes.size(), fine = 0, ids = 0;
  std::vector<BuiltTile*> source(built.size());
  for (std::size_t i = 0; i < built.size(); ++i) {
    BuiltTile& t = built[top.leaves[i]];
    source[i] = &t;
    t.tile.nodes = static_cast<std::uint32_t>(blocks);
    t.tile.leaves = static_cast<std::uint32_t>(blocks + t.nodes.size());
    t.tile.fine_leaves = fine * sizeof(index::FineLeaf);
    t.tile.ids = ids;
    data.tiles.items[i] = t.tile;
    blocks += t.nodes.size() + t.leaves.size();
    fine += t.fine_leaves.size();
    ids += t.ids.size();
  }
  data.blocks.allocate(blocks);
  data.fine.allocate(fine);
  data.ids.allocate(ids);
  for (std::size_t i = 0; i < top.nodes.size(); ++i) data.blocks.items[i].node = top.nodes[i];
  tbb::parallel_for(std::size_t{0}, built.size(), [&](std::size_t i) {
    const BuiltTile moved = std::move(*source[i]);  // freed as soon as it is copied
    const index::Tile& t = data.tiles.items[i];
    std::memcpy(&data.blocks.items[t.nodes], moved.nodes.data(), moved.nodes.size() * sizeof(index::Node));
    std::memcpy(&data.blocks.items[t.leaves], moved.leaves.data(), moved.leaves.size() * sizeof(index::Leaf));
    if (t.fine) {
      std::memcpy(reinterpret_cast<std::byte*>(data.fine.items.get()) + t.fine_leaves, moved.fine_leaves.data(),
                  moved.fine_leaves.size() * sizeof(index::FineLeaf));
    }
    std::memcpy(&data.ids.items[t.ids], moved.ids.data(), moved.ids.size());
  });
}

}  // namespace

World World::build(std::span<const Mesh> meshes, const BuildOptions& options) {
  const DefaultFloatingPoint guard;
  if (options.threads < 0) {
    throw Error("cannot build a world: the number of threads is " + std::to_string(options.threads) +
                "; it must be at least 1, or 0 for one per core");
  }
  auto data = std::make_unique<WorldData>();
  const index::Soup soup(meshes);
  data->lossless = options.lossless;
  data->first = soup.first();
  for (const Mesh& mesh : meshes) {
    data->names.push_back(mesh.name);
    data->user_data.push_back(mesh.user_data);
  }
  data->bounds = soup.bounds();
  data->stats.triangles = soup.size();
  data->stats.objects = meshes.size();
  if (soup.size() > 0) {
    Progress progress(options.progress);
    const int cores = tbb::info::default_concurrency();
    tbb::task_arena arena(options.threads > 0 ? std::min(options.threads, cores) : cores);
    arena.execute([&] {
      auto built = [&] {
        const auto parts =
            index::partition(soup, options.lossless, [&](double done) { progress.tick(partition_share * done); });
        return build_tiles(soup, parts, options.lossless, progress);
      }();
      assemble(*data, built);
    });
    float error = 0.0F;
    for (std::size_t i = 0; i < data->tiles.size; ++i) error = std::max(error, data->tiles.items[i].fine_error);
    data->stats.largest_error = error;
    data->slack = slack_of(*data);
  }
  data->stats.tiles = data->tiles.size;
  data->stats.bytes = data->blocks.bytes() + data->tiles.bytes() + data->fine.bytes() + data->ids.bytes() +
                      (data->first.size() + data->user_data.size()) * sizeof(std::uint64_t);
  data->index = data->view();
  World world;
  world.data_ = std::move(data);
  return world;
}

}  // namespace roam
