#pragma once
/// \file
/// Scenes in which instances move, and a judge of the bodies in them.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "posed_scenes.h"
#include "roam/move_instances.h"

namespace moving {

using posed::Scene;
using roam::Mesh;
using roam::Mode;
using roam::ObjectId;
using roam::Pose;
using roam::Stopped;
using roam::Vec3;
using roam::Walker;
using roam::WalkerSettings;

constexpr double dt = 1.0 / 60.0;

/// A body's position some seconds after a call began, with its `height` and `radius` at that time.
struct At {
  Vec3 place;
  double height, radius;
};
inline At at_time(const roam::StepReport& r, double time) {
  At at{r.from, r.height, r.radius};
  double begin = 0.0;
  for (const roam::Segment& c : r.segments) {
    at.height = c.height;
    at.radius = c.radius;
    if (c.time >= time) {
      const double part = c.time > begin ? std::max(0.0, time - begin) / (c.time - begin) : 1.0;
      at.place += part * (c.position - at.place);
      return at;
    }
    at.place = c.position;
    begin = c.time;
  }
  return at;
}

/// A moving scene, the bodies in it, and a judge of both.
struct Stage {
  Scene scene;
  std::vector<std::unique_ptr<Walker>> walkers;
  std::vector<Walker*> list;
  int samples = 8;  ///< judged instants of each movement

  explicit Stage(Mesh still) : scene(std::move(still)) {}

  Walker& add(const WalkerSettings& settings, Mode mode, const Vec3& feet) {
    walkers.push_back(std::make_unique<Walker>(scene.space, settings, mode, feet + Vec3(0.0, 0.0, 1.0)));
    walkers.back()->place_feet(feet);
    list.push_back(walkers.back().get());
    return *walkers.back();
  }

  /// The triangles after a part of a movement.
  [[nodiscard]] Mesh posed(const std::vector<Pose>& from, double part) const {
    Mesh all = scene.still;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
      const Pose& to = scene.space.pose(scene.ids[i]);
      posed::append(all, scene.parts[i],
                    {from[i].position + part * (to.position - from[i].position),
                     from[i].heading + part * (to.heading - from[i].heading)});
    }
    return all;
  }

  /// Moves the instances. Judges every body at many instants if only one instance moves.
  std::vector<Stopped> advance(double seconds = dt) {
    std::vector<Pose> poses;
    int moving = 0;
    for (const ObjectId id : scene.ids) {
      poses.push_back(scene.space.pose(id));
      const roam::Velocity& v = scene.space.velocity(id);
      moving += v.linear != Vec3(0.0) || v.turning != 0.0 ? 1 : 0;
    }
    std::vector<Vec3> before;
    for (const Walker* w : list) before.push_back(w->position());
    std::vector<Stopped> stopped = roam::move_instances(scene.space, list, seconds);
    const double moved = stopped.empty() ? seconds : stopped[0].time;
    for (int i = 0; i <= samples; ++i) {
      if (moving != 1 && i != samples) continue;
      const double part = double(i) / samples;
      const Mesh all = posed(poses, part);
      const scenes::Judge judge(all);
      for (std::size_t k = 0; k < list.size(); ++k) {
        const Walker& w = *list[k];
        if (w.mode() == Mode::ghost || w.held()) continue;
        const bool was_moved = w.position() != before[k];
        const At at =
            was_moved ? at_time(w.report(), part * moved) : At{w.position(), w.body().height(), w.body().radius};
        const double distance = judge.distance(roam::Body::capsule(at.radius, at.height), at.place, at.radius + 0.1);
        EXPECT_GE(distance, at.radius - 1.1e-6) << "body " << k << " at " << part << " of the movement";
        if (was_moved) {
          EXPECT_GE(distance, std::min(w.report().least_gap, 0.1) + at.radius - 1.1e-6);
        }
      }
    }
    return stopped;
  }
  void step(Walker& walker, const roam::WalkerInput& input = {}, double seconds = dt) {
    const roam::StepReport& r = walker.step(input, seconds);
    const Mesh all = scene.whole();
    EXPECT_GE(scenes::margin(scenes::Judge(all), r), -1e-7);
  }
  void run(double seconds, const roam::WalkerInput& input = {}) {
    for (double t = 0.0; t < seconds - 0.5 * dt; t += dt) {
      advance();
      for (Walker* w : list) step(*w, input);
    }
  }
};

inline Mesh ground() {
  Mesh m;
  scenes::add_floor(m, -50.0, -50.0, 50.0, 50.0, 0.0);
  return m;
}

/// A plate of 4 m by 4 m and 0.2 m around its origin, its top at 0.
inline Mesh plate() {
  Mesh m;
  scenes::add_box(m, {-2.0, -2.0, -0.2}, {2.0, 2.0, 0.0});
  return m;
}

/// A door leaf of 1 m by 2.1 m, 4 cm thick, its hinge at the origin.
inline Mesh door() {
  Mesh m;
  scenes::add_box(m, {0.0, -0.02, 0.02}, {1.0, 0.02, 2.1});
  return m;
}

/// A car of 12 m by 3 m by 2.5 m with walls, floor at 0, seats in rows.
inline Mesh car() {
  Mesh m;
  scenes::add_box(m, {-6.0, -1.5, 0.0}, {6.0, 1.5, 2.5});
  for (int i = 0; i < 4; ++i) scenes::add_box(m, {-4.0 + 2.0 * i, -1.5, 0.0}, {-3.4 + 2.0 * i, -0.5, 0.45});
  return m;
}

}  // namespace moving
