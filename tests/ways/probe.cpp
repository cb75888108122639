// Whether a body gets from one place to another, as a program asks it.
#include "roam/probe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "messages.h"
#include "probed_room.h"
#include "walker_scenes.h"
#include "words/measures.h"
#include "words/probe.h"

namespace {

using namespace scenes;
using namespace roam;
using Kind = ProbeLimit::Kind;

ProbeQuestion by_flight(ProbeQuestion question) {
  question.mode = Mode::fly;
  return question;
}

TEST(Probe, SaysYesOfAWayThatAWalkerHasGone) {
  const Survey survey = survey_of(room(0.84));
  const ProbeAnswer answer = probe(survey, across, {.radius = 0.3, .height = 1.8});
  EXPECT_TRUE(answer.passable && answer.wide_enough);
  ASSERT_TRUE(answer.limit && answer.walk);
  EXPECT_EQ(answer.limit->kind, Kind::door);
  EXPECT_NEAR(answer.limit->size, 0.84, 1e-3);
  EXPECT_EQ(answer.missing, 0.0);
  EXPECT_EQ(answer.walk->outcome, Outcome::reached);
  EXPECT_LT(glm::distance(answer.walk->on_way, answer.target), 0.05);
  const std::vector<Vec3> path = probed_path(survey, across, answer);
  ASSERT_GE(path.size(), 2u);
  EXPECT_NEAR(path.front().z, 0.9, 1e-3) << "of the centre";
  Walker walker(survey.world(), probed_body(across, answer.size), Mode::walk, path.front());
  EXPECT_EQ(follow(walker, path).outcome, Outcome::reached);
}

TEST(Probe, LeavesRoomForTheBodyAboveAStepOfAnyHeight) {
  const Survey survey = survey_of(room(0.9));
  ProbeQuestion question = across;
  question.step = 900.0;
  for (const double height : {1.7, 1.8, 1.9}) {
    EXPECT_TRUE(probe(survey, question, {.radius = 0.3, .height = height}).passable) << height;
  }
}

TEST(Probe, SaysNoAndWhatIsMissing) {
  const ProbeAnswer answer = probe(survey_of(room(0.5)), across, {.radius = 0.3, .height = 1.8});
  EXPECT_FALSE(answer.passable || answer.wide_enough || answer.walk);
  EXPECT_NEAR(answer.missing, 0.1, 1e-3);
}

TEST(Probe, CallsWhatIsBetweenTwoSidesAGapWhenFlyingAndProvesIt) {
  const ProbeAnswer answer = probe(survey_of(room(0.5)), by_flight(across), {.radius = 0.3, .height = 0.6});
  EXPECT_FALSE(answer.passable);
  ASSERT_TRUE(answer.limit);
  EXPECT_EQ(answer.limit->kind, Kind::gap);
  EXPECT_NEAR(answer.limit->size, 0.5, 1e-3);
  EXPECT_NEAR(answer.missing, 0.1, 1e-3);
  EXPECT_TRUE(answer.proven);
  EXPECT_GE(answer.passage.bound, answer.passage.radius);
  EXPECT_LT(answer.passage.bound, 0.3);
}

TEST(Probe, CallsASphereUnderSomethingLowALintel) {
  Mesh m;
  add_box(m, {0.0, -2.0, 0.0}, {20.0, 2.0, 3.0});
  add_wall(m, 10.0, -2.0, 10.0, 2.0, 0.5, 3.0);
  const ProbeAnswer answer = probe(survey_of(m), across, {.radius = 0.3, .height = 0.6});
  EXPECT_FALSE(answer.passable);
  ASSERT_TRUE(answer.limit);
  EXPECT_EQ(answer.limit->kind, Kind::lintel);
  EXPECT_NEAR(answer.limit->size, 0.5, 2e-3);
  EXPECT_NEAR(answer.missing, 0.1, 2e-3);
}

/// room(0.84) with a cupboard along the wall at y = 2 and 0.5 m from it, from x = 16 to 19.
Mesh room_with_cupboard() {
  Mesh m = room(0.84);
  add_box(m, {16.0, 1.0, 0.0}, {19.0, 1.5, 2.0});
  return m;
}

TEST(Probe, TellsWhichEndIsInTheWayAndWhereThereIsRoom) {
  ProbeQuestion question = across;
  question.to = {17.5, 1.85, 1.0};
  const ProbeAnswer answer = probe(survey_of(room_with_cupboard()), question, {.radius = 0.3, .height = 1.8});
  EXPECT_FALSE(answer.passable);
  ASSERT_TRUE(answer.limit && answer.room);
  EXPECT_EQ(answer.limit->kind, Kind::target);
  EXPECT_NEAR(answer.limit->size, 0.15, 1e-3);
  EXPECT_NEAR(answer.missing, 0.15, 1e-3);
  EXPECT_GT(glm::distance(*answer.room, answer.target), 0.5);
}

TEST(Probe, MovesAnEndBesideAWallByAtMostTheRadiusAndALittle) {
  const Survey survey = survey_of(room(0.84));
  // Near the wall at y = 2, and nearer to it: both go to the nearest place with room.
  for (const double beside : {1.69, 1.75, 1.9, 1.93, 1.99}) {
    ProbeQuestion question = across;
    question.from = {2.0, beside, 1.0};
    question.to = {18.0, -beside, 1.0};
    const ProbeAnswer answer = probe(survey, question, {.radius = 0.3, .height = 1.8});
    EXPECT_TRUE(answer.passable) << beside;
    const double least = std::max(0.0, beside - 1.7);
    for (const auto& [given, place] : {std::pair(question.from, answer.start), std::pair(question.to, answer.target)}) {
      EXPECT_GE(std::hypot(place.x - given.x, place.y - given.y), least - 1e-3) << beside;
      EXPECT_LE(std::hypot(place.x - given.x, place.y - given.y), least + 0.1) << beside;
    }
  }
}

TEST(Probe, LeavesAnEndInADoorThatIsTooNarrow) {
  ProbeQuestion question = across;
  question.from = {10.0, 0.05, 1.0};
  const ProbeAnswer answer = probe(survey_of(room(0.5)), question, {.radius = 0.3, .height = 1.8});
  EXPECT_FALSE(answer.passable);
  EXPECT_EQ(answer.start.x, 10.0);
}

TEST(Probe, CallsADoorWhatReachesUpToAHeadAndOtherwiseAGap) {
  const ProbeAnswer door = probe(survey_of(room(0.5)), across, {.radius = 0.3, .height = 1.8});
  EXPECT_TRUE(contains(words::report(across, door).text(), "stopped by  door 0.500 m wide at "));
  Mesh m;  // two cupboards, lower than the room
  add_box(m, {0.0, -2.0, 0.0}, {20.0, 2.0, 3.0});
  add_box(m, {10.0, -2.0, 0.0}, {11.0, -0.25, 2.0});
  add_box(m, {10.0, 0.25, 0.0}, {11.0, 2.0, 2.0});
  const ProbeAnswer gap = probe(survey_of(m), across, {.radius = 0.3, .height = 1.8});
  ASSERT_TRUE(gap.limit);
  EXPECT_EQ(gap.limit->kind, Kind::door) << "as in the report for programs";
  EXPECT_TRUE(contains(words::report(across, gap).text(), "stopped by  gap 0.500 m wide at "))
      << words::report(across, gap).text();
}

TEST(Probe, SaysNoMinusOfZero) {
  EXPECT_EQ(words::at({-0.001, -0.006, 0.0}), "(0.00, -0.01, 0.00)");
  EXPECT_EQ(words::exactly_at({-0.0, -0.0004, 1e6}), "(0.000, 0.000, 1000000.000)");
}

TEST(Probe, MeasuresAFallAsAStepUp) {
  for (const bool down : {false, true}) {
    Mesh m;
    add_floor(m, 0.0, -2.0, 10.0, 2.0, 0.0);
    add_floor(m, 10.0, -2.0, 20.0, 2.0, 0.7);
    add_wall(m, 10.0, -2.0, 10.0, 2.0, 0.0, 0.7);
    ProbeQuestion question{.from = {2.0, 0.0, 0.2}, .to = {18.0, 0.0, 0.9}};
    if (down) std::swap(question.from, question.to);
    const ProbeAnswer answer = probe(survey_of(m), question, {.radius = 0.3, .height = 1.8});
    ASSERT_TRUE(answer.limit) << down;
    EXPECT_EQ(answer.limit->kind, Kind::step) << down;
    EXPECT_NEAR(answer.limit->size, 0.7, 1e-3) << down;
    EXPECT_NEAR(answer.missing, 0.4, 1e-3) << down;
  }
}

/// Stairs from x = 5, 4 m wide: risers of these heights, `tread` apart, between two floors 5 m long.
Mesh stairs(const std::vector<double>& risers, double tread) {
  Mesh m;
  double x = 5.0, z = 0.0;
  add_floor(m, 0.0, -2.0, x, 2.0, z);
  for (const double& rise : risers) {
    const double next = &rise == &risers.back() ? x + 5.0 : x + tread;
    add_wall(m, x, -2.0, x, 2.0, z, z + rise);
    z += rise;
    add_floor(m, x, -2.0, next, 2.0, z);
    x = next;
  }
  return m;
}

TEST(Probe, ClimbsWhatTheWalkerOfItsPathClimbs) {
  for (const auto& [size, step] : std::vector<std::pair<ProbedSize, double>>{{{0.3, 0.6}, 0.3},
                                                                             {{0.3, 0.604}, 0.3},
                                                                             {{0.3, 0.65}, 0.05},
                                                                             {{0.3, 0.8}, 0.2},
                                                                             {{0.3, 1.8}, 0.3},
                                                                             {{0.1, 0.21}, 0.01}}) {
    EXPECT_NEAR(climbed(across, size), step, 1e-9) << size.height;
    EXPECT_EQ(probed_body(across, size).step, climbed(across, size)) << size.height;
  }
  for (const double rise : {0.03, 0.1, 0.2}) {
    const ProbeQuestion question{.from = {1.0, 0.0, 0.2}, .to = {9.0, 0.0, rise + 0.2}};
    const Survey survey = survey_of(stairs({rise}, 1.0));
    const ProbeAnswer answer = probe(survey, question, {.radius = 0.3, .height = 0.65});
    const WalkerSettings body = probed_body(question, answer.size);
    const std::vector<Vec3> straight = standing(std::vector<Vec3>{answer.start, answer.target}, body);
    Walker walker(survey.world(), body, Mode::walk, straight.front());
    EXPECT_EQ(follow(walker, straight).outcome == Outcome::reached, answer.passable) << rise;
  }
}

TEST(Probe, StepsUpAtMostHalfTheHeight) {
  for (const auto& [rise, climbs] : {std::pair{0.85, true}, std::pair{1.1, false}}) {
    const ProbeQuestion question{.from = {1.0, 0.0, 0.2}, .to = {9.0, 0.0, rise + 0.2}, .step = 1.15};
    const ProbeAnswer answer = probe(survey_of(stairs({rise}, 1.0)), question, {.radius = 0.3, .height = 1.8});
    EXPECT_EQ(answer.passable, climbs) << rise;
    EXPECT_TRUE(answer.drops.empty()) << rise;
  }
}

TEST(Probe, NamesTheHighestStepAmongStepsOfSeveralHeights) {
  for (const double tread : {0.28, 1.0}) {
    for (const auto& [risers, highest] :
         std::vector<std::pair<std::vector<double>, std::size_t>>{{{0.2, 0.2, 0.2, 0.4}, 3},
                                                                  {{0.35, 0.2, 0.45, 0.2}, 2},
                                                                  {{0.45, 0.35, 0.4}, 0},
                                                                  {{0.2, 0.36, 0.2, 0.2}, 1}}) {
      const Survey survey = survey_of(stairs(risers, tread));
      const double top = std::accumulate(risers.begin(), risers.end(), 0.0);
      const double end = 5.0 + tread * static_cast<double>(risers.size() - 1) + 4.0;
      ProbeQuestion question{.from = {1.0, 0.0, 0.2}, .to = {end, 0.0, top + 0.2}};
      for (const bool down : {false, true}) {
        if (down) std::swap(question.from, question.to);
        const ProbeAnswer answer = probe(survey, question, {.radius = 0.3, .height = 1.8});
        const std::string which = fmt::format("tread {}, {}, {}", tread, fmt::join(risers, " "), down ? "down" : "up");
        if (down) {
          EXPECT_TRUE(answer.passable) << which;
          EXPECT_TRUE(std::any_of(answer.drops.begin(), answer.drops.end(), [&](const ProbeDrop& drop) {
            return drop.height() > risers[highest] - 1e-3;
          })) << which;
          continue;
        }
        ASSERT_TRUE(answer.limit) << which;
        EXPECT_EQ(answer.limit->kind, Kind::step) << which;
        EXPECT_NEAR(answer.limit->size, risers[highest], 1e-3) << which;
        EXPECT_NEAR(answer.limit->point.x, 5.0 + tread * static_cast<double>(highest), 0.05) << which;
        question.step = answer.limit->size;
        EXPECT_TRUE(probe(survey, question, {.radius = 0.3, .height = 1.8}).passable) << which;
        question.step = 0.3;
      }
    }
  }
}

TEST(Probe, NamesAStepThatIsAFewMillimetresTooHighForTheWalker) {
  for (const std::vector<double>& risers : std::vector<std::vector<double>>{{0.3002}, {0.304}, {0.304, 0.306}}) {
    const double rise = risers.front(), top = std::reduce(risers.begin(), risers.end());
    const ProbeQuestion question{.from = {1.0, 0.0, 0.2}, .to = {9.0, 0.0, top + 0.2}};
    const ProbeAnswer answer = probe(survey_of(stairs(risers, 1.0)), question, {.radius = 0.3, .height = 1.8});
    EXPECT_EQ(answer.passable, rise < 0.3003) << "the walker grants twice its skin";
    ASSERT_TRUE(answer.walk);
    EXPECT_NEAR(answer.walk->step, answer.passable ? 0.0 : rise, 1e-6);
    const std::string text = words::report(question, answer).sentences();
    EXPECT_EQ(contains(text, ": a step there is 0.304 m high, and the body steps 0.300 m"), !answer.passable) << text;
  }
}

TEST(Probe, NamesNoPlaceWhereWhatIsReachedIsFarApart) {
  Mesh m;
  add_floor(m, 0.0, -2.0, 5.0, 2.0, 0.0);
  add_floor(m, 15.0, -2.0, 20.0, 2.0, 0.0);
  const ProbeAnswer answer = probe(survey_of(m), across, {.radius = 0.3, .height = 1.8});
  EXPECT_FALSE(answer.passage.found);
  EXPECT_FALSE(answer.limit);
  EXPECT_EQ(answer.missing, 0.0);
}

TEST(Probe, SharesOneSearchAmongSizesOfOneHeight) {
  const Survey survey = survey_of(room(0.7));
  const std::vector<ProbedSize> sizes{{0.4, 1.8}, {0.2, 1.8}, {0.3, 1.8}, {0.3, 1.7}};
  const std::vector<ProbeAnswer> answers = probe(survey, across, sizes);
  ASSERT_EQ(answers.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(answers[i].size.radius, sizes[i].radius);
    EXPECT_EQ(answers[i].passable, sizes[i].radius < 0.35);
    EXPECT_EQ(answers[i].passage.places, answers[0].passage.places);
  }
  EXPECT_EQ(answers[3].size.height, 1.7);
}

TEST(Probe, MovesTheEndOfEachSizeAsIfItWereAlone) {
  Mesh mesh = room(0.7);
  add_wall(mesh, 2.02, -0.2, 2.02, 0.8, 0.0, 2.0);  // beside the start
  const Survey survey = survey_of(mesh);
  const std::vector<ProbedSize> sizes{{0.2, 1.8}, {0.6, 1.8}, {0.3, 1.8}};
  const std::vector<ProbeAnswer> answers = probe(survey, across, sizes);
  EXPECT_NE(answers[0].start, answers[1].start);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const ProbeAnswer alone = probe(survey, across, sizes[i]);
    EXPECT_EQ(answers[i].start, alone.start) << i;
    EXPECT_EQ(answers[i].passable, alone.passable) << i;
    EXPECT_EQ(answers[i].passage.way, alone.passage.way) << i;
    EXPECT_EQ(answers[i].passing, alone.passing) << i;
  }
}

