// What goes wrong inside the viewer's loop stays there, and is said.
#include <glm/geometric.hpp>

#include "osg_rig.h"

namespace {

using namespace scenes;
using rig::Rig;

TEST(ManipulatorFailures, ASpaceThatFailsStopsTheBodyAndSaysWhy) {
  struct Failing final : roam::Space {
    roam::Impact sweep(const roam::Body&, const Vec3&, const Vec3&) const override {
      if (broken) throw roam::Error("the disk is gone");
      return {};
    }
    std::size_t contacts(const roam::Body&, const Vec3&, const Vec3&, double, std::span<roam::Contact>) const override {
      return 0;
    }
    roam::Clearance clearance(const roam::Body&, const Vec3&, const Vec3&, double reach) const override {
      roam::Clearance c;
      c.distance = reach;
      return c;
    }
    roam::Box bounds() const override { return {Vec3(-1.0), Vec3(1.0)}; }
    double largest_error() const override { return 0.0; }
    std::string object_name(roam::TriangleId) const override { return {}; }
    bool broken = false;
  };
  const auto space = std::make_shared<Failing>();
  Rig r;
  r->setSpace(std::shared_ptr<const roam::Space>(space));
  r.down('w');
  r.frames(0.5);
  const Vec3 before = r->eye();
  space->broken = true;
  r.frames(0.5);
  EXPECT_EQ(r->problem(), "the disk is gone");
  EXPECT_TRUE(r->held());
  space->broken = false;
  r.frames(0.5);
  EXPECT_EQ(r->eye(), before);
  r->setPose({0.0, 0.0, 0.0}, 0.0, 0.0);
  EXPECT_EQ(r->problem(), "");
  r.frames(0.5);
  EXPECT_GT(glm::length(r->eye()), 0.5);
}

TEST(ManipulatorFailures, ACallbackThatThrowsDoesNotReachTheViewer) {
  Rig r(floor_mesh(), {}, roam::Mode::walk);
  r->setStepCallback([](const roam::StepReport&, double) { throw roam::Error("the trace is full"); });
  r.down('w');
  EXPECT_NO_THROW(r.frames(0.1));
  EXPECT_EQ(r->problem(), "the trace is full");
}

}  // namespace
