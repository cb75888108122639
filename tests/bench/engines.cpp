// Each engine that is here gives the answers of a search through all triangles, within its own tolerance.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>

#include "bench/closed_form.h"
#include "bench/comparison.h"
#include "bench/engine.h"
#include "bench/query_sets.h"
#include "sanitizer.h"

namespace roam::bench {
namespace {

Scene gallery() { return make_scene({.scene = "gallery", .triangles = 10'000}); }

/// The first touch, by the closed forms on every triangle.
Answer search(const Scene& scene, const Query& query) {
  using Wide = long double;
  constexpr Wide behind_end = 2.0L;
  Wide first = behind_end;
  for (const Mesh& mesh : scene.meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Corners<Wide> corner;
      for (std::size_t k = 0; k < 3; ++k) corner[k] = Point<Wide>(mesh.triangle(i)[k]) - Point<Wide>(query.from);
      extrude(corner, Wide(query.body.half_height), [&](const Corners<Wide>& part) {
        first = time_of_impact(part, Point<Wide>(query.motion), Wide(query.body.radius), first);
      });
    }
  }
  return first <= 1 ? Answer{true, static_cast<double>(first)} : Answer{};
}

struct Asked {
  std::string set;
  std::vector<Query> queries;
  std::vector<Answer> truth;
};

/// Some queries of each set, and their answers.
const std::vector<Asked>& all_asked(const Scene& scene) {
  static const std::vector<Asked> all = [&] {
    constexpr std::size_t count = 50;
    const Reference reference(scene.meshes);
    std::vector<Asked> made;
    for (const std::string& set : query_set_names()) {
      Asked& asked = made.emplace_back(Asked{set, make_queries(set, count, reference).queries, {}});
      for (const Query& query : asked.queries) asked.truth.push_back(search(scene, query));
    }
    return made;
  }();
  return all;
}

/// How much earlier and later than the search an engine may stop, in metres along the way: at a grazing touch that is
/// much more than its error in depth.
struct Tolerance {
  double early = 2e-3, late = 2e-4;
};
const std::map<std::string, Tolerance> tolerances{
    {"bullet", {2e-2, 1e-3}},    {"fcl", {2e-2, 1e-4}},  {"jolt", {5e-3, 5e-3}},
    {"jolt-wasm", {5e-2, 5e-3}}, {"box3d", {2e-3, 0.1}},  // 5 mm deep
};

/// Engines that say when they hit, and are meant to be right. Those in node are there if ROAM_TEST_NODE_MODULES names
/// the folder whose node_modules hold them.
std::vector<EngineOffer> offers() {
  const char* modules = std::getenv("ROAM_TEST_NODE_MODULES");
  std::vector<EngineOffer> all = engine_offers({.wasm = modules == nullptr ? "" : modules});
  std::erase_if(all,
                [](const EngineOffer& offer) { return offer.name == "paper" || offer.name.starts_with("polytope"); });
  return all;
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const EngineOffer& offer : offers()) all.push_back(offer.name);
  return all;
}

class EngineAnswers : public testing::TestWithParam<std::string> {};

TEST_P(EngineAnswers, AreThoseOfASearchThroughAllTriangles) {
  const std::vector<EngineOffer> all = offers();
  const auto offer = std::find_if(all.begin(), all.end(), [](const EngineOffer& o) { return o.name == GetParam(); });
  if (!offer->make) GTEST_SKIP() << offer->name << " is not here: " << offer->missing;
  const Scene scene = gallery();
  const Engine engine = offer->make(scene);
  // The memory of WebAssembly may be large enough, and a sanitizer counts none.
  EXPECT_TRUE(engine.bytes > 0 || offer->name.ends_with("-wasm") || roam::test::has_sanitizer);
  const auto found = tolerances.find(offer->name);
  const Tolerance allowed = found == tolerances.end() ? Tolerance{} : found->second;
  for (const Asked& asked : all_asked(scene)) {
    std::vector<Answer> answers(asked.queries.size());
    std::vector<double> nanoseconds(asked.queries.size());
    engine.ask(asked.queries, nanoseconds, answers);
    std::size_t hits = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const double late = (answers[i].time - asked.truth[i].time) * glm::length(asked.queries[i].motion);
      EXPECT_LT(late, allowed.late) << asked.set << ", query " << i;
      EXPECT_GT(late, -allowed.early) << asked.set << ", query " << i;
      hits += asked.truth[i].hit && answers[i].hit ? 1 : 0;
    }
    EXPECT_GT(hits, 5U) << asked.set;
  }
}

TEST_P(EngineAnswers, ToRaysAndNearestPointsAreThoseOfTheReference) {
  const std::vector<EngineOffer> all = offers();
  const auto offer = std::find_if(all.begin(), all.end(), [](const EngineOffer& o) { return o.name == GetParam(); });
  if (!offer->make) GTEST_SKIP() << offer->name << " is not here: " << offer->missing;
  const Scene scene = gallery();
  const std::vector<Engine> engines{offer->make(scene)};
  if (!engines[0].rays && !engines[0].nearest) GTEST_SKIP() << offer->name << " has no such queries";
  const Reference reference(scene.meshes);
  for (const std::string& name : point_set_names()) {
    const QuerySet set = make_queries(name, 200, reference);
    const std::vector<EngineRun> runs = compare(engines, set, reference, {.rounds = 1, .patience = 10.0});
    ASSERT_EQ(runs.size(), set.kind == QueryKind::ray || engines[0].nearest ? 1U : 0U) << name;
    if (runs.empty()) continue;
    const Verdict& verdict = runs[0].verdict;
    EXPECT_EQ(runs[0].failure, "");
    EXPECT_EQ(verdict.queries, 200U);
    EXPECT_GT(verdict.hits, 50U) << name;
    EXPECT_EQ(verdict.missed + verdict.early + verdict.false_hits, 0U) << name;
    EXPECT_LT(verdict.deepest, offer->name == "roam" ? 1e-9 : offer->name == "jolt" ? 5e-3 : 2e-3) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, EngineAnswers, testing::ValuesIn(names()), [](const auto& test) {
  std::string name = test.param;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace roam::bench