TEST(Probe, SaysWhyNobodyCanBeAtAnEndAndWhereOneCould) {
  ProbeQuestion question = across;
  question.to = {500.0, 0.0, 1.0};
  try {
    static_cast<void>(probe(survey_of(room(0.84)), question, {.radius = 0.3, .height = 1.8}));
    FAIL() << "somebody stands off the scene";
  } catch (const NoRoomAtEnd& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("to (500.00, 0.00, 1.00): ")) << error.what();
    ASSERT_TRUE(error.nearest);
    EXPECT_NEAR(error.nearest->x, 20.0, 1.0);
  }
}

TEST(Probe, NamesOpenGroundInSightToWhoIsOffTheScene) {
  Mesh m;
  add_floor(m, 0.0, 0.0, 20.0, 20.0, 0.0);
  add_box(m, {0.0, 8.0, 0.0}, {4.0, 12.0, 2.9});
  ProbeQuestion question = across;
  question.from = {-3.0, 10.0, 1.5};
  question.to = {10.0, 3.0, 0.0};
  try {
    static_cast<void>(probe(survey_of(m), question, {.radius = 0.3, .height = 1.8}));
    FAIL() << "somebody stands off the scene";
  } catch (const NoRoomAtEnd& error) {
    ASSERT_TRUE(error.nearest);
    EXPECT_LT(error.nearest->z, 0.5) << "the box's top is nearer, but too high to get to";
  }
}

