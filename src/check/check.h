#pragma once
/// \file
/// Checks the certificate of a walk against every triangle of its scene, without trust in the program that walked. Of
/// roam only points, boxes and triangles are used. docs/format.md, "Certificates", describes the file.
///
/// An accepted certificate proves: the body goes from the first place to the last by straight segments without a break,
/// and changes its size only at rest or in a vertical motion. Along each segment its axis is at least `clearance` -
/// 1e-9 m from every triangle, and `clearance` is at least the radius minus 1e-6 m. Lengths are metres.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "roam/mesh.h"

namespace roam::checking {

/// Identifies a scene: its number of triangles, and the sum of the hashes of their coordinates, in any order.
struct SceneSum {
  std::uint64_t triangles = 0, hash = 0;
  void add(const Triangle& triangle);
  bool operator==(const SceneSum&) const = default;
};

struct Size {
  double radius = 0.0, half_height = 0.0;  ///< half_height: of the vertical axis; 0 for a sphere
  bool operator==(const Size&) const = default;
};

/// One straight motion of the body's centre. The axis is claimed to be at least `clearance` from every triangle.
struct Segment {
  Vec3 from{0.0}, to{0.0};
  Size size;
  double clearance = 0.0;
};

struct Certificate {
  SceneSum scene;
  std::vector<Size> sizes;
  std::vector<Segment> segments;  ///< not empty
};

/// Half a sentence: why a certificate is refused.
struct Refused : std::runtime_error {
  Refused(const std::string& why, std::uint64_t number) : std::runtime_error(why), segment(number) {}
  std::uint64_t segment;  ///< its number, from 1; 0: not one segment is wrong
};
inline constexpr const char* first_line = "roam certificate 1";
inline constexpr std::uint64_t most_segments = 5'000'000;
/// The last line of a certificate that begins with `text`.
[[nodiscard]] std::string checksum_line(std::string_view text);
/// Throws std::invalid_argument for a damaged text, Refused for one that does not hold together, whatever the scene.
[[nodiscard]] Certificate read_certificate(std::string_view text);

/// Whether the axis is at least `distance` (> 0) from the triangle all along. True is certain; false is wrong by a few
/// roundings at most, less than 1e-9 m for triangles within 100 km.
[[nodiscard]] bool apart(const Segment& segment, const Triangle& triangle, double distance);

/// Add every triangle of the scene, then call finish(). The certificate must outlive it.
class Checker {
 public:
  explicit Checker(const Certificate& certificate);
  void add(const Triangle& triangle);
  void finish() const;  ///< throws Refused, naming the first wrong segment, unless all is proven

 private:
  void search(std::size_t node, const Triangle& triangle, const Box& box);

  const Certificate& certificate_;
  std::vector<Box> tree_;  ///< boxes of runs of segments: node i holds nodes 2 i and 2 i + 1; the root is 1
  SceneSum seen_;
  std::size_t refused_;           ///< the first segment that is nearer than it says; else their number
  std::uint64_t refused_by_ = 0;  ///< the triangle
};

}  // namespace roam::checking
