#include "verify/verification.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>

#include "roam/error.h"
#include "verify/swept_distance.h"

namespace roam::verification {
namespace {

// Pieces that share one pass over all triangles. More pieces share the pass but spread over more of the scene. Halving
// (see check) reduces the candidates in both cases.
constexpr std::size_t pieces_together = 1024;

struct Candidate {
  std::uint32_t mesh;
  std::uint32_t triangle;
};

constexpr double infinity = std::numeric_limits<double>::infinity();

Box box_of(const Triangle& triangle) {
  Box box;
  for (const Vec3& corner : triangle) box.include(corner);
  return box;
}

/// Metres. Surfaces this near to the body are measured too: it stands or slides on them with a slightly smaller
/// certified clearance.
constexpr double beside = 0.01;

/// Triangles within this distance of the axis are measured, m.
double reach_of(const Piece& piece) { return std::max(piece.body.radius, piece.clearance) + beside; }

/// A box of everything within reach of the piece. Each bound is rounded outward once more than its sums.
Box box_of(const Piece& piece) {
  const double reach = std::nextafter(reach_of(piece), infinity);
  Box box;
  box.include(piece.from);
  box.include(piece.to);
  for (int k = 0; k < 3; ++k) {
    const double grow = k == 2 ? std::nextafter(reach + piece.body.half_height, infinity) : reach;
    box.lower[k] = std::nextafter(box.lower[k] - grow, -infinity);
    box.upper[k] = std::nextafter(box.upper[k] + grow, infinity);
  }
  return box;
}

/// Finds triangles near a piece by balls around them: a box around an oblique way contains much that is far from it.
class Neighbourhood {
 public:
  explicit Neighbourhood(const Piece& piece)
      : from_(piece.from), way_(piece.to - piece.from), half_height_(piece.body.half_height) {
    const double level = way_.x * way_.x + way_.y * way_.y;
    per_length_ = inverse(level + way_.z * way_.z);
    per_level_ = inverse(level);
  }

  /// Returns false if the triangle is certainly farther than `reach` from all places that the piece's axis passes.
  [[nodiscard]] bool may_hold(const Triangle& triangle, double reach) const {
    const Box box = box_of(triangle);
    const Vec3 middle = box.center();
    double round = 0.0;
    for (const Vec3& corner : triangle) round = std::max(round, glm::distance(corner, middle));
    // Two lower bounds of the axis's distance: that of the centre's way less half of the height, and the one seen from
    // above.
    const Vec3 to = middle - from_;
    const Vec3 nearest = to - std::clamp(glm::dot(to, way_) * per_length_, 0.0, 1.0) * way_;
    const double s = std::clamp((to.x * way_.x + to.y * way_.y) * per_level_, 0.0, 1.0);
    const double level = std::hypot(to.x - s * way_.x, to.y - s * way_.y);
    const double distance = std::max(glm::length(nearest) - half_height_, level);
    // A dozen operations, each rounded by 2^-53 of at most these values. 2^-40 far exceeds their sum.
    const double rounding = 0x1p-40 * (glm::length(to) + glm::length(way_) + half_height_ + round + reach);
    return !(distance - round - rounding > reach);
  }

 private:
  /// 0 for a piece without length, whose end is its start.
  static double inverse(double square) { return square > 0.0 ? 1.0 / square : 0.0; }

  Vec3 from_, way_;
  double half_height_;
  double per_length_ = 0.0, per_level_ = 0.0;
};

/// Metres. A way this far outside a scene's box is not in that scene.
constexpr double outside = 10.0;

/// A clearance of 0 means a held body, which says nothing about its surroundings.
bool touches(const Piece& piece) { return std::abs(piece.clearance - piece.body.radius) <= beside; }

bool meet(const Box& a, const Box& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

void sort_and_unite(std::vector<std::uint64_t>& steps) {
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
}

}  // namespace

/// Consecutive pieces and their findings. Runs are joined in the order of the walk, so the result does not depend on
/// threads.
class Verifier::Run {
 public:
  explicit Run(std::span<const Piece> pieces) : pieces_(pieces), box_(box_of_all(pieces)) {}

