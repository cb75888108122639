#pragma once
/// \file
/// Measurements along the way of a body: where it is narrowest, and where the headroom is least.
///
///     roam::measure::Along along(space, settings, roam::Mode::walk);
///     along.put(walker.position());
///     while (!route.done()) along.add(route.advance());
///     if (along.narrowest()) std::cout << along.narrowest()->width << " m\n";
///
/// Lengths are metres. Nothing is measured for a ghost.

#include <cstdint>
#include <optional>
#include <vector>

#include "measure/room.h"
#include "roam/step_report.h"

namespace roam::measure {

/// A position with an obstacle on the left and one on the right, where the body can go on and back by its radius.
struct NarrowPlace {
  Vec3 centre{0.0};
  Body body;                    ///< the size of the body there
  double along = 0.0;           ///< length of the way up to there
  double from = 0.0, to = 0.0;  ///< lengths of the way between which it is narrower than list_narrower() says
  double width = 0.0;  ///< free width, level, within 45 degrees of across the way: how wide a body of this shape may be
  Vec3 left{0.0}, right{0.0};  ///< the ends of the width, at the height of the centre
  TriangleId left_triangle = no_triangle, right_triangle = no_triangle;
  [[nodiscard]] double spare() const { return 0.5 * (width - 2.0 * body.radius); }  ///< on each side, in the middle
};

struct LowPlace {
  Vec3 centre{0.0};
  double along = 0.0;
  double height = 0.0;  ///< from the body's lowest point to the obstacle above it
  TriangleId triangle = no_triangle;
};

class Along {
 public:
  /// Measures every half radius, at 20,000 positions of a step at most. `space` must outlive it.
  Along(const Space& space, const WalkerSettings& settings, Mode mode, double least_reach = 0.0);
  /// From now on measures every 5 cm, and narrow() lists all places narrower than `width`. Places no farther apart than
  /// the body is wide count as one.
  void list_narrower(double width);

  void put(const Vec3& centre);                   ///< moves the body there, without a way
  void go(const Vec3& centre, const Body& body);  ///< the body moves straight there
  void add(const StepReport& report);             ///< the segments of a step of a Walker
  void finish();                                  ///< after the last of them, if places are listed

  [[nodiscard]] const std::optional<NarrowPlace>& narrowest() const { return narrowest_; }
  [[nodiscard]] const std::optional<LowPlace>& lowest() const { return lowest_; }
  [[nodiscard]] const std::vector<NarrowPlace>& narrow() const { return narrow_; }
  [[nodiscard]] std::uint64_t ducked() const { return ducked_; }      ///< how often a Walker crouched
  [[nodiscard]] std::uint64_t measured() const { return measured_; }  ///< positions

 private:
  void measure(const Vec3& centre, const Body& body, const Vec3& heading);
  /// Two sweeps: the width at an angle from straight across.
  [[nodiscard]] std::optional<NarrowPlace> width_at(const Vec3& centre, const Body& body, const Vec3& heading,
                                                    double angle) const;
  [[nodiscard]] NarrowPlace refined(const NarrowPlace& place, const Vec3& heading) const;
  void close_group();

  Room room_;
  Mode mode_;
  double between_;         ///< positions
  double narrower_ = 0.0;  ///< 0: nothing is listed
  std::optional<Vec3> last_;
  double length_ = 0.0;      ///< of the way
  double until_next_ = 0.0;  ///< measurement, seen from above
  std::optional<NarrowPlace> narrowest_, group_;
  std::optional<LowPlace> lowest_;
  std::vector<NarrowPlace> narrow_;
  std::uint64_t ducked_ = 0, measured_ = 0;
};

}  // namespace roam::measure
