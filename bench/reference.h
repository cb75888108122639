#pragma once
/// \file
/// The reference of the benchmarks: time of impact and distance in long double, by other methods than roam's.
///
/// A binary tree of double boxes, split at the median, and closed forms: the ray against the rounded face, edges and
/// vertices of each triangle (Ericson, "Real-Time Collision Detection", 2005, 5.5.6). A vertical capsule is the sphere
/// against the triangle extruded by the capsule's axis. It shares nothing with the core: no tree, no supporting plane,
/// no margin. The distance along a motion is that of src/verify.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "query.h"
#include "roam/mesh.h"

namespace roam::bench {

class Reference {
 public:
  explicit Reference(std::span<const Mesh> meshes);

  /// The first touch. A body that starts in contact hits at time 0.
  [[nodiscard]] Answer sweep(const Query& query) const;

  /// Distance in metres from the body's axis at `place` to the nearest triangle, at most `reach`.
  [[nodiscard]] double clearance(const Body& body, const Vec3& place, double reach) const;

  /// As above, with the nearest point of the triangles; empty if none is within reach.
  [[nodiscard]] std::optional<Vec3> nearest(const Body& body, const Vec3& place, double reach) const;

  /// The smallest distance in metres from the body's axis to a triangle on the motion up to `time`, at most `reach`.
  [[nodiscard]] double smallest_clearance(const Query& query, double time, double reach) const;

  [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }
  [[nodiscard]] const Triangle& triangle(std::size_t i) const { return triangles_[i]; }

 private:
  struct Node {
    Box box;
    std::uint32_t first = 0;  ///< first triangle of a leaf; second child of an inner node, the first one follows it
    std::uint32_t count = 0;  ///< triangles of a leaf; 0 for an inner node
  };

  void split(std::vector<std::uint32_t>& order, std::span<const Box> boxes, std::uint32_t begin, std::uint32_t end);
  /// Visits the triangles of each leaf whose box `entry(box)` is less than the smallest value returned by
  /// `visit(triangle)` so far, nearest leaf first.
  template <class Entry, class Visit>
  void traverse(double limit, const Entry& entry, const Visit& visit) const;

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
};

}  // namespace roam::bench
