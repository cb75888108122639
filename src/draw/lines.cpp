#include "draw/lines.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "draw/corners.h"

namespace roam::draw {
namespace {

constexpr double finest_grid = 0.125;  ///< pixels; gives numbers with few digits
constexpr double coarsest_grid = 4.0;
constexpr double straight = 0.2;  ///< pixels

using Node = std::array<std::int32_t, 2>;
using Edge = std::array<Node, 2>;

/// The distinct edges between distinct nodes of a grid.
std::vector<Edge> snapped(std::span<const Segment> segments, double grid) {
  std::vector<Edge> edges;
  edges.reserve(segments.size());
  const auto node = [grid](const Point& p) {
    return Node{static_cast<std::int32_t>(std::lround(p.x / grid)), static_cast<std::int32_t>(std::lround(p.y / grid))};
  };
  for (const Segment& s : segments) {
    Edge edge{node(s.a), node(s.b)};
    if (edge[0] == edge[1]) continue;
    if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
    edges.push_back(edge);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Edges, and for each node the edges that end there.
class Network {
 public:
  explicit Network(std::vector<Edge> edges) : edges_(std::move(edges)), used_(edges_.size(), 0) {
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      for (const Node& node : edges_[i]) ends_.emplace_back(node, i);
    }
    std::sort(ends_.begin(), ends_.end());
  }

  [[nodiscard]] std::vector<Polyline> lines(double grid) {
    std::vector<Polyline> result;
    // First lines that begin at a free end or a fork, then the remaining rings.
    for (const bool rings : {false, true}) {
      for (std::size_t i = 0; i < edges_.size(); ++i) {
        for (std::size_t end = 0; end < 2 && !used_[i]; ++end) {
          if (rings || ends_at(edges_[i][end]).size() != 2) result.push_back(follow(i, end, grid));
        }
      }
    }
    return result;
  }

 private:
  using End = std::pair<Node, std::size_t>;

  [[nodiscard]] std::span<const End> ends_at(const Node& node) const {
    const auto less = [](const End& a, const End& b) { return a.first < b.first; };
    const auto [from, to] = std::equal_range(ends_.begin(), ends_.end(), End{node, 0}, less);
    return {from, to};
  }

  Polyline follow(std::size_t edge, std::size_t end, double grid) {
    const auto point = [grid](const Node& n) { return Point(n[0] * grid, n[1] * grid); };
    Node at = edges_[edge][end];
    Polyline line{point(at)};
    while (true) {
      used_[edge] = 1;
      at = edges_[edge][0] == at ? edges_[edge][1] : edges_[edge][0];
      line.push_back(point(at));
      const auto ends = ends_at(at);
      if (ends.size() != 2) return line;
      const std::size_t next = ends[0].second == edge ? ends[1].second : ends[0].second;
      if (used_[next]) return line;
      edge = next;
    }
  }

  std::vector<Edge> edges_;
  std::vector<char> used_;
  std::vector<End> ends_;
};

}  // namespace

Polyline simplified(const Polyline& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<char> keep(line.size(), 0);
  const auto deviation = [&line](std::size_t i, std::size_t from, std::size_t to) {
    const Point &a = line[from], &b = line[to];
    return glm::distance(line[i], a + nearest_part(line[i], a, b) * (b - a));
  };
  keep_corners(0, line.size() - 1, tolerance, deviation, keep);
  Polyline result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (keep[i]) result.push_back(line[i]);
  }
  return result;
}

std::vector<Polyline> joined(std::span<const Segment> segments, const std::function<Point(const Point&)>& to_sheet,
                             std::size_t most) {
  std::vector<Segment> on_sheet;
  on_sheet.reserve(segments.size());
  for (const Segment& s : segments) on_sheet.push_back({to_sheet(s.a), to_sheet(s.b)});
  double grid = finest_grid;
  std::vector<Edge> edges = snapped(on_sheet, grid);
  while (edges.size() > most && grid < coarsest_grid) {
    grid *= 2.0;
    edges = snapped(on_sheet, grid);
  }
  if (edges.size() > most) {
    // Too many long lines: the longest are the most useful.
    const auto length = [](const Edge& e) { return std::hypot(e[1][0] - e[0][0], e[1][1] - e[0][1]); };
    std::stable_sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return length(a) > length(b); });
    edges.resize(most);
  }
  std::vector<Polyline> lines = Network(std::move(edges)).lines(grid);
  for (Polyline& line : lines) line = simplified(line, straight);
  return lines;
}

}  // namespace roam::draw
