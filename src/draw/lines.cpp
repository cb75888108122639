#include "draw/lines.h"

#include <cmath>
#include <glm/common.hpp>
#include <tuple>

namespace roam::draw {
namespace {

constexpr double finest_grid = 0.125;  ///< pixels; gives numbers with few digits
constexpr double coarsest_grid = 4.0;
/// Cells of the first grid along the longer side of a frame: a sheet has 2,000 pixels, and magnifies parts of plans.
constexpr double first_cells = 1 << 17;

bool before(const Point& a, const Point& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); }
bool same(const Segment& a, const Segment& b) { return a.a == b.a && a.b == b.b; }

/// Rounds the ends to a grid, and removes points and duplicates.
void snap(std::vector<Segment>& segments, const Point& origin, const Point& grid) {
  for (Segment& s : segments) {
    for (Point* p : {&s.a, &s.b}) *p = origin + grid * glm::round((*p - origin) / grid);
    if (before(s.b, s.a)) std::swap(s.a, s.b);
  }
  std::erase_if(segments, [](const Segment& s) { return s.a == s.b; });
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.a == b.a ? before(a.b, b.b) : before(a.a, b.a); });
  segments.erase(std::unique(segments.begin(), segments.end(), same), segments.end());
}

/// Distinct segments, and for each of their ends the segments that end there.
class Network {
 public:
  explicit Network(std::vector<Segment> segments) : segments_(std::move(segments)), used_(segments_.size(), 0) {
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      ends_.emplace_back(segments_[i].a, i);
      ends_.emplace_back(segments_[i].b, i);
    }
    std::stable_sort(ends_.begin(), ends_.end(), less);
  }

  [[nodiscard]] std::vector<Polyline> lines() {
    std::vector<Polyline> result;
    // First lines that begin at a free end or a fork, then the remaining rings.
    for (const bool rings : {false, true}) {
      for (std::size_t i = 0; i < segments_.size(); ++i) {
        for (const Point& end : {segments_[i].a, segments_[i].b}) {
          if (!used_[i] && (rings || ends_at(end).size() != 2)) result.push_back(follow(i, end));
        }
      }
    }
    return result;
  }

 private:
  using End = std::pair<Point, std::size_t>;
  static bool less(const End& a, const End& b) { return before(a.first, b.first); }

  [[nodiscard]] std::span<const End> ends_at(const Point& p) const {
    const auto [from, to] = std::equal_range(ends_.begin(), ends_.end(), End{p, 0}, less);
    return {from, to};
  }

  Polyline follow(std::size_t i, Point at) {
    Polyline line{at};
    while (true) {
      used_[i] = 1;
      at = segments_[i].a == at ? segments_[i].b : segments_[i].a;
      line.push_back(at);
      const auto ends = ends_at(at);
      if (ends.size() != 2) return line;
      const std::size_t next = ends[0].second == i ? ends[1].second : ends[0].second;
      if (used_[next]) return line;
      i = next;
    }
  }

  std::vector<Segment> segments_;
  std::vector<char> used_;
  std::vector<End> ends_;
};

std::vector<Polyline> straightened(std::vector<Segment> segments) {
  std::vector<Polyline> lines = Network(std::move(segments)).lines();
  for (Polyline& line : lines) line = simplified(line, straight);
  return lines;
}

std::size_t pieces_of(const std::vector<Polyline>& lines) {
  std::size_t pieces = 0;
  for (const Polyline& line : lines) pieces += line.size() - 1;
  return pieces;
}

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
                             std::size_t most, Coarsened& coarsened) {
  std::vector<Segment> drawn;
  drawn.reserve(segments.size());
  for (const Segment& s : segments) drawn.push_back({to_sheet(s.a), to_sheet(s.b)});
  double grid = finest_grid;
  snap(drawn, Point(0.0), Point(grid));
  std::vector<Polyline> lines = straightened(drawn);
  while (pieces_of(lines) > most && grid < coarsest_grid) {
    coarsened.grid = grid *= 2.0;
    snap(drawn, Point(0.0), Point(grid));
    lines = straightened(drawn);
  }
  if (pieces_of(lines) <= most) return lines;
  // Too many long lines: the longest segments are the most useful.
  const auto length = [](const Segment& s) { return glm::distance(s.a, s.b); };
  std::stable_sort(drawn.begin(), drawn.end(),
                   [&](const Segment& a, const Segment& b) { return length(a) > length(b); });
  const std::size_t all = drawn.size();
  drawn.resize(std::min(all, most));
  coarsened.left_out = all - drawn.size();
  return straightened(std::move(drawn));
}

ThinSegments::ThinSegments(const Frame& frame, std::size_t most) : grid_(1e-6), most_(most) {
  if (frame.view.empty()) return;
  origin_ = frame.view.lower;
  const double pixels = std::max(frame.width(), frame.height()) / first_cells;
  grid_ = glm::max(grid_, pixels / Point(frame.scale_x, frame.scale_y));
}

void ThinSegments::add(std::vector<Segment>&& segments) {
  segments_.insert(segments_.end(), segments.begin(), segments.end());
  if (segments_.size() <= most_) return;
  snap(segments_, origin_, grid_);
  // Half as many, so that the next few segments do not thin again at once.
  while (segments_.size() > most_ / 2) {
    snap(segments_, origin_, grid_ *= 2.0);
    coarsened_ = grid_.x;
  }
}

}  // namespace roam::draw