TEST(Probe, EndsWhenItIsToldTo) {
  const Survey survey = survey_of(room(0.84));
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    ProbeQuestion question = across;
    question.mode = mode;
    question.progress = [](std::uint64_t) { return false; };
    EXPECT_THROW(static_cast<void>(probe(survey, question, {.radius = 0.3, .height = 0.6})), Cancelled);
    question.progress = {};
    question.most_places = 64;
    const ProbeAnswer answer = probe(survey, question, {.radius = 0.3, .height = 0.6});
    EXPECT_FALSE(answer.passable);
    EXPECT_FALSE(answer.passage.complete);
  }
}

TEST(Probe, RefusesASizeThatNoWalkerHas) {
  EXPECT_THROW(static_cast<void>(probe(survey_of(room(0.84)), across, {.radius = 0.3, .height = 0.5})), Error);
  EXPECT_THROW(static_cast<void>(probe(survey_of(room(0.84)), across, {.radius = 1e-300, .height = 1.8})), Error);
}

// A space takes motions of 1000 km at most.
TEST(Probe, AnswersInASceneHigherThanAMotion) {
  Mesh tower = room(0.84);
  add_floor(tower, -1.0, -1.0, 1.0, 1.0, 2e6);
  const Survey survey = survey_of(tower);
  EXPECT_TRUE(probe(survey, across, {.radius = 0.3, .height = 1.8}).passable);
  for (const ProbeQuestion& question : {across, by_flight(across)}) {
    for (const Vec3& to : {Vec3(0.0, 0.0, 2e6 + 1.0), Vec3(0.0, 0.0, 1.9e6), Vec3(0.0, 0.0, 3e6)}) {
      ProbeQuestion far = question;
      far.to = to;
      far.most_places = 1000;
      try {
        static_cast<void>(probe(survey, far, {.radius = 0.3, .height = question.mode == Mode::fly ? 0.6 : 1.8}));
      } catch (const NoRoomAtEnd& error) {
        EXPECT_EQ(std::string(error.what()).find("component"), std::string::npos) << error.what();
      }
    }
  }
}

