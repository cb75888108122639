#pragma once
/// \file
/// What planes cut out of a scene: level ones for plans, upright ones along the way for sections.

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

/// Where the plane at `height` cuts a triangle. None where it does not, and for a triangle that lies in it. The same
/// edge of two triangles is cut at the same point, bit by bit.
[[nodiscard]] std::optional<Segment> cut_level(const TurnedTriangle& triangle, double height);

/// A plan that is to be cut.
struct PlanView {
  LevelMap map;
  std::vector<double> cuts;   ///< heights of the levels, ascending, metres
  std::vector<double> below;  ///< how far under each level is cut again, to show what lies below; metres
  /// Triangles whose normal's z is more than this are ground to walk on. At body height they are shown as what lies
  /// below; further down they are not cut: contour lines would look like steps. 1 or more: there are none.
  double ground = 1.0;
};

struct PlanCut {
  std::vector<Segment> walls;  ///< at body height, in metres of the plan
  std::vector<Segment> below;  ///< what lies below: at the depths `below`, the lower of two storeys, and rising ground
};

/// A stretch of the way, straight when seen from above, along which is cut.
struct Stretch {
  Point from{0.0}, to{0.0};  ///< in the plan, metres; not the same
  double along = 0.0;        ///< of `from`, metres
  double lowest = 0.0;       ///< heights between which is cut, metres
  double highest = 0.0;
};

/// The stretches of a way, led on straight by `beyond` metres at both ends.
[[nodiscard]] std::vector<Stretch> stretches(const Way& way, const Turn& turn, double beyond, double lowest,
                                             double highest);

struct Cuts {
  std::vector<PlanCut> plans;    ///< one for each view
  std::vector<Segment> section;  ///< (along, height), metres
};

/// Cuts a scene that comes little by little, on all cores; the result does not depend on how many.
class Cutter {
 public:
  /// The views and the section must stay. Of each plan and of the section no more than about `most` segments are held:
  /// where there are more, their ends are rounded to a grid and what is there twice is left out, as in joined().
  Cutter(const Turn& turn, std::span<const PlanView> views, std::span<const Stretch> section,
         std::size_t most = std::numeric_limits<std::size_t>::max());
  ~Cutter();

  /// Where all lies that is cut, metres of the scene. Empty where nothing is.
  [[nodiscard]] Box box() const;
  /// Cuts these triangles. `goes_on` is called now and then, from one thread at a time, with the number of triangles
  /// done in all.
  void add(std::span<const Mesh> meshes, const std::function<void(std::uint64_t)>& goes_on);
  [[nodiscard]] Cuts take();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The same for a scene that is there as a whole.
[[nodiscard]] Cuts cut(std::span<const Mesh> meshes, const Turn& turn, std::span<const PlanView> views,
                       std::span<const Stretch> section, const std::function<void(std::uint64_t)>& goes_on);

}  // namespace roam::draw
