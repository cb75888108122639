#include "store/build/shard.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "index/cutter.h"
#include "index/tile_builder.h"
#include "store/authentic.h"
#include "store/build/layout.h"
#include "store/build/shard_triangles.h"
#include "store/codec/tile_codec.h"
#include "store/files.h"
#include "store/mask.h"
#include "store/page.h"

namespace roam::store {
namespace {

struct TileResult {
  TileEntry entry{};
  std::vector<std::byte> bytes;  ///< of the tile, then of its source numbers
  Box bounds;                    ///< of the source triangles
  double fine_error = 0.0;
};

struct TileRun {
  std::uint32_t begin, end;  ///< of ShardTriangles::items
};

/// The smallest box in doubles that contains the source triangles and the stored ones.
Box reach_of(const Box& bounds, double error) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = std::nextafter(bounds.lower[k] - error, -std::numeric_limits<double>::infinity());
    box.upper[k] = std::nextafter(bounds.upper[k] + error, std::numeric_limits<double>::infinity());
  }
  return box;
}

class ShardBuilder {
 public:
  ShardBuilder(Work& work, const Plan& plan, const PlannedShard& shard)
      : work_(work), plan_(plan), source_(read_shard(work, plan, shard.stretch)), cutter_(cutter(source_, plan)) {
    for (const PartRecord& part : plan.parts) {
      part_hash_.push_back(xxh3(std::as_bytes(std::span(part.info.name))));
    }
    cut(shard.stretch);
  }

  /// The tiles in order.
  std::vector<TileResult> run() {
    std::vector<std::vector<TileResult>> results(tiles_.size());
    tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t i) {
      build(tiles_[i], results[i]);
      work_.add_triangles(tiles_[i].end - tiles_[i].begin);
      work_.tick();
    });
    std::vector<TileResult> all;
    for (auto& some : results) {
      for (TileResult& tile : some) all.push_back(std::move(tile));
    }
    return all;
  }

 private:
  struct Reach {
    float operator()(const ShardItem& item) const { return item.reach; }
  };
  using Cutter = index::Cutter<AbsoluteCurve, ShardItem, Reach>;

  static Cutter cutter(const ShardTriangles& source, const Plan& plan) {
    return Cutter(source.items, Reach{}, AbsoluteCurve::cell_size, plan.lossless);
  }

  /// Cuts each cell of the stretch separately, and each size class in it.
  void cut(const Stretch& stretch) {
    const auto items = source_.items;
    const auto after = [&](std::uint32_t begin, CurveKey last) {
      return static_cast<std::uint32_t>(
          std::partition_point(items.begin() + begin, items.end(), [&](const ShardItem& i) { return i.key <= last; }) -
          items.begin());
    };
    std::uint32_t begin = 0;
    for (const CurveCell& cell : stretch.cells) {
      const std::uint32_t end = after(begin, cell.last());
      while (begin < end) {
        const CurveCell size_class{items[begin].key >> AbsoluteCurve::class_shift << AbsoluteCurve::class_shift,
                                   AbsoluteCurve::class_shift};
        const std::uint32_t middle = std::min(end, after(begin, size_class.last()));
        cutter_.cut(begin, middle, [&](std::uint32_t b, std::uint32_t e) { tiles_.push_back({b, e}); });
        begin = middle;
      }
    }
  }

  /// Builds the tile, or several if one would take too much memory.
  void build(const TileRun& run, std::vector<TileResult>& out) const {
    const auto items = source_.items.subspan(run.begin, run.end - run.begin);
    std::vector<Triangle> triangles(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) triangles[i] = source_.triangles[items[i].triangle];
    std::vector<std::uint32_t> numbers(items.size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    index::BuiltTile tile = index::build_tile(triangles, numbers, plan_.lossless);
    if (shape_of(tile).bytes() > tile_bytes) {
      const std::uint32_t middle = cutter_.middle(run.begin, run.end);
      build({run.begin, middle}, out);
      build({middle, run.end}, out);
      return;
    }
    out.push_back(finish(tile, triangles, items));
  }

  TileResult finish(index::BuiltTile& tile, std::span<const Triangle> triangles,
                    std::span<const ShardItem> items) const {
    TileResult out;
    out.bytes = encode_tile(tile);
    const TileShape shape = shape_of(tile);
    TileEntry& e = out.entry;
    e.bytes = static_cast<std::uint32_t>(out.bytes.size());
    e.hash = xxh3(out.bytes);
    const std::vector<std::byte> numbers = encode_numbers(source_numbers(tile, items));
    e.number_bytes = static_cast<std::uint32_t>(numbers.size());
    e.number_hash = xxh3(numbers);
    out.bytes.insert(out.bytes.end(), numbers.begin(), numbers.end());
    e.geometry_hash = geometry_hash(tile.tile, tile.leaves, tile.fine_leaves);

    out.bounds = tile.bounds;
    out.fine_error = tile.tile.fine_error;
    const Box box = reach_of(tile.bounds, double(tile.tile.error));
    Mask mask(box, double(tile.tile.error));
    for (const Triangle& t : triangles) mask.add(t);
    std::copy(mask.words.begin(), mask.words.end(), e.mask);
    for (int k = 0; k < 3; ++k) {
      e.origin[k] = tile.tile.origin[k];
      e.lower[k] = box.lower[k];
      e.upper[k] = box.upper[k];
    }
    e.step = tile.tile.step;
    e.error = tile.tile.error;
    e.fine_error = tile.tile.fine_error;
    e.triangles = shape.triangles;
    e.nodes = static_cast<std::uint16_t>(shape.nodes);
    e.leaves = static_cast<std::uint16_t>(shape.leaves);
    e.fine = shape.fine ? 1 : 0;
    return out;
  }

  /// In the order of the encoded tile.
  [[nodiscard]] std::vector<SourceNumber> source_numbers(const index::BuiltTile& tile,
                                                         std::span<const ShardItem> items) const {
    std::vector<SourceNumber> numbers;
    numbers.reserve(items.size());
    for (const index::Leaf& leaf : tile.leaves) {
      for (int i = 0; i < leaf.triangle_count; ++i) {
        const auto& source = source_.sources[items[index::read_id(tile.ids.data(), leaf, i)].triangle];
        numbers.push_back({part_hash_[source.part], source.number});
      }
    }
    return numbers;
  }

  Work& work_;
  const Plan& plan_;
  const ShardTriangles source_;
  Cutter cutter_;
  std::vector<std::uint64_t> part_hash_;
  std::vector<TileRun> tiles_;
};