TEST(Probe, RefusesASpacingThatNeverEnds) {
  for (const double spacing : {5e-324, 0.0009, 0.0, -1.0, static_cast<double>(NAN)}) {
    ProbeQuestion question = across;
    question.spacing = spacing;
    try {
      static_cast<void>(probe(survey_of(room(0.84)), question, {.radius = 0.3, .height = 1.8}));
      ADD_FAILURE() << spacing;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("at least 0.001"), std::string::npos) << error.what();
    }
  }
}

TEST(Probe, RefusesToFlyWhatIsNoSphereBeforeItSearches) {
  ProbeQuestion question = by_flight(across);
  bool asked = false;
  question.progress = [&](std::uint64_t) { return asked = true; };
  EXPECT_THROW(static_cast<void>(probe(survey_of(room(0.84)), question, {.radius = 0.3, .height = 1.8})), Error);
  EXPECT_FALSE(asked);
}

TEST(Probe, ProvesANoOnlyOfBodiesThatTheBoundShutsOut) {
  // The widest way is known to some millimetres: a body between it and the bound may still get through.
  const Survey survey = survey_of(room(0.5));
  const Passage widest = probe(survey, by_flight(across), {.radius = 0.3, .height = 0.6}).passage;
  ASSERT_TRUE(widest.proven);
  ASSERT_GT(widest.bound, widest.radius + 1e-3);
  const double between = 0.5 * (widest.radius + widest.bound);
  const ProbeAnswer open = probe(survey, by_flight(across), {.radius = between, .height = 2.0 * between});
  EXPECT_FALSE(open.wide_enough);
  ASSERT_GT(open.passage.bound, between);
  EXPECT_FALSE(open.proven);
  const double wider = widest.bound + 1e-3;
  EXPECT_TRUE(probe(survey, by_flight(across), {.radius = wider, .height = 2.0 * wider}).proven);
  // A yes is about the widest way.
  EXPECT_TRUE(probe(survey, by_flight(across), {.radius = 0.2, .height = 0.4}).proven);
}

