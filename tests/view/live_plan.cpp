// The live plan by itself.
#include "view/live_plan.h"

#include <atomic>
#include <cmath>
#include <memory>
#include <string>

#include "roam/collector.h"
#include "roam/error.h"
#include "roam/world.h"
#include "view_tooled.h"

namespace {

using namespace roam;

/// A space that cannot be read.
class Unreadable final : public Space {
 public:
  [[nodiscard]] SpaceFacts facts() const override { return {.bounds = {Vec3(-50.0), Vec3(50.0)}}; }
  [[nodiscard]] Object object(TriangleId) const override { return {}; }
  mutable std::atomic<int> queries{0};

 protected:
  [[nodiscard]] FirstImpact find_first(const Query&, Vicinity*) const override {
    ++queries;
    throw Error("the store cannot be read");
  }
  void find_near(const Query&, Collector&, Vicinity*) const override {}
};

TEST(LivePlan, SaysOnceThatItsSpaceCannotBeRead) {
  view_stores::Tooled d;
  const auto unreadable = std::make_shared<Unreadable>();
  std::string problem;
  app::LivePlan plan(d.session->stage().frame(), d.session->roamer());
  plan.cycle();
  EXPECT_TRUE(d.until([&] {
    plan.update(true, {unreadable, {}}, {});
    if (problem.empty()) problem = plan.take_problem();
    return !problem.empty();
  }));
  EXPECT_EQ(problem, "the store cannot be read");
  const int queries = unreadable->queries;
  for (int i = 0; i < 100; ++i) {
    plan.update(true, {unreadable, {}}, {});
    d.run(1.0 / 60.0);
  }
  EXPECT_EQ(plan.take_problem(), "");
  EXPECT_EQ(unreadable->queries, queries) << "the same place is not read again";
}

TEST(LivePlan, KeepsNoSpaceWhileItIsNotShown) {
  view_stores::Tooled d;
  app::LivePlan plan(d.session->stage().frame(), d.session->roamer());
  plan.cycle();
  auto space = std::make_shared<const World>();
  const std::weak_ptr<const World> seen = space;
  plan.update(true, {std::move(space), {}}, {});
  EXPECT_FALSE(seen.expired());
  EXPECT_TRUE(d.until([&] {
    plan.update(false, {d.session->roamer().space(), {}}, {});
    return seen.expired();
  }));
}

TEST(LivePlan, BreaksItsTrailWhereTheBodyIsPut) {
  view_stores::Tooled d;
  d.tap('l');
  const Vec3 begin = d.place();
  d.press('w');
  d.run(2.0);
  d.release('w');
  d.run(0.5);
  ASSERT_GT(d.place().x, begin.x + 1.0);
  d.tap(osgGA::GUIEventAdapter::KEY_Home);
  d.run(0.5);
  ASSERT_NEAR(d.place().x, begin.x, 0.1);
  d.press('s');
  d.run(1.0);
  const std::vector<Vec3> trail = d.session->tools().plan().trail();
  ASSERT_GT(trail.size(), 8u);
  for (std::size_t i = 0; i < trail.size(); i += 2) EXPECT_LT(std::abs(trail[i].x - trail[i + 1].x), 0.6);
  EXPECT_LT(trail.back().x, begin.x);
}

}  // namespace
