#include "draw/levels.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <numeric>

namespace roam::draw {
namespace {

/// Cells along the longer side of a map, and stations examined for each cell.
constexpr double cells_across = 160.0;
constexpr std::size_t most_looked_at = 2'000;
/// A place within this many storeys of two parts of the way shows both.
constexpr double beside = 1.5;

/// Windows whose parts of the way differ by less than this are equal.
constexpr double evenness = 1e-3;
/// On steeper parts the body falls, or flies straight up or down: seen from above it does not move.
constexpr double steepest = 1.5;  ///< height per length

struct Sample {
  double z = 0.0;
  double weight = 0.0;
  std::size_t station = 0;
};

}  // namespace

Levels find_levels(std::span<const Station> stations, double body_height) {
  Levels levels;
  levels.where.assign(stations.size(), 0);
  std::vector<Sample> open;
  std::vector<std::size_t> falling;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const bool moved = i > 0 && !stations[i].jump;
    const double length = moved ? stations[i].along - stations[i - 1].along : 0.0;
    if (moved && std::abs(stations[i].centre.z - stations[i - 1].centre.z) > steepest * length) {
      falling.push_back(i);
    } else {
      open.push_back({stations[i].centre.z, length + 1e-9, i});
    }
  }
  std::sort(open.begin(), open.end(), [](const Sample& a, const Sample& b) { return a.z < b.z; });
  const double window = 0.5 * body_height;
  std::vector<std::pair<double, std::size_t>> cuts;  // height, and the index that stations use
  while (!open.empty()) {
    std::size_t best_from = 0, best_to = 0;
    double best = 0.0, sum = 0.0;
    for (std::size_t from = 0, to = 0; from < open.size(); ++from) {
      while (to < open.size() && open[to].z <= open[from].z + window) sum += open[to++].weight;
      // The lowest of equal windows, so that a ramp is cut at even steps.
      if (sum > best * (1.0 + evenness)) {
        best = sum;
        best_from = from;
        best_to = to;
      }
      sum -= open[from].weight;
    }
    double half = 0.5 * best;
    std::size_t median = best_from;
    while (median + 1 < best_to && (half -= open[median].weight) > 0.0) ++median;
    const double cut = open[median].z;
    for (std::size_t i = best_from; i < best_to; ++i) {
      levels.where[open[i].station] = static_cast<std::uint16_t>(cuts.size());
    }
    cuts.emplace_back(cut, cuts.size());
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(best_from),
               open.begin() + static_cast<std::ptrdiff_t>(best_to));
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<std::uint16_t> rank(cuts.size());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    rank[cuts[i].second] = static_cast<std::uint16_t>(i);
    levels.cuts.push_back(cuts[i].first);
  }
  for (auto& level : levels.where) level = rank[level];
  for (const std::size_t i : falling) levels.where[i] = levels.where[i - 1];
  return levels;
}

std::string cut_text(const Levels& levels) {
  const auto& cuts = levels.cuts;
  const std::string heights =
      cuts.size() == 1 ? fmt::format("z = {:.2f} m", cuts[0])
                       : fmt::format("{} levels from z = {:.2f} to {:.2f} m", cuts.size(), cuts.front(), cuts.back());
  return "cut at the height of the body's centre, " + heights;
}

LevelMap::LevelMap(const Rect& area, const Levels& levels, std::span<const Station> stations, const Turn& turn,
                   double storey)
    : area_(area) {
  if (levels.cuts.size() == 1) {
    cells_.push_back({0, none});
    return;
  }
  const double side = std::max(area.width(), area.height()) / cells_across;
  columns_ = std::max(1, static_cast<int>(std::ceil(area.width() / side)));
  rows_ = std::max(1, static_cast<int>(std::ceil(area.height() / side)));
  const std::size_t stride = 1 + stations.size() / most_looked_at;
  std::vector<std::pair<Point, std::uint16_t>> places;
  for (std::size_t i = 0; i < stations.size(); i += stride) {
    places.emplace_back(turn.plan(stations[i].centre), levels.where[i]);
  }
  std::vector<double> nearest(levels.cuts.size());
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Point p(area.lower.x + (column + 0.5) * area.width() / columns_,
                    area.lower.y + (row + 0.5) * area.height() / rows_);
      std::fill(nearest.begin(), nearest.end(), std::numeric_limits<double>::infinity());
      for (const auto& [place, level] : places) {
        const Point d = place - p;
        nearest[level] = std::min(nearest[level], glm::dot(d, d));
      }
      const double least = *std::min_element(nearest.begin(), nearest.end());
      const double limit = std::max(least, beside * storey * beside * storey);
      // The highest of the near levels determines the upper storey. For each storey the nearest level counts.
      std::size_t top = levels.cuts.size() - 1;
      while (nearest[top] > limit) --top;
      Cell cell;
      double upper = std::numeric_limits<double>::infinity(), lower = upper;
      for (std::size_t i = 0; i <= top; ++i) {
        const bool on_top = levels.cuts[i] > levels.cuts[top] - storey;
        if (!on_top && nearest[i] > limit) continue;
        double& best = on_top ? upper : lower;
        if (nearest[i] < best) {
          best = nearest[i];
          (on_top ? cell.upper : cell.lower) = static_cast<std::uint16_t>(i);
        }
      }
      cells_.push_back(cell);
    }
  }
}

std::size_t LevelMap::index(const Point& p) const {
  const auto cell = [](double at, double from, double size, int count) {
    return std::clamp(static_cast<int>((at - from) / size * count), 0, count - 1);
  };
  const int column = cell(p.x, area_.lower.x, area_.width(), columns_);
  const int row = cell(p.y, area_.lower.y, area_.height(), rows_);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
}

}  // namespace roam::draw