  [[nodiscard]] std::size_t size() const { return pieces_.size(); }

  /// `boxes`: of all vertices of each mesh.
  void check(std::span<const Mesh> meshes, std::span<const Box> boxes, std::span<const TriangleId> first_ids) {
    meshes_ = meshes;
    first_ids_ = first_ids;
    std::vector<Candidate> candidates;
    for (std::uint32_t m = 0; m < meshes.size(); ++m) {
      const Mesh& mesh = meshes[m];
      if (!meet(box_, boxes[m])) continue;
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (meet(box_, box_of(mesh.triangle(t)))) candidates.push_back({m, t});
      }
    }
    halve(pieces_, candidates);
    sort_and_unite(violations);
    sort_and_unite(overstated);
  }

  std::uint64_t distances = 0;
  std::vector<std::uint64_t> violations;  ///< steps, ascending, without repetition
  std::vector<std::uint64_t> overstated;  ///< the same
  std::optional<long double> least_gap;
  std::optional<Violation> worst;

 private:
  static Box box_of_all(std::span<const Piece> pieces) {
    Box box;
    for (const Piece& piece : pieces) box.include(box_of(piece));
    return box;
  }

  Triangle triangle(const Candidate& c) const { return meshes_[c.mesh].triangle(c.triangle); }

  /// Halves the pieces until one is left. Each half keeps the triangles that its box meets.
  void halve(std::span<const Piece> pieces, std::span<const Candidate> candidates) {
    if (pieces.empty() || candidates.empty()) return;
    const Box box = box_of_all(pieces);
    std::vector<Candidate> kept;
    for (const Candidate& c : candidates) {
      if (meet(box, box_of(triangle(c)))) kept.push_back(c);
    }
    if (pieces.size() == 1) return measure(pieces.front(), kept);
    halve(pieces.first(pieces.size() / 2), kept);
    halve(pieces.subspan(pieces.size() / 2), kept);
  }

  void measure(const Piece& piece, std::span<const Candidate> candidates) {
    const auto count_once = [&](std::vector<std::uint64_t>& steps) {
      if (steps.empty() || steps.back() != piece.step) steps.push_back(piece.step);
    };
    const Neighbourhood near(piece);
    const double reach = reach_of(piece);
    for (const Candidate& c : candidates) {
      const Triangle t = triangle(c);
      // A triangle farther than the radius and the certified clearance may still be the nearest of all.
      const double nearest = least_gap ? piece.body.radius + static_cast<double>(*least_gap) : infinity;
      if (!near.may_hold(t, std::max(reach, nearest))) continue;
      const long double distance = swept_distance(piece.from, piece.to, piece.body.half_height, t);
      const long double gap = distance - piece.body.radius;
      ++distances;
      least_gap = std::min(least_gap.value_or(gap), gap);
      if (distance - piece.clearance < -static_cast<long double>(certificate_slack)) count_once(overstated);
      if (!(gap < -static_cast<long double>(radius_slack))) continue;
      count_once(violations);
      const Violation found{piece.step, first_ids_[c.mesh] + c.triangle, static_cast<double>(distance),
                            piece.body.radius};
      if (!worst || found.radius - found.distance > worst->radius - worst->distance) worst = found;
    }
  }

