#include "store/build/divide.h"

#include <algorithm>
#include <bit>
#include <span>

#include "roam/error.h"

namespace roam::store {
namespace {

/// Cells are refined by this many bits at a time: into 4096 at most.
constexpr int refine_bits = 12;

int width(CurveKey x) {
  const auto high = static_cast<std::uint64_t>(x >> 64);
  return high != 0 ? 64 + std::bit_width(high) : std::bit_width(static_cast<std::uint64_t>(x));
}

bool before(const PartCell& a, const PartCell& b) { return a.key != b.key ? a.key < b.key : a.part < b.part; }

class Divider {
 public:
  Divider(const Refine& refine, const ShardLimits& limits) : refine_(refine), limits_(limits) {}

  std::vector<Stretch> run(std::vector<PartCell> cells) {
    visit({0, key_bits}, cells);
    flush();
    return std::move(out_);
  }

 private:
  /// All of `cells` lie in `cell`.
  void visit(const CurveCell& cell, std::span<PartCell> cells) {
    std::uint64_t total = 0;
    for (const PartCell& c : cells) total += c.triangles;
    if (total == 0) return;
    if (total <= limits_.shard) {
      add(cell, total, cells);
      return;
    }
    const bool district = total > limits_.district;
    if (district) flush();
    if (cell.bits == 0) {
      slice(cell, total, cells);
      return;
    }
    // Keys are equal above their first differing bit, so no border lies there. Bits below the widest cell are unknown.
    int widest = 0;
    for (const PartCell& c : cells) widest = std::max(widest, c.bits);
    const int bit = std::max(width(cells.front().key ^ cells.back().key), widest) - 1;
    if (bit < 0) {
      // One smallest cell holds them all.
      visit({cells.front().key, 0}, cells);
      return;
    }
    std::vector<PartCell> finer;
    if (bit < widest) {
      finer = refined(cells, widest);
      if (finer.empty()) throw Error("the runs of a part do not hold what was counted; remove the folder scratch");
      cells = finer;
    }
    const CurveKey prefix = cells.front().key >> (bit + 1) << (bit + 1);
    const CurveKey border = prefix | CurveKey{1} << bit;
    const auto second = static_cast<std::size_t>(
        std::partition_point(cells.begin(), cells.end(), [&](const PartCell& c) { return c.key < border; }) -
        cells.begin());
    visit({prefix, bit}, cells.first(second));
    if (district) flush();
    visit({border, bit}, cells.subspan(second));
    if (district) flush();
  }

  /// The cells with those of `bits` bits replaced by finer ones.
  [[nodiscard]] std::vector<PartCell> refined(std::span<const PartCell> cells, int bits) const {
    std::vector<PartCell> finer;
    for (const PartCell& c : cells) {
      if (c.bits < bits) {
        finer.push_back(c);
        continue;
      }
      const std::vector<PartCell> some = refine_(c.part, {c.key, c.bits}, std::max(0, c.bits - refine_bits));
      finer.insert(finer.end(), some.begin(), some.end());
    }
    std::sort(finer.begin(), finer.end(), before);
    return finer;
  }

  void add(const CurveCell& cell, std::uint64_t total, std::span<const PartCell> cells) {
    if (open_.triangles + total > limits_.shard) flush();
    open_.cells.push_back(cell);
    open_.triangles += total;
    for (const PartCell& c : cells) open_.parts.push_back(c.part);
  }

  /// Shards of one smallest cell, each with the parts of its own triangles. `cells` has one for each part.
  void slice(const CurveCell& cell, std::uint64_t total, std::span<const PartCell> cells) {
    flush();
    auto first = cells.begin();
    std::uint64_t before_first = 0;  // triangles
    for (std::uint64_t begin = 0; begin < total; begin += limits_.shard) {
      const std::uint64_t end = begin + std::min(limits_.shard, total - begin);
      while (before_first + first->triangles <= begin) before_first += first++->triangles;
      Stretch s;
      s.cells = {cell};
      s.skip = begin - before_first;
      s.triangles = end - begin;
      std::uint64_t before = before_first;
      for (auto c = first; before < end; before += c++->triangles) s.parts.push_back(c->part);
      out_.push_back(std::move(s));
    }
  }

  void flush() {
    if (open_.triangles > 0) {
      std::vector<std::uint32_t>& parts = open_.parts;
      std::sort(parts.begin(), parts.end());
      parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
      out_.push_back(std::move(open_));
    }
    open_ = {};
  }

  const Refine& refine_;
  ShardLimits limits_;
  Stretch open_;
  std::vector<Stretch> out_;
};

}  // namespace

std::vector<Stretch> divide(std::vector<PartCell> cells, const Refine& refine, const ShardLimits& limits) {
  std::sort(cells.begin(), cells.end(), before);
  return Divider(refine, limits).run(std::move(cells));
}

}  // namespace roam::store
