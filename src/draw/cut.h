#pragma once
/// \file
/// Cuts planes out of a scene: level ones for plans, upright ones along the way for sections.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "draw/geometry.h"
#include "draw/levels.h"
#include "draw/way.h"
#include "roam/mesh.h"

namespace roam::draw {

/// The corners of a triangle, turned as the plan is.
using TurnedTriangle = std::array<Vec3, 3>;

/// The cut of the plane at `height` with a triangle. None if they do not meet, or if the triangle lies in the plane.
/// Two triangles with a common edge are cut at the same point, bit by bit.
[[nodiscard]] std::optional<Segment> cut_level(const TurnedTriangle& triangle, double height);

/// A plan to cut.
struct PlanView {
  LevelMap map;
  std::vector<double> cuts;   ///< heights of the levels, ascending, metres
  std::vector<double> below;  ///< metres below each level of further cuts, which show lower surfaces
  /// Triangles whose normal's z exceeds this are ground to walk on. At body height they are drawn as lower surfaces.
  /// Further down they are not cut: contour lines would look like steps. 1 or more: no triangle counts.
  double ground = 1.0;
};

/// PlanView::ground for slopes of 45 degrees.
inline constexpr double usual_ground = 0.7071;

struct PlanCut {
  std::vector<Segment> walls;  ///< at body height, in metres of the plan
  std::vector<Segment> below;  ///< lower surfaces: at the depths `below`, the lower of two storeys, and rising ground
  double grid = 0.0;           ///< metres that ends were rounded to, because there are many; 0: they were not
};

/// A stretch of the way, straight when seen from above, for the section.
struct Stretch {
  Point from{0.0}, to{0.0};  ///< in the plan, metres; distinct
  double along = 0.0;        ///< of `from`, metres
  double lowest = 0.0;       ///< least height of the cut, metres
  double highest = 0.0;
};

/// The stretches of a way, extended by `beyond` metres at both ends.
[[nodiscard]] std::vector<Stretch> stretches(const Way& way, const Turn& turn, double beyond, double lowest,
                                             double highest);

struct Cuts {
  std::vector<PlanCut> plans;                  ///< one for each view
  std::vector<std::vector<Segment>> sections;  ///< what each frame shows: (along, height), metres
  std::vector<double> grids;                   ///< of each section, as PlanCut::grid, along the way
};

/// Cuts a scene that arrives in parts, on all cores. The result does not depend on their number.
class Cutter {
 public:
  /// The section is shown in `frames`, at their scales. Views, section and frames must outlive it. Holds at most about
  /// `most` segments of each plan and each frame. If there are more, rounds their ends to a grid and removes
  /// duplicates, as in joined().
  Cutter(const Turn& turn, std::span<const PlanView> views, std::span<const Stretch> section,
         std::span<const Frame> frames, std::size_t most = std::numeric_limits<std::size_t>::max());
  ~Cutter();

  /// Box of all cuts, metres of the scene; empty if there are none.
  [[nodiscard]] Box box() const;
  /// Cuts these triangles. Calls `goes_on` now and then, from one thread at a time, with the number of triangles done
  /// in total.
  void add(std::span<const Mesh> meshes, const std::function<void(std::uint64_t)>& goes_on);
  [[nodiscard]] Cuts take();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The same for a whole scene, with all of the section in one frame.
[[nodiscard]] Cuts cut(std::span<const Mesh> meshes, const Turn& turn, std::span<const PlanView> views,
                       std::span<const Stretch> section, const std::function<void(std::uint64_t)>& goes_on);

}  // namespace roam::draw
