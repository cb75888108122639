#pragma once
/// \file
/// A space that changes between two steps of a walker, and counts what it is asked.

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "walker_judged.h"

namespace scenes {

/// A room whose walls may be others from one step to the next.
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

  [[nodiscard]] roam::Impact sweep(const roam::Body& body, const Vec3& from, const Vec3& motion) const override {
    ++asked_;
    roam::Impact s = world_->sweep(body, from, motion);
    if (clings && motion.x == 0.0 && motion.y == 0.0 && motion.z < 0.0) {
      s.hit = true;
      s.time = s.distance = 0.0;
      s.feature = roam::Feature::face;
      s.point = from + Vec3(body.radius, 0.0, 0.0);
      s.normal = *clings;
    }
    return s;
  }
  std::size_t contacts(const roam::Body& body, const Vec3& from, const Vec3& motion, double reach,
                       std::span<roam::Contact> contacts) const override {
    ++asked_;
    return world_->contacts(body, from, motion, reach, contacts);
  }
  using Space::clearance;
  [[nodiscard]] roam::Clearance clearance(const roam::Body& body, const Vec3& from, const Vec3& motion,
                                          double reach) const override {
    ++asked_;
    return world_->clearance(body, from, motion, reach);
  }
  [[nodiscard]] double gap(const roam::Body& body, const Vec3& from, const Vec3& motion, double reach) const override {
    ++asked_;
    return world_->gap(body, from, motion, reach);
  }
  using Space::floor_clearance;
  [[nodiscard]] roam::Clearance floor_clearance(const roam::Body& body, const Vec3& place, double reach,
                                                const roam::Floor& floor) const override {
    ++asked_;
    return world_->floor_clearance(body, place, reach, floor);
  }
  [[nodiscard]] roam::Box bounds() const override { return world_->bounds(); }
  [[nodiscard]] double largest_error() const override { return world_->largest_error(); }
  [[nodiscard]] std::string object_name(std::uint64_t triangle) const override { return world_->object_name(triangle); }
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }
  [[nodiscard]] bool tells_changes() const override { return tells_; }
  [[nodiscard]] double speed_limit() const override { return limit; }

  double limit = std::numeric_limits<double>::infinity();  ///< m/s
  /// Where set, a way down meets a plane with this normal at once, as that of a body in touch with a wall may.
  std::optional<Vec3> clings;

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

/// The same with a wall across it at x.
inline Mesh walled_hall(double x) {
  Mesh m = hall();
  add_wall(m, x, -10.0, x, 10.0, -5.0, 5.0);
  return m;
}

}  // namespace scenes
