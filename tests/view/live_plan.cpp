// The live plan by itself.
#include "view/live_plan.h"

#include <atomic>
#include <memory>
#include <string>

#include "roam/collector.h"
#include "roam/error.h"
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

}  // namespace
