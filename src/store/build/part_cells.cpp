#include "store/build/part_cells.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "roam/error.h"
#include "store/build/layout.h"
#include "store/build/run.h"
#include "store/files.h"

namespace roam::store {
namespace {

/// The largest scene: some 100,000 shards.
constexpr std::uint64_t most_triangles = 1ull << 38;
/// Runs are counted in cells narrower by this many bits: in 4096 at most.
constexpr int refine_bits = 12;

}  // namespace

std::vector<PartCell> PartCells::operator()(std::uint32_t part, const CurveCell& cell) {
  if (std::optional<std::vector<PartCell>> cells = in_file(part, cell)) return *std::move(cells);
  return in_runs(part, cell);
}

/// The cells in `cell` that the part's file has; nothing if they are not narrower.
std::optional<std::vector<PartCell>> PartCells::in_file(std::uint32_t part, const CurveCell& cell) {
  if (cell_bits_[part] >= cell.bits) return {};
  const std::string file = part_file(parts_[part].info.file);
  int bits = 0;
  bool passed = false;
  std::vector<PartCell> cells;
  PartVisitor visitor;
  visitor.counts = [&](const PartCounts& counts) {
    bits = counts.cell_bits;
    passed = bits >= cell.bits;
    if (cell.bits < key_bits) return;
    if (counts.triangles > most_triangles - triangles_) {
      throw Error::at((work_.store / file).string(),
                      fmt::format("{} counts more triangles than any scene has: verify the store, and repair it",
                                  (work_.store / file).string()));
    }
    triangles_ += counts.triangles;
  };
  visitor.cell = [&](const Cell& counted) {
    passed = counted.key > cell.last();
    if (!passed && counted.key >= cell.key) cells.push_back({counted.key, counted.triangles, part, bits});
  };
  visitor.enough = [&] {
    work_.tick();
    return passed;
  };
  const Descriptor opened = open_file(work_.store, file, O_RDONLY);
  if (!opened.is_open()) fail("read", work_.store, file, errno);
  visit_part(
      [&](std::span<std::byte> out) {
        const ssize_t got = again([&] { return ::read(opened.number(), out.data(), out.size()); });
        if (got < 0) fail("read", work_.store, file, errno);
        return static_cast<std::size_t>(got);
      },
      size_of(work_.store, file).value_or(0), file, visitor);
  cell_bits_[part] = bits;
  if (bits >= cell.bits) return {};
  return cells;
}

std::vector<PartCell> PartCells::in_runs(std::uint32_t part, const CurveCell& cell) {
  const int bits = std::max(0, cell.bits - refine_bits);
  const PartRecord& record = parts_[part];
  if (!record.has_runs) {
    unread_.insert(part);
    return {{cell.key, 1, part, bits}};
  }
  std::vector<std::uint64_t> counts(std::size_t{1} << (cell.bits - bits));
  RunBlock block;
  for (std::size_t r = 0; r < record.runs.size(); ++r) {
    if (record.runs[r].last < cell.key || cell.last() < record.runs[r].first) continue;
    const RunReader run(work_.store, run_file(record.id, r), record.runs[r].hash);
    const RunReader::Range range = run.blocks(cell.key, cell.last());
    for (std::size_t b = range.begin; b < range.end; ++b) {
      run.read(b, block);
      for (const Triangle& t : block.triangles) {
        const CurveKey key = place_of(t).key;
        if (key >= cell.key && key <= cell.last()) ++counts[static_cast<std::size_t>((key - cell.key) >> bits)];
      }
      work_.tick();
    }
  }
  std::vector<PartCell> out;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) out.push_back({cell.key + (CurveKey{i} << bits), counts[i], part, bits});
  }
  return out;
}

}  // namespace roam::store