TEST(Probe, FliesStraightWhereThereIsNothing) {
  const Survey nothing = survey_of(Mesh{});
  const ProbeAnswer answer = probe(nothing, by_flight(across), {.radius = 0.3, .height = 0.6});
  EXPECT_TRUE(answer.passable);
  const std::vector<Vec3> path = probed_path(nothing, by_flight(across), answer);
  ASSERT_GE(path.size(), 2u);
  EXPECT_EQ(path.front(), across.from);
  EXPECT_EQ(path.back(), across.to);
  for (const Vec3& place : path) EXPECT_LE(glm::distance(place, across.from), 17.0);
}

TEST(Probe, FliesFromAPlaceToItselfOnAnyLattice) {
  Mesh m;
  add_box(m, {-5.0, -5.0, 0.0}, {5.0, 5.0, 10.0});
  const Survey survey = survey_of(m);
  for (const double spacing : {0.2, 0.25}) {
    const ProbeQuestion question{.from = {1.0, 1.0, 6.0}, .to = {1.0, 1.0, 6.0}, .mode = Mode::fly, .spacing = spacing};
    const ProbeAnswer answer = probe(survey, question, {.radius = 0.3, .height = 0.6});
    EXPECT_TRUE(answer.passable) << spacing;
    EXPECT_FALSE(probed_path(survey, question, answer).empty()) << spacing;
  }
}

