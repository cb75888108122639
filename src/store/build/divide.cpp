#include "store/build/divide.h"

#include <algorithm>
#include <bit>
#include <span>

#include "roam/error.h"

namespace roam::store {
namespace {

int width(CurveKey x) {
  const auto high = static_cast<std::uint64_t>(x >> 64);
  return high != 0 ? 64 + std::bit_width(high) : std::bit_width(static_cast<std::uint64_t>(x));
}

bool before(const PartCell& a, const PartCell& b) { return a.key != b.key ? a.key < b.key : a.part < b.part; }

/// Cells by part and key, at most `most`. They become wider as they have to, but stay narrower than `limit` bits.
class CellList {
 public:
  CellList(std::size_t most, int limit) : most_(most), limit_(limit) {}

  void add(PartCell cell) {
    widen(cell);
    if (joins_last(cells_, cell)) return;
    if (cells_.size() == most_) {
      coarsen();
      widen(cell);
      if (joins_last(cells_, cell)) return;
    }
    // Its capacity stays within `most`, too.
    if (cells_.size() == cells_.capacity()) cells_.reserve(std::min(most_, 2 * cells_.size() + 1));
    cells_.push_back(cell);
  }
  std::vector<PartCell> take() {
    cells_.shrink_to_fit();
    return std::move(cells_);
  }

 private:
  void widen(PartCell& cell) const {
    if (cell.bits >= bits_) return;
    cell.key = cell.key >> bits_ << bits_;
    cell.bits = bits_;
  }
  static bool joins_last(std::span<PartCell> cells, const PartCell& cell) {
    if (cells.empty() || cells.back().part != cell.part || cells.back().key != cell.key) return false;
    cells.back().triangles += cell.triangles;
    return true;
  }
  /// Leaves room for as many again, if it can.
  void coarsen() {
    int narrowest = limit_ - 1;
    for (const PartCell& cell : cells_) narrowest = std::min(narrowest, cell.bits);
    bits_ = narrowest;
    while (cells_.size() > most_ / 2 && bits_ + 1 < limit_) {
      ++bits_;
      std::size_t kept = 0;
      for (PartCell cell : cells_) {
        widen(cell);
        if (!joins_last(std::span(cells_).first(kept), cell)) cells_[kept++] = cell;
      }
      cells_.resize(kept);
    }
    if (cells_.size() == most_) {
      throw Error("the parts of the scene take more memory than there is to plan in; give --memory more");
    }
  }

  std::size_t most_;
  int limit_, bits_ = 0;
  std::vector<PartCell> cells_;
};

class Divider {
 public:
  Divider(const Refine& refine, const ShardLimits& limits) : refine_(refine), limits_(limits) {}

  std::vector<Stretch> run(std::uint32_t parts, std::size_t most) {
    std::vector<PartCell> whole;
    for (std::uint32_t part = 0; part < parts; ++part) whole.push_back({0, 0, part, key_bits});
    std::vector<PartCell> cells = refined(whole, key_bits, most / 2);
    whole = {};
    visit({0, key_bits}, cells, most - cells.size());
    flush();
    return std::move(out_);
  }

 private:
  /// All of `cells` lie in `cell`. Keeps at most `most` others.
  void visit(const CurveCell& cell, std::span<PartCell> cells, std::size_t most) {
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
      visit({cells.front().key, 0}, cells, most);
      return;
    }
    std::vector<PartCell> finer;
    if (bit < widest) {
      finer = refined(cells, widest, most / 2);
      most -= finer.size();
      if (finer.empty()) throw Error("the runs of a part do not hold what was counted; remove the folder scratch");
      cells = finer;
    }
    const CurveKey prefix = cells.front().key >> (bit + 1) << (bit + 1);
    const CurveKey border = prefix | CurveKey{1} << bit;
    const auto second = static_cast<std::size_t>(
        std::partition_point(cells.begin(), cells.end(), [&](const PartCell& c) { return c.key < border; }) -
        cells.begin());
    visit({prefix, bit}, cells.first(second), most);
    if (district) flush();
    visit({border, bit}, cells.subspan(second), most);
    if (district) flush();
  }

  /// At most `most` cells instead of these, all narrower than `bits`, in order. Puts these out of order.
  [[nodiscard]] std::vector<PartCell> refined(std::span<PartCell> cells, int bits, std::size_t most) const {
    std::sort(cells.begin(), cells.end(),
              [](const PartCell& a, const PartCell& b) { return a.part != b.part ? a.part < b.part : a.key < b.key; });
    CellList finer(most, bits);
    for (const PartCell& c : cells) {
      if (c.bits < bits) {
        finer.add(c);
        continue;
      }
      for (const PartCell& part : refine_(c.part, {c.key, c.bits})) finer.add(part);
    }
    std::vector<PartCell> out = finer.take();
    std::sort(out.begin(), out.end(), before);
    return out;
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

std::vector<Stretch> divide(std::uint32_t parts, const Refine& refine, std::size_t most, const ShardLimits& limits) {
  return Divider(refine, limits).run(parts, most);
}

}  // namespace roam::store
