#include "verification.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "roam/error.h"
#include "swept_distance.h"

namespace roam::app {
namespace {

// Pieces that look through all triangles together. More share the look but spread over more of the scene; halving
// (see check) narrows the candidates down either way.
constexpr std::size_t pieces_together = 1024;

struct Candidate {
  std::uint32_t mesh;
  std::uint32_t triangle;
};

Box box_of(const Triangle& triangle) {
  Box box;
  for (const Vec3& corner : triangle) box.include(corner);
  return box;
}

/// All that may lie within reach of the piece. Each bound is rounded outward once more than its sums were rounded.
Box box_of(const Piece& piece) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double reach = std::nextafter(std::max(piece.body.radius, piece.clearance), infinity);
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

bool meet(const Box& a, const Box& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

/// What a run of pieces found; runs are joined in the order of the walk, so that the result does not depend on threads.
class Check {
 public:
  Check(std::span<const Mesh> meshes, std::span<const TriangleId> first_ids) : meshes_(meshes), first_ids_(first_ids) {}

  void run(std::span<const Piece> pieces) {
    const Box box = box_of_all(pieces);
    std::vector<Candidate> candidates;
    for (std::uint32_t m = 0; m < meshes_.size(); ++m) {
      const Mesh& mesh = meshes_[m];
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (meet(box, box_of(mesh.triangle(t)))) candidates.push_back({m, t});
      }
    }
    halve(pieces, candidates);
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

  /// Halves the pieces until one is left; each half keeps the triangles that its box meets.
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
    for (const Candidate& c : candidates) {
      const long double distance = swept_distance(piece.from, piece.to, piece.body.half_height, triangle(c));
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

  std::span<const Mesh> meshes_;
  std::span<const TriangleId> first_ids_;
};

/// The number of steps in runs that are each ascending and follow each other.
std::uint64_t count_steps(const std::vector<Check>& runs, std::vector<std::uint64_t> Check::*steps) {
  std::uint64_t count = 0;
  std::optional<std::uint64_t> last;
  for (const Check& run : runs) {
    for (const std::uint64_t step : run.*steps) {
      count += last != step ? 1 : 0;
      last = step;
    }
  }
  return count;
}

}  // namespace

Verification verify(std::span<const Mesh> meshes, std::span<const Piece> pieces,
                    const std::function<bool(std::uint64_t)>& progress) {
  std::vector<TriangleId> first_ids;
  TriangleId next = 0;
  for (const Mesh& mesh : meshes) {
    first_ids.push_back(next);
    next += mesh.triangles.size();
  }
  const std::size_t count = (pieces.size() + pieces_together - 1) / pieces_together;
  std::vector<Check> runs(count, Check(meshes, first_ids));
  std::mutex mutex;
  std::uint64_t done = 0;
  bool cancelled = false;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1), [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      {
        const std::scoped_lock lock(mutex);
        if (cancelled) return;
      }
      const std::size_t begin = i * pieces_together;
      const auto run = pieces.subspan(begin, std::min(pieces_together, pieces.size() - begin));
      runs[i].run(run);
      const std::scoped_lock lock(mutex);
      done += run.size();
      if (progress && !progress(done)) cancelled = true;
    }
  });
  if (cancelled) throw Cancelled();

  Verification result;
  result.pieces = pieces.size();
  result.violations = count_steps(runs, &Check::violations);
  result.overstated = count_steps(runs, &Check::overstated);
  for (const Check& run : runs) {
    result.distances += run.distances;
    if (run.least_gap) {
      const auto gap = static_cast<double>(*run.least_gap);
      result.least_gap = std::min(result.least_gap.value_or(gap), gap);
    }
    if (!run.worst) continue;
    if (!result.worst || run.worst->radius - run.worst->distance > result.worst->radius - result.worst->distance) {
      result.worst = run.worst;
    }
  }
  return result;
}

}  // namespace roam::app
