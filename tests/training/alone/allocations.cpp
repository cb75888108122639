// Where memory runs out, searches, probes and training throw, and the next call has the same result. Instrumented
// builds have an operator new of their own.
#include <gtest/gtest.h>

#include "fallible_calls.h"
#include "roam/probe.h"
#include "roam/train.h"
#include "train_scenes.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

using namespace roam;

std::string bits_of(const Training& t) {
  Bits bits;
  bits << t.radius << t.smallest << t.largest.value_or(0.0) << t.places << t.paths.size() << t.cracks.size()
       << t.complete << t.feasible << t.regions.size();
  for (const TrainedPath& path : t.paths) {
    for (const Vec3& p : path.way) bits << p;
  }
  return bits;
}

class TrainingAllocations : public testing::Test {
 protected:
  const Survey survey_ = corridor({.door = 1.0, .split = 0.4, .depth = 2.0});
  const Vec3 from_{1.0, 0.0, 1.0}, to_{9.0, 0.0, 1.0};
};

TEST_F(TrainingAllocations, OfWays) {
  const ProbeQuestion question{.from = from_, .to = to_, .spacing = 0.8};
  const std::array<ProbedSize, 2> sizes{ProbedSize{0.3, 1.8}, ProbedSize{0.7, 1.8}};
  const ProbeAnswer answer = probe(survey_, question, sizes[0]);
  const auto way = [&](Mode mode, double height) {
    return [&, mode, height] {
      const Passage p = widest_way(survey_, from_, to_, {.mode = mode, .height = height, .spacing = 0.8});
      Bits bits;
      bits << p.radius << p.bound << p.length;
      for (const Vec3& v : p.way) bits << v;
      return std::string(bits);
    };
  };
  fail_calls({
      {"Survey::build", [&] { return std::string(Bits() << survey_of({corridor_mesh({.door = 1.0})}).triangles()); }},
      {.name = "widest_way", .bits = way(Mode::walk, 1.8), .later = true, .dense = 8, .steps = 2},
      {.name = "widest_way of a sphere", .bits = way(Mode::walk, 0.0), .later = true, .dense = 4, .steps = 1},
      {.name = "widest_way in flight", .bits = way(Mode::fly, 0.0), .later = true, .dense = 4, .steps = 1},
      {.name = "probe of two sizes",
       .bits =
           [&] {
             const std::vector<ProbeAnswer> all = probe(survey_, question, sizes);
             return std::string(Bits() << all[0].passable << all[1].passable << all[1].missing << all[1].limit->point);
           },
       .later = true,
       .dense = 4,
       .steps = 1},
      {.name = "probed_path and probed_reach",
       .bits =
           [&] {
             const ProbeReach reach = probed_reach(survey_, question, answer, 50);
             return std::string(Bits() << probed_path(survey_, question, answer).size() << reach.from_start.size()
                                       << reach.from_target.size());
           },
       .later = true,
       .dense = 4,
       .steps = 1},
  });
}

TEST_F(TrainingAllocations, OfTraining) {
  const auto trained = [&](TrainOptions options) {
    return [&, options] {
      const Training t = train(survey_, options);
      return bits_of(t) + profile_of(t, survey_).scene.hash;
    };
  };
  // Walking is tried through the C interface.
  const TrainOptions paper{.method = Method::paper, .paths = 1, .radius_max = 0.6, .height = 1.8, .spacing = 0.8};
  fail_calls({
      {.name = "train by the paper's method",
       .bits = trained(paper),
       .later = true,
       .dense = 3,
       .steps = 2,
       .most = 2000},
  });
}

}  // namespace
#endif
