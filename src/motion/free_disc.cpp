#include "motion/free_disc.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/floating_point.h"

namespace roam {
namespace {

/// A square is not divided below this part of the support disc's radius, nor below this many metres. The result may be
/// off by half the diagonal of such a square: 0.28 mm for a disc of 2 m.
constexpr double least_half_part = 1e-4;
constexpr double least_half = 2e-4;

/// Limits of the squares and of the floor queries of one search. A straight crack 2 mm narrower than a disc of 0.6 m
/// takes some 3000 squares and 150 queries.
constexpr int square_limit = 1 << 15;
constexpr int query_limit = 1 << 12;

/// Number of floor points kept, the last ones found.
constexpr std::size_t points_kept = 64;

/// Part of the radius. Squares of at most this size count as hidden behind walls if neither their middle nor a corner
/// is in sight.
constexpr double hidden_part = 0.125;

/// Metres. Radius of the sphere that looks for walls: a ray could slip through where two walls meet.
constexpr double sight_radius = 0.01;

/// Size of the depth-first stack: three siblings wait at each of at most 16 halvings.
constexpr std::size_t stack_size = 64;

/// A square of disc centres, relative to the axis.
struct Square {
  double x, y, half;
};

struct Point {
  double x, y;
};

/// Branch and bound over the centre of the disc. A point of the floor excludes all centres nearer to it than the
/// radius. So a square is settled once one known point is that near to all of it. Otherwise the floor nearest to its
/// middle is queried, and the square is divided.
class Search {
 public:
  Search(const Space& space, const FloorPlane& plane, const SupportDisc& disc, const Vec3& axis)
      : space_(space), plane_(plane), disc_(disc), axis_(axis) {
    const double rise = std::hypot(plane.normal.x, plane.normal.y) / plane.normal.z;
    column_ = {0.0, std::min(disc.band + disc.radius * rise, Space::reach_limit)};
    floor_ = {disc.slope_degrees, disc.band, plane.point, plane.normal};
    smallest_ = std::max(least_half, least_half_part * disc.radius);
  }

  enum class Result : std::uint8_t { none, free, hidden };

  /// `none`: there is no disc. `free`: there is one, or the search reached a limit undecided. With `past_walls` walls
  /// are not looked for until a disc is found. `hidden` then means that a wall may stand before that disc, or that the
  /// search is undecided; search again without `past_walls`.
  Result run(bool past_walls, walking::DiscFound& disc) {
    std::array<Square, stack_size> stack;
    std::size_t depth = 0;
    stack[depth++] = {0.0, 0.0, disc_.radius};
    for (int count = 0; depth > 0; ++count) {
      if (count >= square_limit || queries_ >= query_limit) return Result::free;
      const Square square = stack[--depth];
      if (!meets_domain(square) || settled(square)) continue;
      if (meets_floor(square.x, square.y)) {
        if (settled(square)) continue;
      } else if (std::hypot(square.x, square.y) <= disc_.radius) {
        if (in_sight(square.x, square.y)) {
          disc = {true, axis_.x + square.x, axis_.y + square.y};
          return Result::free;
        }
        if (past_walls) return Result::hidden;
      }
      if (!past_walls && square.half <= hidden_part * disc_.radius && hidden(square)) continue;
      if (square.half <= smallest_) return past_walls ? Result::hidden : Result::free;
      const double half = 0.5 * square.half;
      if (depth + 4 > stack.size()) return Result::free;
      for (const double dx : {-half, half}) {
        for (const double dy : {-half, half}) stack[depth++] = {square.x + dx, square.y + dy, half};
      }
    }
    return Result::none;
  }

  /// Whether the disc found for another axis is still there.
  bool is_free(const walking::DiscFound& disc) {
    if (!disc.found) return false;
    const double x = disc.x - axis_.x, y = disc.y - axis_.y;
    return std::hypot(x, y) <= disc_.radius && !meets_floor(x, y) && in_sight(x, y);
  }

  /// Whether any floor that was met is unknown space.
  [[nodiscard]] bool met_unknown() const { return unknown_; }

 private:
  [[nodiscard]] bool meets_domain(const Square& s) const {
    const double x = std::max(0.0, std::abs(s.x) - s.half), y = std::max(0.0, std::abs(s.y) - s.half);
    return x * x + y * y <= disc_.radius * disc_.radius;
  }

  [[nodiscard]] bool settled(const Square& s) const {
    const double squared = disc_.radius * disc_.radius;
    return std::any_of(points_.begin(), points_.begin() + std::min(found_, points_.size()), [&](const Point& p) {
      const double x = std::abs(s.x - p.x) + s.half, y = std::abs(s.y - p.y) + s.half;
      return x * x + y * y < squared;
    });
  }

  [[nodiscard]] Vec3 over(double x, double y) const {
    Vec3 place(axis_.x + x, axis_.y + y, 0.0);
    place.z = plane_.level(place);
    return place;
  }

  /// Whether there is floor nearer than the radius; remembers its nearest point.
  bool meets_floor(double x, double y) {
    ++queries_;
    const Clearance near = space_.floor_clearance(column_, over(x, y), disc_.radius, floor_);
    if (!near.found) return false;
    unknown_ |= near.unknown;
    const Point point{near.point.x - axis_.x, near.point.y - axis_.y};
    points_[found_++ % points_.size()] = point;
    return std::hypot(point.x - x, point.y - y) < disc_.radius;
  }

  bool in_sight(double x, double y) {
    const Vec3 knee(0.0, 0.0, disc_.knee);
    const Vec3 from = over(0.0, 0.0) + knee, to = over(x, y) + knee;
    const double radius = std::min(sight_radius, 0.25 * disc_.radius);
    const FirstImpact wall = space_.first_impact({radius, 0.0}, from, to - from);
    unknown_ |= wall.hit && wall.unknown;
    return !wall.hit;
  }

  bool hidden(const Square& s) {
    if (in_sight(s.x, s.y)) return false;
    for (const double dx : {-s.half, s.half}) {
      for (const double dy : {-s.half, s.half}) {
        if (in_sight(s.x + dx, s.y + dy)) return false;
      }
    }
    return true;
  }

  const Space& space_;
  const FloorPlane& plane_;
  const SupportDisc& disc_;
  Vec3 axis_;
  Body column_;
  Floor floor_;
  double smallest_;
  std::array<Point, points_kept> points_;
  std::size_t found_ = 0;
  int queries_ = 0;
  bool unknown_ = false;
};

}  // namespace

Carrying walking::find_disc(const Space& space, const FloorPlane& plane, const SupportDisc& disc, const Vec3& axis,
                            DiscFound& last) {
  Search search(space, plane, disc, axis);
  if (search.is_free(last)) return Carrying::no;
  last = {};
  Search::Result result = search.run(true, last);
  // Walls only exclude discs, so they are looked for only if there is a disc.
  if (result == Search::Result::hidden) result = search.run(false, last);
  if (result != Search::Result::none) return Carrying::no;
  return search.met_unknown() ? Carrying::unknown : Carrying::yes;
}

Carrying carrying(const Space& space, const FloorPlane& plane, const SupportDisc& disc, const Vec3& axis) {
  const DefaultFloatingPoint guard;
  walking::DiscFound none;
  return walking::find_disc(space, plane, disc, axis, none);
}

}  // namespace roam
