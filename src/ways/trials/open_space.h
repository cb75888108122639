#pragma once
/// \file
/// A world around which there is room: who flies over it along a planned way has not left the scene.

#include "roam/world.h"

namespace roam::ways {

class OpenSpace final : public Space {
 public:
  /// `world` must outlive it. `around`: metres on each side of its box.
  OpenSpace(const World& world, double around) : world_(world), bounds_(world.bounds().grown(around)) {}

  [[nodiscard]] Impact sweep(const Body& body, const Vec3& from, const Vec3& motion) const override {
    return world_.sweep(body, from, motion);
  }
  std::size_t contacts(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                       std::span<Contact> contacts) const override {
    return world_.contacts(body, from, motion, reach, contacts);
  }
  using Space::clearance;
  [[nodiscard]] Clearance clearance(const Body& body, const Vec3& from, const Vec3& motion,
                                    double reach) const override {
    return world_.clearance(body, from, motion, reach);
  }
  [[nodiscard]] double gap(const Body& body, const Vec3& from, const Vec3& motion, double reach) const override {
    return world_.gap(body, from, motion, reach);
  }
  [[nodiscard]] Impact sweep_in(Vicinity& vicinity, const Body& body, const Vec3& from,
                                const Vec3& motion) const override {
    return world_.sweep_in(vicinity, body, from, motion);
  }
  [[nodiscard]] double gap_in(Vicinity& vicinity, const Body& body, const Vec3& from, const Vec3& motion,
                              double reach) const override {
    return world_.gap_in(vicinity, body, from, motion, reach);
  }
  using Space::floor_clearance;
  [[nodiscard]] Clearance floor_clearance(const Body& body, const Vec3& place, double reach,
                                          const Floor& floor) const override {
    return world_.floor_clearance(body, place, reach, floor);
  }
  [[nodiscard]] Box bounds() const override { return bounds_; }
  [[nodiscard]] double largest_error() const override { return world_.largest_error(); }
  [[nodiscard]] std::string object_name(TriangleId triangle) const override { return world_.object_name(triangle); }
  [[nodiscard]] std::uint64_t revision() const override { return world_.revision(); }
  [[nodiscard]] bool tells_changes() const override { return true; }

 private:
  const World& world_;
  Box bounds_;
};

}  // namespace roam::ways
