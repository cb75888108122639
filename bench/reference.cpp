#include "reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "closed_form.h"
#include "math/boxes.h"
#include "verify/swept_distance.h"

namespace roam::bench {
namespace {

using Exact = long double;

constexpr std::uint32_t leaf_size = 4;
constexpr int deepest_tree = 64;  // halving: enough for any 32-bit count

// Metres by which the double filter grows bodies and boxes. Local coordinates are rounded to 1e-9 m at 6.4e6 m from the
// origin, and the closed forms add less over 1 km. A hundred times that only costs an extra candidate now and then.
constexpr double filter_slack = 1e-7;

template <class Real>
Corners<Real> relative(const Triangle& triangle, const Vec3& to) {
  const Point<Real> o(to);
  return {Point<Real>(triangle[0]) - o, Point<Real>(triangle[1]) - o, Point<Real>(triangle[2]) - o};
}

template <class Real>
Real impact(const Triangle& triangle, const Query& query, Real slack, Real limit) {
  const Corners<Real> local = relative<Real>(triangle, query.from);
  const Real half_height = query.body.half_height;
  if (axis_meets(local, half_height)) return 0;
  Real first = limit;
  extrude(local, half_height, [&](const Corners<Real>& corner) {
    first = time_of_impact(corner, Point<Real>(query.motion), Real(query.body.radius) + slack, first);
  });
  return first;
}

// The vector from the body's axis at `place` to the nearest point of the triangle, less its part along the axis.
Point<Exact> shortest_way(const Triangle& triangle, const Body& body, const Point<Exact>& place) {
  const Corners<Exact> local{Point<Exact>(triangle[0]) - place, Point<Exact>(triangle[1]) - place,
                             Point<Exact>(triangle[2]) - place};
  if (axis_meets<Exact>(local, body.half_height)) return Point<Exact>(0);
  Point<Exact> best(std::numeric_limits<Exact>::infinity());
  extrude<Exact>(local, body.half_height, [&](const Corners<Exact>& corner) {
    const Point<Exact> p = nearest_to_origin(corner);
    if (glm::dot(p, p) < glm::dot(best, best)) best = p;
  });
  return best;
}

double distance(const Box& box, const Vec3& p, double half_height) {
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double grown = k == 2 ? half_height : 0.0;
    const double d = std::max({box.lower[k] - grown - p[k], p[k] - box.upper[k] - grown, 0.0});
    square += d * d;
  }
  return std::sqrt(square);
}

// Fraction of the motion at which the query's centre enters the box grown by its body; infinity if it does not.
double slab_entry(const Box& box, const Query& query) {
  double first = 0;
  double last = 1;
  for (int k = 0; k < 3; ++k) {
    const double grown = query.body.radius + (k == 2 ? query.body.half_height : 0.0) + filter_slack;
    const double lower = box.lower[k] - grown - query.from[k];
    const double upper = box.upper[k] + grown - query.from[k];
    const double v = query.motion[k];
    if (v == 0) {
      if (lower > 0 || upper < 0) return std::numeric_limits<double>::infinity();
      continue;
    }
    first = std::max(first, std::min(lower / v, upper / v));
    last = std::min(last, std::max(lower / v, upper / v));
  }
  // Covers the rounding of the quotients, which is far smaller.
  constexpr double rounding = 1e-12;
  return first <= last + rounding ? first - rounding : std::numeric_limits<double>::infinity();
}

}  // namespace

Reference::Reference(std::span<const Mesh> meshes) {
  std::vector<Triangle> unordered;
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) unordered.push_back(mesh.triangle(i));
  }
  std::vector<Box> boxes;
  boxes.reserve(unordered.size());
  for (const Triangle& triangle : unordered) boxes.push_back(box_around(triangle));
  std::vector<std::uint32_t> order(unordered.size());
  std::iota(order.begin(), order.end(), 0U);
  if (!order.empty()) split(order, boxes, 0, static_cast<std::uint32_t>(order.size()));
  triangles_.reserve(order.size());
  for (const std::uint32_t i : order) triangles_.push_back(unordered[i]);
}