/// Appends the pages over the tiles, in order.
void write_pages(PackWriter& pack, std::span<const TileEntry> entries, ShardInfo& info) {
  for (std::size_t first = 0; first < entries.size(); first += page_tiles) {
    const auto tiles = entries.subspan(first, std::min<std::size_t>(page_tiles, entries.size() - first));
    const EncodedPage page = encode_page(tiles);
    PageRef ref;
    for (const TileEntry& t : tiles) {
      ref.box.include({{t.lower[0], t.lower[1], t.lower[2]}, {t.upper[0], t.upper[1], t.upper[2]}});
    }
    ref.bytes = static_cast<std::uint32_t>(page.bytes.size());
    ref.hash = xxh3(page.bytes);
    ref.tiles = static_cast<std::uint32_t>(tiles.size());
    ref.offset = pack.add(page.bytes);
    info.pages.push_back(ref);
  }
}

}  // namespace

std::function<void()> make_shard(Work& work, const Plan& plan, const PlannedShard& shard) {
  std::vector<TileResult> tiles;
  work.arena.execute([&] { tiles = ShardBuilder(work, plan, shard).run(); });

  auto pack = std::make_shared<PackWriter>(work.store);
  ShardInfo info;
  info.key = shard.key;
  std::vector<TileEntry> entries;
  entries.reserve(tiles.size());
  for (TileResult& tile : tiles) {
    tile.entry.offset = pack->add(tile.bytes);
    const TileEntry& e = tile.entry;
    info.triangles += e.triangles;
    info.tiles += 1;
    info.geometry_bytes += e.bytes;
    info.number_bytes += e.number_bytes;
    info.resident_bytes += shape_of(e).bytes();
    info.geometry_hash += e.geometry_hash;
    info.bounds.include(tile.bounds);
    info.largest_error = std::max(info.largest_error, tile.fine_error);
    entries.push_back(e);
  }
  write_pages(*pack, entries, info);
  info.bytes = pack->size();
  work.add_written(info.bytes);
  return [pack, info, &work]() mutable {
    info.pack = pack->commit();
    write_coded(work.store, shard_file(info.key), to_text(info), work.options.key);
  };
}

}  // namespace roam::store
