#pragma once
/// \file
/// Checks a walk against every triangle of the scene, in higher precision and without the index.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "roam/math.h"
#include "roam/mesh.h"
#include "roam/space.h"

namespace roam::verification {

/// One straight move of the body, or its rest when `from` equals `to`.
struct Piece {
  std::uint64_t step = 0;   ///< of the walk
  Vec3 from{0.0}, to{0.0};  ///< of the body's centre
  Body body;
  double clearance = 0.0;  ///< as certified by the walk: least distance of the body's axis from everything, m
};

/// A place where the body was too near to a triangle.
struct Violation {
  std::uint64_t step = 0;
  TriangleId triangle = 0;
  double distance = 0.0;  ///< of the body's axis, m
  double radius = 0.0;
};

/// Metres. A distance smaller than the radius by up to this is no violation: the promise of Space.
inline constexpr double radius_slack = 1e-6;
/// Metres. A certified clearance may exceed the true one by up to this. A certificate has no slack. This is far more
/// than the rounding of long doubles within 6.4e6 m, and far less than any use needs.
inline constexpr double certificate_slack = 1e-9;

struct Verification {
  std::uint64_t pieces = 0;
  std::uint64_t distances = 0;   ///< computed distances; all other triangles were too far by boxes or balls
  std::uint64_t violations = 0;  ///< steps on which the axis came nearer to a triangle than the radius
  std::uint64_t overstated = 0;  ///< steps whose certified clearance is more than the true one
  /// The least distance of the axis less the radius, metres; none when no triangle came near.
  std::optional<double> least_gap;
  std::optional<Violation> worst;
  std::uint64_t touching = 0;  ///< pieces with a surface beside them by their certificate, as under a standing body
  Box way;                     ///< of the body's centre
  Box scene;                   ///< of all triangles, including distant ones
  /// For a store: sentences about the parts along the way that cannot be read. The other findings are about the rest.
  std::vector<std::string> unread;

  /// Whether the number of violations is known. It is not if none was found but something could not be read.
  [[nodiscard]] bool counted() const { return violations > 0 || unread.empty(); }
  /// Adds the findings of other steps.
  void add(const Verification& other);
};

/// The findings as half a sentence.
[[nodiscard]] std::string summary(const Verification& found);
/// Remarks besides the numbers, line by line. One asks whether the scene is where it was during the walk, if no
/// triangle was near a way that lies outside of it, or that had contact most of the time. A body that flies through the
/// middle of a hall is near to nothing.
[[nodiscard]] std::vector<std::string> remarks(const Verification& found);

/// Throws roam::Error if something along the way could not be read, with its place and advice about `store`. `besides`:
/// other advice than to repair it.
void demand_all_read(const Verification& found, const std::string& store, const std::string& besides = {});

/// Checks pieces against triangles that arrive in parts. So a way of any length is checked against a scene of any size
/// in one pass. A triangle is skipped only if it is farther than the radius, the certified clearance and 1 cm more, so
/// that the surface under a standing body is measured. Its distance is bounded by boxes, and by a ball around the
/// triangle, in doubles with more slack than their rounding. swept_distance measures all other triangles. Independent
/// of any Space. Uses all cores.
class Verifier {
 public:
  /// The pieces must outlive it.
  explicit Verifier(std::span<const Piece> pieces);
  ~Verifier();

  /// Checks all pieces against these triangles, numbered from `first`. Calls `progress` with the pieces done, from one
  /// thread at a time; false cancels (roam::Cancelled).
  void check(std::span<const Mesh> meshes, TriangleId first, const std::function<bool(std::uint64_t)>& progress = {});
  /// The result for all triangles so far.
  [[nodiscard]] Verification result() const;

 private:
  class Run;
  std::size_t pieces_;
  std::uint64_t touching_ = 0;
  Box way_, scene_;
  std::vector<Run> runs_;
};

/// Checks every piece against every triangle of `meshes`.
[[nodiscard]] Verification verify(std::span<const Mesh> meshes, std::span<const Piece> pieces,
                                  const std::function<bool(std::uint64_t)>& progress = {});

}  // namespace roam::verification