void Reference::split(std::vector<std::uint32_t>& order, std::span<const Box> boxes, std::uint32_t begin,
                      std::uint32_t end) {
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  Box box;
  Box centers;
  for (std::uint32_t i = begin; i < end; ++i) {
    box.include(boxes[order[i]]);
    centers.include(boxes[order[i]].center());
  }
  nodes_[self].box = box;
  if (end - begin <= leaf_size) {
    nodes_[self].first = begin;
    nodes_[self].count = end - begin;
    return;
  }
  const Vec3 size = centers.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return boxes[a].center()[axis] < boxes[b].center()[axis]; });
  split(order, boxes, begin, middle);
  nodes_[self].first = static_cast<std::uint32_t>(nodes_.size());
  split(order, boxes, middle, end);
}

template <class Entry, class Visit>
void Reference::traverse(double limit, const Entry& entry, const Visit& visit) const {
  if (nodes_.empty()) return;
  struct Waiting {
    double entry;
    std::uint32_t node;
  };
  std::array<Waiting, deepest_tree> stack;
  int depth = 0;
  stack[depth++] = {entry(nodes_[0].box), 0};
  while (depth > 0) {
    const Waiting next = stack[--depth];
    if (!(next.entry < limit)) continue;
    const Node& node = nodes_[next.node];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        limit = std::min(limit, visit(triangles_[i]));
      continue;
    }
    Waiting near{entry(nodes_[next.node + 1].box), next.node + 1};
    Waiting far{entry(nodes_[node.first].box), node.first};
    if (far.entry < near.entry) std::swap(near, far);
    if (far.entry < limit) stack[depth++] = far;
    if (near.entry < limit) stack[depth++] = near;
  }
}

Answer Reference::sweep(const Query& query) const {
  const Exact free = 2;  // beyond the motion's end, which still counts as a touch
  Exact first = free;
  traverse(
      2.0, [&](const Box& box) { return slab_entry(box, query); },
      [&](const Triangle& triangle) {
        if (impact<double>(triangle, query, filter_slack, 2.0) <= static_cast<double>(first)) {
          first = std::min(first, impact<Exact>(triangle, query, 0, first));
        }
        return static_cast<double>(first);
      });
  if (first > 1) return {};
  return {true, static_cast<double>(first)};
}

std::optional<Vec3> Reference::nearest(const Body& body, const Vec3& place, double reach) const {
  std::optional<Vec3> best;
  double smallest = reach;
  traverse(
      reach, [&](const Box& box) { return distance(box, place, body.half_height); },
      [&](const Triangle& triangle) {
        const Point<Exact> way = shortest_way(triangle, body, Point<Exact>(place));
        const auto d = static_cast<double>(glm::length(way));
        if (d < smallest) {
          smallest = d;
          best = place + Vec3(way);
        }
        return smallest;
      });
  return best;
}

double Reference::clearance(const Body& body, const Vec3& place, double reach) const {
  const std::optional<Vec3> point = nearest(body, place, reach);
  return point ? glm::length(*point - place) : reach;
}

double Reference::smallest_clearance(const Query& query, double time, double reach) const {
  Query grown = query;
  grown.body.radius = reach;
  double smallest = reach;
  traverse(
      std::nextafter(time, 2.0), [&](const Box& box) { return slab_entry(box, grown); },
      [&](const Triangle& triangle) {
        // Only a triangle that touches a body of radius `smallest` is nearer.
        Query wide = query;
        wide.body.radius = smallest;
        if (impact<double>(triangle, wide, filter_slack, 2.0) <= time) {
          smallest =
              std::min(smallest, static_cast<double>(verification::swept_distance(
                                     query.from, query.from + time * query.motion, query.body.half_height, triangle)));
        }
        return std::nextafter(time, 2.0);
      });
  return smallest;
}

}  // namespace roam::bench
