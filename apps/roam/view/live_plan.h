#pragma once
/// \file
/// The live plan beside the picture.

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graphics/plan_panel.h"
#include "osgRoam/Manipulator.h"
#include "view/hidden_space.h"
#include "view/probing.h"

namespace roam::app {

/// Cuts the collision data at body height around the body, in a thread of its own, and shows the cut with the body and
/// its trail. A store is read from disk for that, apart from its pager. Call all members from the thread that draws,
/// between two frames.
class LivePlan {
 public:
  LivePlan(graphics::Frame& frame, osgRoam::Manipulator& roamer) : panel_(frame), roamer_(roamer) {}
  ~LivePlan();  ///< waits for the thread, some milliseconds
  LivePlan(const LivePlan&) = delete;
  LivePlan& operator=(const LivePlan&) = delete;

  /// From none to small, large, and none again.
  void cycle();
  [[nodiscard]] graphics::PlanSize size() const { return size_; }
  /// As of PlanPanel.
  [[nodiscard]] graphics::Rectangle place() const { return panel_.place(); }
  /// The body was put where it is now: its trail begins anew there.
  void jump() { has_jumped_ = true; }
  /// The trail: pairs of points, metres in the scene.
  [[nodiscard]] std::vector<Vec3> trail() const;
  /// A way that is shown; empty: none.
  void set_way(const ProbedWay& way);
  /// Call it in each frame. `visible` false: nothing is shown or cut. `met`: the walls.
  void update(bool visible, HiddenSpace::Met met, const std::vector<graphics::PlanPlace>& places);
  /// The metres at a point of the picture, x and y in [-1, 1]; none outside of the plan.
  [[nodiscard]] std::optional<glm::dvec2> at(double x, double y) const { return panel_.at(x, y); }
  /// Sends the body to a point of the plan, as a double click in the picture does: to the floor there on which it can
  /// stand and whose height is nearest to its own. Returns the reason if there is none, else nothing.
  std::string go(double x, double y);
  /// Shows more (> 1) or less.
  void zoom(double factor);

  /// The reason why the last cut failed, such as a store that cannot be read. Empty: none, or it was taken before.
  [[nodiscard]] std::string take_problem() { return std::exchange(problem_, {}); }
  /// The walls that are shown: pairs of points, metres in the scene seen from above.
  [[nodiscard]] std::vector<glm::dvec2> walls() const;

 private:
  struct Wish {
    HiddenSpace::Met met;
    Vec3 centre{0.0};   ///< at the height of the cut
    double low = 0.0;   ///< height of the lower cut
    double half = 0.0;  ///< m
  };
  [[nodiscard]] static Box box_of(const Wish& wish);
  [[nodiscard]] static graphics::PlanLines cut(const Wish& wish, const std::atomic<bool>& stops);
  [[nodiscard]] double half() const;  ///< m; there must be a walker
  [[nodiscard]] bool is_stale(const Wish& wish) const;
  void follow();
  void receive();

  graphics::PlanPanel panel_;
  osgRoam::Manipulator& roamer_;
  graphics::PlanSize size_ = graphics::PlanSize::none;
  double half_ = 12.0;  ///< m, of the small plan
  std::atomic<bool> stops_ = false;
  std::future<graphics::PlanLines> cutting_;
  std::optional<Wish> wished_;  ///< for the last cut, which is shown, running or failed; none while nothing is shown
  std::optional<graphics::PlanLines> shown_;
  std::string problem_;
  struct TrailPoint {
    Vec3 at{0.0};
    bool is_first = false;  ///< no line leads to it
  };
  std::vector<TrailPoint> trail_;
  bool has_jumped_ = false;
  std::size_t trail_shown_ = 0;
  ProbedWay way_;
  bool is_way_new_ = false;
};

}  // namespace roam::app