  std::span<const Piece> pieces_;
  Box box_;
  // For the current check.
  std::span<const Mesh> meshes_;
  std::span<const TriangleId> first_ids_;
};

void Verification::add(const Verification& other) {
  pieces += other.pieces;
  distances += other.distances;
  violations += other.violations;
  overstated += other.overstated;
  touching += other.touching;
  way.include(other.way);
  scene.include(other.scene);
  for (const std::string& what : other.unread) {
    if (std::find(unread.begin(), unread.end(), what) == unread.end()) unread.push_back(what);
  }
  if (other.least_gap) least_gap = std::min(least_gap.value_or(*other.least_gap), *other.least_gap);
  if (!other.worst) return;
  if (!worst || other.worst->radius - other.worst->distance > worst->radius - worst->distance) worst = other.worst;
}

std::string summary(const Verification& found) {
  return fmt::format("{} violations in {} straight pieces against {}", found.violations, found.pieces,
                     found.unread.empty() ? "all triangles" : "those triangles that can be read");
}

std::vector<std::string> remarks(const Verification& found) {
  std::vector<std::string> lines;
  if (found.pieces > 0 && found.distances == 0 && found.unread.empty()) {
    const bool elsewhere = !meet(found.way, found.scene.grown(outside)) || 2 * found.touching > found.pieces;
    lines.emplace_back(elsewhere ? "no triangle came near any of them: is it the scene, as it lies (--up, --unit)?"
                                 : "nothing had to be measured: all triangles are farther away than is certified");
  }
  if (found.overstated > 0)
    lines.push_back(fmt::format("{} steps claim more clearance than there is", found.overstated));
  if (found.worst) {
    lines.push_back(fmt::format("worst at step {}: {:.9f} m from triangle {}, radius {:g} m", found.worst->step,
                                found.worst->distance, found.worst->triangle, found.worst->radius));
  }
  return lines;
}

void demand_all_read(const Verification& found, const std::string& store, const std::string& besides) {
  if (found.unread.empty()) return;
  const std::size_t more = found.unread.size() - 1;
  throw Error::at(
      store,
      fmt::format("the way could not be verified everywhere: {}{}; {}mend the store by `roam verify {} --repair SCENE`",
                  found.unread.front(), more > 0 ? fmt::format(", nor could {} more", more) : "",
                  besides.empty() ? "" : besides + ", or ", store));
}

Verifier::Verifier(std::span<const Piece> pieces) : pieces_(pieces.size()) {
  for (const Piece& piece : pieces) {
    way_.include(piece.from);
    way_.include(piece.to);
    touching_ += touches(piece) ? 1 : 0;
  }
  for (std::size_t begin = 0; begin < pieces.size(); begin += pieces_together) {
    runs_.emplace_back(pieces.subspan(begin, std::min(pieces_together, pieces.size() - begin)));
  }
}
Verifier::~Verifier() = default;

void Verifier::check(std::span<const Mesh> meshes, TriangleId first,
                     const std::function<bool(std::uint64_t)>& progress) {
  std::vector<TriangleId> first_ids;
  std::vector<Box> boxes(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    first_ids.push_back(first);
    first += meshes[m].triangles.size();
    for (const Vec3& vertex : meshes[m].vertices) boxes[m].include(vertex);
    scene_.include(boxes[m]);
  }
  std::mutex mutex;
  std::uint64_t done = 0;
  bool cancelled = false;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, runs_.size(), 1),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        {
                          const std::scoped_lock lock(mutex);
                          if (cancelled) return;
                        }
                        runs_[i].check(meshes, boxes, first_ids);
                        const std::scoped_lock lock(mutex);
                        done += runs_[i].size();
                        if (progress && !progress(done)) cancelled = true;
                      }
                    });
  if (cancelled) throw Cancelled();
}

Verification Verifier::result() const {
  // The number of distinct steps. Each run's steps ascend, and runs follow each other.
  const auto count_steps = [&](std::vector<std::uint64_t> Run::*steps) {
    std::uint64_t count = 0;
    std::optional<std::uint64_t> last;
    for (const Run& run : runs_) {
      for (const std::uint64_t step : run.*steps) {
        count += last != step ? 1 : 0;
        last = step;
      }
    }
    return count;
  };
  Verification result;
  result.pieces = pieces_;
  result.touching = touching_;
  result.way = way_;
  result.scene = scene_;
  result.violations = count_steps(&Run::violations);
  result.overstated = count_steps(&Run::overstated);
  for (const Run& run : runs_) {
    Verification one;
    one.distances = run.distances;
    if (run.least_gap) one.least_gap = static_cast<double>(*run.least_gap);
    one.worst = run.worst;
    result.add(one);
  }
  return result;
}

Verification verify(std::span<const Mesh> meshes, std::span<const Piece> pieces,
                    const std::function<bool(std::uint64_t)>& progress) {
  Verifier verifier(pieces);
  verifier.check(meshes, 0, progress);
  return verifier.result();
}

}  // namespace roam::verification