TEST(Probe, HasNoPathOfANo) {
  const Survey survey = survey_of(room(0.0));
  for (const ProbeQuestion& question : {across, by_flight(across)}) {
    const ProbeAnswer answer = probe(survey, question, {.radius = 0.3, .height = 0.6});
    EXPECT_TRUE(probed_path(survey, question, answer).empty());
  }
}

TEST(Probe, HasTheEyeOfASphereInItsCentre) {
  EXPECT_DOUBLE_EQ(probed_body(across, {.radius = 0.3, .height = 0.6}).eye, WalkerSettings::sphere(0.3).eye);
  EXPECT_DOUBLE_EQ(probed_body(across, {.radius = 0.3, .height = 1.2}).eye, 1.2);
}

TEST(Probe, SaysWhichEndIsNoPlace) {
  const Survey survey = survey_of(room(0.0));
  for (const bool from : {true, false}) {
    ProbeQuestion question = across;
    (from ? question.from : question.to).y = std::nan("");
    const std::string said = error_of([&] { static_cast<void>(probe(survey, question, ProbedSize{})); });
    EXPECT_TRUE(contains(said, from ? "\"from\" is (" : "\"to\" is (") && contains(said, "nan")) << said;
  }
}

TEST(Probe, SaysANoInWordsWhereNothingIsNearEnoughToBeNamed) {
  Mesh m;
  for (const double x : {0.0, 210.0}) add_floor(m, x, -5.0, x + 10.0, 5.0, 0.0);
  ProbeQuestion question{.from = {5.0, 0.0, 0.0}, .to = {215.0, 0.0, 0.0}};
  const ProbeAnswer answer = probe(survey_of(m), question, {.radius = 0.3, .height = 1.8});
  EXPECT_FALSE(answer.passable || answer.passage.found);
  EXPECT_FALSE(answer.limit);
  const std::string said = words::report(question, answer).sentences();
  EXPECT_TRUE(said.starts_with("NO: ") && contains(said, "Why: no way was found")) << said;
  EXPECT_TRUE(contains(said, "do not meet")) << said;
}

