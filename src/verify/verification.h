#pragma once
/// \file
/// Checking a walk against every triangle of the scene, in higher precision and without the index.

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
  double clearance = 0.0;  ///< what the walk certified: the body's axis stays at least so far from everything, m
};

/// Where the body was nearer to a triangle than it may be.
struct Violation {
  std::uint64_t step = 0;
  TriangleId triangle = 0;
  double distance = 0.0;  ///< of the body's axis, m
  double radius = 0.0;
};

/// By how much less than the radius a distance may be before it is a violation, in metres: what Space promises.
inline constexpr double radius_slack = 1e-6;
/// By how much more than the true clearance a certified one may seem to be, in metres. A certificate has no slack; this
/// is far more than long doubles round anywhere within 6.4e6 m, and far less than anybody could mind.
inline constexpr double certificate_slack = 1e-9;

struct Verification {
  std::uint64_t pieces = 0;
  std::uint64_t distances = 0;   ///< that were computed; boxes or balls around all others were farther than need be
  std::uint64_t violations = 0;  ///< steps on which the axis came nearer to a triangle than the radius
  std::uint64_t overstated = 0;  ///< steps whose certified clearance is more than the true one
  /// The least distance of the axis less the radius, metres; none when no triangle came near.
  std::optional<double> least_gap;
  std::optional<Violation> worst;
  std::uint64_t touching = 0;  ///< pieces that are certified to be next to something, as a body that stands is
  Box way;                     ///< of the body's centre
  Box scene;                   ///< of all triangles, those beyond reach too
  /// Of a store, what lies along the way and cannot be read: sentences that name it. What is found is of the rest.
  std::vector<std::string> unread;

  /// Whether it is known how many violations there are: where nothing was found and not all was read, it is not.
  [[nodiscard]] bool counted() const { return violations > 0 || unread.empty(); }
  /// Adds what was found of other steps.
  void add(const Verification& other);
};

/// Half a sentence with its numbers.
[[nodiscard]] std::string summary(const Verification& found);
/// What is to be said of it besides its numbers, line by line. Asks whether the scene lies as it did when it was walked
/// only where nothing was near a way that is outside of it, or that touched something most of the time: who flies
/// through the middle of a hall comes near to nothing.
[[nodiscard]] std::vector<std::string> remarks(const Verification& found);

/// Throws roam::Error where not all was read that lies along the way: it says where, and what to do about `store`.
/// `besides`: what else can be done than to mend it.
void demand_all_read(const Verification& found, const std::string& store, const std::string& besides = {});

/// Checks pieces against triangles that come little by little, so that a way of any length is checked against a scene
/// of any size while this is read once. A triangle is passed over only when its box is farther from the box of the
/// piece, or the ball around it from the piece, than the radius and the certified clearance and 1 cm more, so that what
/// a body stands on is measured; that is told in doubles with more room than their rounding. Whatever is left is
/// measured by swept_distance. Independent of any Space. Uses all cores.
class Verifier {
 public:
  /// The pieces must stay.
  explicit Verifier(std::span<const Piece> pieces);
  ~Verifier();

  /// Checks all pieces against these triangles, which are numbered through from `first`. `progress` is called with the
  /// pieces done, from one thread at a time, and cancels by returning false (roam::Cancelled).
  void check(std::span<const Mesh> meshes, TriangleId first, const std::function<bool(std::uint64_t)>& progress = {});
  /// Of all triangles that came.
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
