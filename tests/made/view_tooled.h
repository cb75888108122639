#pragma once
/// A session of roam view in which a test clicks.

#include <array>
#include <string>
#include <vector>

#include "view_stores.h"

namespace view_stores {

/// A body in a room of 20 m x 4 m x 3 m, at (10, 0), looking along +x.
class Tooled : public Driven {
 public:
  explicit Tooled(bool has_store = false) { start(has_store, room_obj()); }
  /// With options of its own, before begin().
  explicit Tooled(const app::ViewOptions& with, bool has_store = false, const std::string& scene = room_obj()) {
    options.section = with.section;
    options.hide = with.hide;
    options.pass_hidden = with.pass_hidden;
    options.verify = with.verify;
    start(has_store, scene);
  }
  /// At a point of the picture, from -1 to 1.
  void click(double x, double y, int times = 1) {
    session->stage().draw();  // one clicks on what one sees
    const auto [across, up] = window_place(x, y);
    for (int i = 0; i < times; ++i) {
      events().mouseButtonPress(across, up, 1);
      events().mouseButtonRelease(across, up, 1);
    }
    run(1.0 / 60.0);
  }
  /// Drags with the left button from one point of the picture to another.
  void drag(const std::array<double, 2>& from, const std::array<double, 2>& to) {
    hold_at(from);
    run(0.1);
    drag_to(to);
    run(0.1);
    let_go();
    run(1.0 / 60.0);
  }
  /// The same in pieces; drag_to() runs a frame.
  void hold_at(const std::array<double, 2>& at) {
    session->stage().draw();
    held_ = window_place(at[0], at[1]);
    events().mouseButtonPress(held_[0], held_[1], 1);
  }
  void drag_to(const std::array<double, 2>& at) {
    held_ = window_place(at[0], at[1]);
    events().mouseMotion(held_[0], held_[1]);
    run(1.0 / 60.0);
  }
  void let_go() { events().mouseButtonRelease(held_[0], held_[1], 1); }
  void point_at(double x, double y) {
    const auto [across, up] = window_place(x, y);
    events().mouseMotion(across, up);
    run(1.0 / 60.0);
  }
  [[nodiscard]] std::vector<app::Measurement> measured() { return finish().measurements; }

 private:
  std::array<float, 2> held_{};

  [[nodiscard]] std::array<float, 2> window_place(double x, double y) {
    const osgGA::GUIEventAdapter& now = *events().getCurrentEventState();
    const bool upwards = now.getMouseYOrientation() == osgGA::GUIEventAdapter::Y_INCREASING_UPWARDS;
    const auto place = [](double share, float least, float most) {
      return least + static_cast<float>(0.5 * (1.0 + share)) * (most - least);
    };
    return {place(x, now.getXmin(), now.getXmax()), place(upwards ? y : -y, now.getYmin(), now.getYmax())};
  }
  void start(bool has_store, const std::string& scene) {
    write_scene(scene);
    options.size = "640x360";  // the panel of the status leaves room for the plan
    options.at = {10, 0, 0.95, 0};
    if (has_store) build();
    begin();
    run(0.5);
    EXPECT_EQ(on_store(), has_store);
  }
};

}  // namespace view_stores
