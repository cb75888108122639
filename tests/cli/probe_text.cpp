// What roam probe says of answers that no scene gives as asked: walkers that contradict a way, searches that ended.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "messages.h"
#include "probe/text.h"
#include "words/probe.h"

namespace {

using namespace roam;
using Kind = ProbeLimit::Kind;

const ProbeQuestion question{.from = {2, 0, 1}, .to = {18, 0, 1}};

/// Of a body 0.3 m wide to both sides and 1.8 m high, on a way that is wide enough.
ProbeAnswer wide_enough(Outcome outcome) {
  ProbeAnswer answer;
  answer.size = {0.3, 1.8};
  answer.wide_enough = true;
  answer.passable = outcome == Outcome::reached;
  answer.passage.found = answer.passage.limited = true;
  answer.passage.radius = 0.4;
  answer.passage.length = 16.0;
  answer.passage.way = {{2, 0, 0}, {18, 0, 0}};
  answer.start = {2, 0, 0};
  answer.target = {18, 0, 0};
  answer.limit = ProbeLimit{};
  answer.limit->size = 0.8;
  answer.limit->direction = {0, 1, 0};
  answer.walk = ProbeWalk{outcome, {9, 0.25, 0.9}, {9, 0, 0}};
  return answer;
}

TEST(ProbeText, SaysNotShownWhereTheWalkerContradictsTheWay) {
  const std::vector<std::pair<Outcome, std::string>> outcomes{{Outcome::blocked, "was blocked at (9.00, 0.25, 0.00)"},
                                                              {Outcome::held, "was held at (9.00, 0.25, 0.00)"}};
  for (const auto& [outcome, how] : outcomes) {
    const ProbeAnswer answer = wide_enough(outcome);
    const std::string text = words::report(question, answer).sentences();
    EXPECT_TRUE(text.starts_with("NOT SHOWN: ")) << text;
    EXPECT_TRUE(contains(text, how)) << text;
    const app::Json json = app::json_report(answer, false);
    EXPECT_EQ(json["passable"], false);
    EXPECT_EQ(json["wide_enough"], true);
    EXPECT_EQ(json["walked"]["outcome"], to_string(outcome));
    const std::vector<ProbeAnswer> answers{answer};
    EXPECT_TRUE(contains(app::table(question, answers), " ? ")) << app::table(question, answers);
  }
}

TEST(ProbeText, SaysOfFlyingThatTheWalkerLeftTheScene) {
  ProbeQuestion flying = question;
  flying.mode = Mode::fly;
  ProbeAnswer answer = wide_enough(Outcome::left_scene);
  answer.size.height = 0.6;
  const std::string text = words::report(flying, answer).sentences();
  EXPECT_TRUE(text.starts_with("NOT SHOWN: ") && contains(text, "left the scene at (9.00, 0.25, 0.90)")) << text;
  // On foot it fell over the side of the scene.
  EXPECT_TRUE(words::report(question, wide_enough(Outcome::left_scene)).sentences().starts_with("NO: "));
}

TEST(ProbeText, SaysNotKnownOfASearchThatCameToItsMostPlaces) {
  ProbeAnswer answer;
  answer.size = {0.3, 1.8};
  answer.passage.complete = false;
  answer.passage.places = 4'000'000;
  const std::string text = words::report(question, answer).sentences();
  EXPECT_TRUE(text.starts_with("NOT KNOWN: ")) << text;
  EXPECT_TRUE(contains(text, "ended at a limit after 4,000,000 places")) << text;
  EXPECT_FALSE(contains(text, "there is no way")) << text;
  EXPECT_EQ(app::json_report(answer, false)["complete"], false);
  // A way that is too narrow was found, and a wider one may be there.
  answer.passage.found = answer.passage.limited = true;
  answer.passage.radius = 0.2;
  answer.limit = ProbeLimit{};
  answer.limit->size = 0.4;
  answer.limit->needed = 0.6;
  answer.missing = 0.2;
  const std::string narrow = words::report(question, answer).sentences();
  EXPECT_TRUE(narrow.starts_with("NO: ") && contains(narrow, "no proof: the search ended")) << narrow;
  // Nothing wider leads off an end that has no room.
  answer.limit->kind = Kind::start;
  EXPECT_FALSE(contains(words::report(question, answer).sentences(), "no proof"))
      << words::report(question, answer).sentences();
}

/// Of a body that no way was found for, where none for a radius over 0.1252 m exists.
ProbeAnswer none_found() {
  ProbeAnswer answer;
  answer.size = {0.3, 0.6};
  answer.narrowest = 0.05;
  answer.proven = true;
  answer.passage.bound = 0.1252;
  return answer;
}

TEST(ProbeText, SaysThatNobodyPassesOnlyWhereThatIsCertified) {
  ProbeAnswer answer = none_found();
  answer.limit = ProbeLimit{};
  answer.limit->kind = Kind::apart;
  for (const bool apart : {true, false}) {
    if (!apart) answer.limit.reset();
    answer.passage.bound = 0.1252;
    const std::string text = words::report(question, answer).sentences();
    EXPECT_TRUE(contains(text, "no way was found, even for a body 0.10 m wide")) << text;
    EXPECT_TRUE(contains(text, "it is proven that nothing wider than 0.251 m passes; for narrower bodies")) << text;
    EXPECT_TRUE(contains(text, "openings under 0.14 m may have been missed")) << text;
    EXPECT_FALSE(contains(text, "there is no way")) << text;
    EXPECT_FALSE(contains(app::table(question, std::span(&answer, 1)), "no way at all"));
    answer.passage.bound = 0.05;
    const std::string shut = words::report(question, answer).sentences();
    EXPECT_TRUE(contains(shut, "there is no way, even") && contains(shut, "it is proven that there is no way")) << shut;
  }
  EXPECT_TRUE(contains(app::table(question, std::span(&answer, 1)), "no way at all"));
}

TEST(ProbeText, TellsWhatIsCertifiedOfASearchThatEnded) {
  ProbeAnswer answer = none_found();
  answer.passage.complete = false;
  answer.passage.places = 84'571;
  const std::string text = words::report(question, answer).sentences();
  EXPECT_TRUE(text.starts_with("NO: ")) << text;
  EXPECT_TRUE(contains(text, "it is proven that nothing wider than 0.251 m passes; for narrower bodies")) << text;
  EXPECT_TRUE(contains(text, "ended at a limit after 84,571 places")) << text;
  EXPECT_FALSE(contains(text, "there is no way") || contains(text, "do not meet")) << text;
  const std::string row = app::table(question, std::span(&answer, 1));
  EXPECT_TRUE(contains(row, " no ") && contains(row, "none that wide: certified")) << row;
  // A narrow way was found before.
  answer.passage.found = answer.passage.limited = true;
  answer.passage.radius = 0.1;
  answer.limit = ProbeLimit{};
  answer.limit->size = 0.2;
  answer.limit->needed = 0.6;
  answer.missing = 0.4;
  const std::string narrow = words::report(question, answer).sentences();
  EXPECT_TRUE(contains(narrow, "it is proven that nothing wider than 0.251 m passes; for narrower bodies")) << narrow;
}

TEST(ProbeText, CallsInATableUnknownWhatIsNotKnown) {
  ProbeAnswer answer = none_found();
  answer.proven = false;
  answer.passage.complete = false;
  const std::string row = app::table(question, std::span(&answer, 1));
  EXPECT_TRUE(contains(row, " ? ") && contains(row, "the search ended")) << row;
  EXPECT_FALSE(contains(row, " no ") || contains(row, "none") || contains(row, "no way at all")) << row;
}

TEST(ProbeText, TellsTheBoundOfABodyThatMayStillGetThrough) {
  ProbeAnswer answer = wide_enough(Outcome::blocked);
  answer.walk.reset();
  answer.wide_enough = false;
  answer.size = {0.402, 0.804};
  answer.passage.proven = true;
  answer.passage.bound = 0.404;
  const std::string text = words::report(question, answer).sentences();
  EXPECT_TRUE(contains(text, "it is proven that nothing wider than 0.808 m passes.")) << text;
}

TEST(ProbeText, RoundsSoThatWhatItPrintsIsTrue) {
  ProbeAnswer answer = wide_enough(Outcome::blocked);
  answer.walk.reset();
  answer.wide_enough = false;
  answer.size = {0.5, 1.8};
  answer.limit->kind = Kind::height;
  const auto expect_printed = [&](const std::string& part) {
    const std::string text = words::report(question, answer).sentences();
    EXPECT_TRUE(contains(text, part)) << part << ": " << text;
  };
  // A body of exactly the printed size passes.
  answer.passage.radius = 0.49998;
  answer.passing = 0.4995;
  answer.limit->size = 1.7999;
  answer.missing = 2e-5;
  expect_printed("a body of that width up to 1.799 m high, or of that height up to 0.999 m wide");
  const std::string row = app::table(question, std::span(&answer, 1));
  EXPECT_TRUE(contains(row, "0.999 m") && contains(row, "< 1 mm")) << row;
  EXPECT_FALSE(contains(row, "0.0 mm")) << row;
  for (int mm = 1; mm < 2000; ++mm) {
    answer.passing = mm / 2000.0;
    expect_printed(fmt::format("up to {:.3f} m wide", mm / 1000.0));
  }
  // Nothing wider passes.
  answer.passage.proven = true;
  answer.passage.bound = 0.2500000001;
  expect_printed("nothing wider than 0.501 m passes");
  answer.passage.bound = 0.25;
  expect_printed("nothing wider than 0.500 m passes");
}

TEST(ProbeText, NamesWhatIsMeasuredByItsKind) {
  const std::vector<std::pair<Kind, std::string>> members{
      {Kind::door, "width_m"},    {Kind::gap, "width_m"},      {Kind::lintel, "width_m"},
      {Kind::edge, "distance_m"}, {Kind::start, "distance_m"}, {Kind::target, "distance_m"},
      {Kind::height, "height_m"}, {Kind::step, "step_m"},      {Kind::apart, ""}};
  for (const auto& [kind, member] : members) {
    ProbeAnswer answer = wide_enough(Outcome::reached);
    answer.limit->kind = kind;
    const app::Json opening = app::json_report(answer, true)["opening"];
    EXPECT_EQ(opening["kind"], to_string(kind));
    for (const char* other : {"width_m", "distance_m", "height_m", "step_m"})
      EXPECT_EQ(opening.contains(other), member == other) << to_string(kind) << " " << other;
    EXPECT_EQ(opening["missing_m"].is_null(), kind == Kind::apart) << to_string(kind);
    EXPECT_EQ(opening.contains("end"), kind == Kind::start || kind == Kind::target) << to_string(kind);
    EXPECT_EQ(opening.contains("room"), kind == Kind::start || kind == Kind::target) << to_string(kind);
  }
  ProbeAnswer low = wide_enough(Outcome::reached);
  low.limit->kind = Kind::start;
  low.limit->too_low = true;
  EXPECT_TRUE(app::json_report(low, false)["opening"].contains("height_m"));
}

}  // namespace