TEST(Probe, LetsASphereClimbItsRadiusAndACapsuleWhatIsBelowItsHead) {
  EXPECT_DOUBLE_EQ(climbed(across, {.radius = 0.2, .height = 0.4}), 0.2);
  EXPECT_DOUBLE_EQ(climbed(across, {.radius = 0.3, .height = 0.8}), 0.2);
  EXPECT_DOUBLE_EQ(climbed(across, {.radius = 0.3, .height = 1.8}), 0.3);
}

TEST(Probe, ShowsWhatIsReachedFromBothEnds) {
  const Survey survey = survey_of(room(0.0));
  const ProbeAnswer answer = probe(survey, across, {.radius = 0.3, .height = 1.8});
  EXPECT_FALSE(answer.passage.found);
  const ProbeReach reach = probed_reach(survey, across, answer, 100'000);
  ASSERT_FALSE(reach.from_start.empty() || reach.from_target.empty());
  for (const Vec3& place : reach.from_start) EXPECT_LT(place.x, 10.0);
  for (const Vec3& place : reach.from_target) EXPECT_GT(place.x, 10.0);
  ProbeQuestion cancelled = across;
  cancelled.progress = [](std::uint64_t) { return false; };
  EXPECT_THROW(static_cast<void>(probed_reach(survey, cancelled, answer, 100'000)), Cancelled);
}

}  // namespace
