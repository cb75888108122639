#pragma once
/// \file
/// A space that changes between two steps of a walker, and counts its queries.

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "roam/collector.h"
#include "walker_judged.h"

namespace scenes {

/// A room whose walls may change from one step to the next.
class ChangingRoom final : public roam::Space {
 public:
  explicit ChangingRoom(Mesh mesh, bool tells) : tells_(tells) { become(std::move(mesh)); }

  void become(Mesh mesh) {
    mesh_ = std::make_unique<Mesh>(std::move(mesh));
    world_ = std::make_unique<World>(build(*mesh_));
    if (tells_) ++revision_;
  }
  [[nodiscard]] Judge judge() const { return Judge(*mesh_); }
  [[nodiscard]] int asked() const { return asked_; }

  [[nodiscard]] roam::SpaceFacts facts() const override {
    roam::SpaceFacts facts = world_->facts();
    facts.revision = tells_ ? std::optional(revision_) : std::nullopt;
    facts.speed_limit = limit;
    return facts;
  }
  [[nodiscard]] roam::Object object(roam::TriangleId triangle) const override { return world_->object(triangle); }

  double limit = std::numeric_limits<double>::infinity();  ///< m/s
  /// If set, a downward sweep meets a plane with this normal at once, as it may for a body in contact with a wall.
  std::optional<Vec3> clings;

 protected:
  [[nodiscard]] roam::FirstImpact find_first(const roam::Query& query, roam::Vicinity*) const override {
    ++asked_;
    const Vec3& motion = query.motion;
    roam::FirstImpact first = Space::find_first_of(*world_, query, nullptr);
    if (clings && motion.x == 0.0 && motion.y == 0.0 && motion.z < 0.0) {
      first.hit = true;
      first.time = 0.0;
      first.contact = roam::Contact{{query.from + Vec3(query.body.radius, 0.0, 0.0), *clings, roam::Feature::face, 0.0},
                                    first.triangle};
    }
    return first;
  }
  void find_near(const roam::Query& query, roam::Collector& collector, roam::Vicinity*) const override {
    asked_ += collector.kind() == roam::Collector::Kind::one_contact ? 0 : 1;
    Space::find_near_of(*world_, query, collector, nullptr);
  }

 private:
  std::unique_ptr<Mesh> mesh_;
  std::unique_ptr<World> world_;
  bool tells_;
  std::uint64_t revision_ = 0;
  mutable int asked_ = 0;
};

/// A hall of 20 m by 20 m by 10 m about the origin.
inline Mesh hall() {
  Mesh m;
  add_box(m, {-10.0, -10.0, -5.0}, {10.0, 10.0, 5.0});
  return m;
}

/// The same with a wall at x across it.
inline Mesh walled_hall(double x) {
  Mesh m = hall();
  add_wall(m, x, -10.0, x, 10.0, -5.0, 5.0);
  return m;
}

}  // namespace scenes
