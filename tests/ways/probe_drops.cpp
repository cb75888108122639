// Ways that a body goes in one direction only: down a step that it cannot climb.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "messages.h"
#include "probed_room.h"
#include "roam/probe.h"
#include "walker_scenes.h"
#include "words/probe.h"

namespace {

using namespace scenes;
using namespace roam;
using Kind = ProbeLimit::Kind;

constexpr ProbedSize person{.radius = 0.3, .height = 1.8};

/// Floors 4 m wide and `length` long, one behind the other from x = 0, each lower than the one before by a drop.
Mesh terraces(const std::vector<double>& drops, double length) {
  Mesh m;
  double x = 0.0, z = 0.0;
  add_floor(m, 0.0, -2.0, length, 2.0, z);
  for (const double drop : drops) {
    x += length;
    add_wall(m, x, -2.0, x, 2.0, z - drop, z);
    z -= drop;
    add_floor(m, x, -2.0, x + length, 2.0, z);
  }
  return m;
}

/// Over `terraces` 5 m long, down from the first to the last.
ProbeQuestion down(const std::vector<double>& drops) {
  double bottom = 0.0;
  for (const double drop : drops) bottom -= drop;
  return {
      .from = {1.0, 0.2, 1.0}, .to = {5.0 * static_cast<double>(drops.size()) + 4.0, -0.3, bottom + 1.0}, .step = 0.35};
}

ProbeQuestion back(ProbeQuestion question) {
  std::swap(question.from, question.to);
  return question;
}

TEST(Drops, LetABodyDownButNotBackUp) {
  const Survey survey = survey_of(terraces({0.45}, 5.0));
  const ProbeAnswer answer = probe(survey, down({0.45}), person);
  EXPECT_TRUE(answer.passable && answer.wide_enough && answer.passage.found);
  ASSERT_EQ(answer.drops.size(), 1U);
  EXPECT_NEAR(answer.drops[0].height(), 0.45, 1e-3);
  EXPECT_NEAR(answer.drops[0].rim.x, 5.0, 0.02);
  ASSERT_TRUE(answer.walk);
  EXPECT_EQ(answer.walk->outcome, Outcome::reached);
  const ProbeAnswer up = probe(survey, back(down({0.45})), person);
  EXPECT_FALSE(up.passable || up.wide_enough);
  EXPECT_TRUE(up.drops.empty());
  ASSERT_TRUE(up.limit);
  EXPECT_EQ(up.limit->kind, Kind::step);
  EXPECT_NEAR(up.limit->size, 0.45, 1e-3);
}

TEST(Drops, FollowOneAnotherAndArePartOfTheWay) {
  const std::vector<double> drops{0.45, 0.2, 0.6};
  const Survey survey = survey_of(terraces(drops, 5.0));
  const ProbeAnswer answer = probe(survey, down(drops), person);
  EXPECT_TRUE(answer.passable);
  ASSERT_EQ(answer.drops.size(), 2U) << "the body climbs 0.2 m";
  EXPECT_NEAR(answer.drops[0].height(), 0.45, 1e-3);
  EXPECT_NEAR(answer.drops[1].height(), 0.6, 1e-3);
  EXPECT_LT(answer.drops[0].rim.x, answer.drops[1].rim.x);
  double length = 0.0;
  const std::vector<Vec3>& way = answer.passage.way;
  const Body body = Body::capsule(person.radius - 5e-4, person.height);
  for (std::size_t i = 1; i < way.size(); ++i) {
    length += glm::distance(way[i - 1], way[i]);
    const Vec3 centre = way[i - 1] + Vec3(0.0, 0.0, 0.5 * person.height + 1e-3);
    EXPECT_FALSE(survey.world().first_impact(body, centre, way[i] - way[i - 1]).hit && way[i].z < way[i - 1].z - 0.3);
  }
  EXPECT_NEAR(answer.passage.length, length, 1e-9);
  EXPECT_EQ(way.front(), answer.start);
  EXPECT_EQ(way.back(), answer.target);
}

// A drop of more than radius + step is a fall.
TEST(Drops, AreNoDeeperThanAWalkerGoesDown) {
  EXPECT_TRUE(probe(survey_of(terraces({0.64}, 5.0)), down({0.64}), person).passable);
  for (const double deep : {0.66, 1.5}) {
    const ProbeAnswer answer = probe(survey_of(terraces({deep}, 5.0)), down({deep}), person);
    EXPECT_FALSE(answer.passable || answer.passage.found) << deep;
    EXPECT_TRUE(answer.drops.empty()) << deep;
  }
}

TEST(Drops, AreTakenWhereTheStairsBesideAreTooNarrow) {
  // A stage 0.45 m high. Its stairs, behind a door of 0.5 m, are too narrow for the body.
  Mesh m;
  add_floor(m, 0.0, -2.0, 5.0, 2.0, 0.45);
  add_wall(m, 5.0, -2.0, 5.0, 2.0, 0.0, 0.45);
  add_floor(m, 5.0, -4.0, 10.0, 2.0, 0.0);
  add_floor(m, 0.0, -4.0, 5.0, -2.0, 0.0);
  add_wall(m, 0.0, -2.0, 5.0, -2.0, 0.0, 0.45);
  add_box(m, {1.75, -2.4, 0.0}, {2.25, -2.0, 0.225});
  add_wall(m, 0.0, -2.0, 1.75, -2.0, 0.45, 3.0);
  add_wall(m, 2.25, -2.0, 5.0, -2.0, 0.45, 3.0);
  const ProbeQuestion question{.from = {2.0, 0.0, 1.0}, .to = {8.0, 0.0, 1.0}};
  const Survey survey = survey_of(m);
  const ProbeAnswer narrow = probe(survey, question, {.radius = 0.2, .height = 1.8});
  EXPECT_TRUE(narrow.passable && narrow.drops.empty()) << "of two ways, it takes the one that leads back too";
  const ProbeAnswer answer = probe(survey, question, person);
  EXPECT_TRUE(answer.passable);
  EXPECT_EQ(answer.drops.size(), 1U);
  EXPECT_GE(answer.passage.radius, 0.3);
  const ProbeAnswer up = probe(survey, back(question), person);
  EXPECT_FALSE(up.passable);
  ASSERT_TRUE(up.limit);
  EXPECT_EQ(up.limit->kind, Kind::door);
}

TEST(Drops, LeadThroughNoWall) {
  Mesh m = terraces({0.45}, 5.0);
  add_wall(m, 5.0, -2.0, 5.0, 2.0, 0.0, 3.0);
  EXPECT_FALSE(probe(survey_of(m), down({0.45}), person).passable);
  Mesh window = terraces({0.45}, 5.0);
  add_wall(window, 5.0, -2.0, 5.0, -0.25, 0.0, 3.0);
  add_wall(window, 5.0, 0.25, 5.0, 2.0, 0.0, 3.0);
  EXPECT_FALSE(probe(survey_of(window), down({0.45}), person).passable);
  EXPECT_TRUE(probe(survey_of(window), down({0.45}), {.radius = 0.2, .height = 1.8}).passable);
}

/// A hall 0.45 m over the floor beside it. A door 0.5 m wide leads to a balcony, from which a body steps down to that
/// floor, anywhere along 14 m. Walls shut the hall itself.
Mesh balcony() {
  Mesh m;
  add_floor(m, 0.0, 0.0, 14.0, 4.0, 0.45);
  add_wall(m, 0.0, 4.0, 6.75, 4.0, 0.0, 3.0);
  add_wall(m, 7.25, 4.0, 14.0, 4.0, 0.0, 3.0);
  add_floor(m, 0.0, 4.0, 14.0, 6.0, 0.45);
  add_wall(m, 0.0, 6.0, 14.0, 6.0, 0.0, 0.45);
  add_floor(m, 0.0, 6.0, 14.0, 10.0, 0.0);
  add_wall(m, 0.0, 0.0, 14.0, 0.0, 0.0, 3.0);
  add_wall(m, 0.0, 0.0, 0.0, 10.0, 0.0, 3.0);
  add_wall(m, 14.0, 0.0, 14.0, 10.0, 0.0, 3.0);
  return m;
}

TEST(Drops, ThatNoWayLeadsToAreNoLimitOfTheSearch) {
  const ProbeQuestion question{.from = {7.0, 2.0, 1.0}, .to = {7.0, 8.0, 1.0}};
  const Survey survey = survey_of(balcony());
  const ProbeAnswer answer = probe(survey, question, person);
  EXPECT_FALSE(answer.passable);
  EXPECT_TRUE(answer.passage.complete);
  EXPECT_FALSE(words::is_unknown(answer));
  EXPECT_TRUE(probe(survey, question, {.radius = 0.2, .height = 1.8}).passable);
}

TEST(Drops, AreNotKnownOnceTheSearchComesToItsLimit) {
  const std::vector<double> drops{0.45, 0.45, 0.45, 0.45, 0.45, 0.45};
  const Survey survey = survey_of(terraces(drops, 5.0));
  ProbeQuestion question = down(drops);
  EXPECT_TRUE(probe(survey, question, person).passable);
  question.most_places = 1500;  // two terraces have 1,100
  const ProbeAnswer answer = probe(survey, question, person);
  EXPECT_FALSE(answer.passable || answer.passage.found);
  EXPECT_FALSE(answer.passage.complete);
  EXPECT_TRUE(words::is_unknown(answer));
  EXPECT_TRUE(words::report(question, answer).sentences().starts_with("NOT KNOWN")) << answer.passage.places;
}

TEST(Drops, AreNotKnownBehindTooManyOthers) {
  const std::vector<double> drops(70, 0.45);
  ProbeQuestion question = down(drops);
  question.to = {70.0 * 1.2 + 0.6, 0.0, -0.45 * 70.0 + 1.0};
  question.from.x = 0.6;
  const ProbeAnswer answer = probe(survey_of(terraces(drops, 1.2)), question, person);
  EXPECT_FALSE(answer.passable);
  EXPECT_TRUE(words::is_unknown(answer));
}

// The places of a complete part are looked through without a new place.
TEST(Drops, AreNoLongerLookedForOnceCancelled) {
  const Survey survey = survey_of(terraces({0.45}, 60.0));
  std::uint64_t last = 0;
  int same = 0, most_same = 0, most = 1'000'000;
  ProbeQuestion question{.from = {1.0, 0.2, 1.0}, .to = {119.0, 0.0, 0.55}, .step = 0.35};
  question.progress = [&](std::uint64_t places) {
    same = places == last ? same + 1 : 0;
    last = places;
    most_same = std::max(most_same, same);
    return same < most;
  };
  EXPECT_TRUE(probe(survey, question, person).passable);
  EXPECT_GE(most_same, 20) << "6,000 places";
  most = 20;
  EXPECT_THROW(static_cast<void>(probe(survey, question, person)), Cancelled);
}

TEST(Drops, AreNamedInTheAnswer) {
  const ProbeQuestion question = down({0.45});
  const ProbeAnswer answer = probe(survey_of(terraces({0.45}, 5.0)), question, person);
  const std::string text = words::report(question, answer).sentences();
  EXPECT_TRUE(text.starts_with("YES")) << text;
  EXPECT_TRUE(contains(text, "Narrowest: nothing leaves less than")) << text;
  EXPECT_TRUE(contains(text, "One way: down 0.450 m at (5.0")) << text;
}

}  // namespace
