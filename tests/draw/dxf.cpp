// Sheets as DXF: in metres, in the scene's coordinates, in layers.
#include "draw/dxf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "cli/exit_status.h"
#include "draw/opening.h"
#include "draw/page.h"
#include "draw/picture_file.h"
#include "program.h"

namespace {

namespace draw = roam::draw;
using draw::Point;

/// An entity: its type, its layer, and its values by group code.
struct Entity {
  std::string type;
  std::map<int, std::string> values;
  [[nodiscard]] double number(int code) const { return std::stod(values.at(code)); }
  [[nodiscard]] Point at(int code = 10) const { return {number(code), number(code + 10)}; }
};

/// The entities of a file. Fails for anything that is no pair of a number and a value.
std::vector<Entity> entities(const std::string& dxf) {
  std::istringstream in(dxf);
  std::vector<Entity> all;
  bool within = false;
  std::string section;
  for (std::string code, value; std::getline(in, code);) {
    EXPECT_TRUE(std::getline(in, value)) << "an odd number of lines";
    const int number = std::stoi(code);
    if (number == 2 && !within && value == "ENTITIES") within = true;
    if (number == 0 && value == "ENDSEC") within = false;
    if (!within) continue;
    if (number == 0) all.push_back({value, {}});
    if (!all.empty()) all.back().values.try_emplace(number, value);
  }
  EXPECT_TRUE(dxf.ends_with("0\nEOF\n"));
  return all;
}

std::vector<Entity> on(const std::vector<Entity>& all, const std::string& layer, const std::string& type) {
  std::vector<Entity> found;
  for (const Entity& e : all) {
    if (e.type == type && e.values.at(8) == layer) found.push_back(e);
  }
  return found;
}

void expect_near(const Point& a, const Point& b) {
  EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y), 0.01) << a.x << " " << a.y;
}

/// A plan of 20 m x 10 m, turned by a quarter about (100, 200), and a section whose heights are exaggerated.
draw::Sheet sheet() {
  draw::Page page;
  const draw::Turn turn{{100, 200, 0}, 0.0, 1.0};
  page.paragraph("title", "a title", draw::title_font, draw::ink);
  page.heading("plan", {"Plan", "cut", 80.0, &turn});
  draw::Panel plan = page.panel("plan", {{{-10, -5}, {10, 5}}, 80.0, 80.0}, draw::sheet_margin, &turn);
  plan.segments("walls", std::vector<draw::Segment>{{{-4, 1}, {3, 1}}}, draw::wall_style);
  plan.disc("body", {2, 1}, 0.3, draw::body_style);
  plan.lines("way", {{{-30, 0}, {30, 0}}}, draw::way_style);
  plan.text("note", {1, 2}, {0, 0}, "2 m\u00b2", draw::small_font, draw::ink, draw::Labels::Align::left);
  page.below(plan);
  page.heading("section", {"Section", "", 80.0});
  draw::Panel section = page.panel("section", {{{0, 0}, {20, 3}}, 80.0, 160.0}, draw::sheet_margin);
  section.segments("floor", std::vector<draw::Segment>{{{0, 0}, {20, 3}}}, draw::wall_style);
  section.border();
  page.below(section);
  return page.finish();
}

TEST(Dxf, APlanLiesInTheSceneInMetres) {
  const auto all = entities(to_dxf(sheet()));
  const auto walls = on(all, "PLAN_WALLS", "LINE");
  ASSERT_EQ(walls.size(), 1u);
  // Right is +y and up is -x of the scene.
  const bool forward = walls[0].at().y < 200.0;
  expect_near(walls[0].at(forward ? 10 : 11), {99, 196});
  expect_near(walls[0].at(forward ? 11 : 10), {99, 203});
  const auto bodies = on(all, "PLAN_BODY", "CIRCLE");
  ASSERT_EQ(bodies.size(), 1u);
  expect_near(bodies[0].at(), {99, 202});
  EXPECT_NEAR(bodies[0].number(40), 0.3, 1e-3);
}

TEST(Dxf, LinesEndAtTheFrameOfTheirView) {
  const auto way = on(entities(to_dxf(sheet())), "PLAN_WAY", "LINE");
  ASSERT_EQ(way.size(), 1u);
  EXPECT_NEAR(std::abs(way[0].at().y - way[0].at(11).y), 20.0, 0.01);
}

TEST(Dxf, AreasEndAtTheFrameOfTheirView) {
  draw::Page page;
  const draw::Turn turn{{100, 200, 0}, 1.0, 0.0};
  draw::Panel plan = page.panel("plan", {{{-10, -5}, {10, 5}}, 80.0, 80.0}, draw::sheet_margin, &turn);
  plan.areas("floor", {{{-100, -1}, {5, -1}, {5, 2}, {-100, 2}}, {{20, 0}, {21, 0}, {21, 1}}}, draw::floor_style);
  plan.areas("corner", {{{8, 3}, {14, 3}, {8, 9}}}, draw::floor_style);
  const std::string dxf = to_dxf(page.finish());
  const auto all = entities(dxf);
  EXPECT_EQ(on(all, "PLAN_FLOOR", "POLYLINE").size(), 1u);
  draw::Rect floor, corner;
  for (const Entity& e : on(all, "PLAN_FLOOR", "VERTEX")) floor.include(e.at());
  for (const Entity& e : on(all, "PLAN_CORNER", "VERTEX")) corner.include(e.at());
  expect_near(floor.lower, {90, 199});
  expect_near(floor.upper, {105, 202});
  expect_near(corner.lower, {108, 203});
  expect_near(corner.upper, {110, 205});
  EXPECT_NE(dxf.find("$EXTMIN\n10\n90.0000\n20\n199.0000\n"), std::string::npos);
}

TEST(Dxf, CirclesEndAtTheFrameOfTheirView) {
  draw::Page page;
  const draw::Turn turn{{100, 200, 0}, 0.0, 1.0};  // right is +y and up is -x of the scene
  draw::Panel plan = page.panel("plan", {{{-10, -5}, {10, 5}}, 80.0, 80.0}, draw::sheet_margin, &turn);
  plan.disc("whole", {2, 1}, 1.0, draw::body_style);
  plan.disc("cut", {11, 0}, 2.0, draw::body_style);
  plan.disc("tall", {0, 0}, 6.0, draw::body_style);
  plan.disc("around", {0, 0}, 30.0, draw::body_style);
  plan.disc("beside", {30, 0}, 2.0, draw::body_style);
  const auto all = entities(to_dxf(page.finish()));
  EXPECT_EQ(on(all, "PLAN_WHOLE", "CIRCLE").size(), 1u);
  EXPECT_EQ(on(all, "PLAN_TALL", "ARC").size(), 2u);
  for (const Entity& e : all) EXPECT_TRUE(e.values.at(8) != "PLAN_AROUND" && e.values.at(8) != "PLAN_BESIDE");
  EXPECT_TRUE(on(all, "PLAN_CUT", "CIRCLE").empty());
  const auto arcs = on(all, "PLAN_CUT", "ARC");
  ASSERT_EQ(arcs.size(), 1u);
  expect_near(arcs[0].at(), {100, 211});
  EXPECT_NEAR(arcs[0].number(40), 2.0, 1e-3);
  // The part with y <= 210, counterclockwise: 60 degrees to both sides of -y.
  EXPECT_NEAR(arcs[0].number(50), 210.0, 0.01);
  EXPECT_NEAR(arcs[0].number(51), 330.0, 0.01);
}

TEST(Dxf, LinesOfOneKindKeepTheirColours) {
  draw::Page page;
  const draw::Turn turn{{0, 0, 0}, 1.0, 0.0};
  draw::Panel plan = page.panel("plan", {{{-10, -5}, {10, 5}}, 80.0, 80.0}, draw::sheet_margin, &turn);
  for (const draw::Style& style : draw::gap_styles) plan.lines("way", {{{-4, 1}, {3, 1}}}, style);
  const auto way = on(entities(to_dxf(page.finish())), "PLAN_WAY", "LINE");
  ASSERT_EQ(way.size(), draw::gap_styles.size());
  std::set<std::string> colours;  // none: that of the layer
  for (const Entity& e : way) colours.insert(e.values.contains(62) ? e.values.at(62) : "");
  EXPECT_EQ(colours.size(), draw::gap_styles.size());
  EXPECT_FALSE(way[0].values.contains(62));
}

TEST(Dxf, HasTheTextsOfASheetWithoutViews) {
  const std::string dxf = to_dxf(draw::opening_sheet("t", {}, {}, "answer"));
  EXPECT_EQ(dxf.find("inf"), std::string::npos) << dxf;
  const auto texts = on(entities(dxf), "TEXT", "TEXT");
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_EQ(texts[0].values.at(1), "answer");
  EXPECT_GT(on(entities(dxf), "TITLE", "TEXT").at(0).at().y, texts[0].at().y);
  EXPECT_EQ(draw::to_dxf({}).find("inf"), std::string::npos);
}

TEST(Dxf, ASectionStandsBesideThePlanWithTrueHeights) {
  const auto all = entities(to_dxf(sheet()));
  const auto floor = on(all, "SECTION_FLOOR", "LINE");
  ASSERT_EQ(floor.size(), 1u);
  const Point a = floor[0].at(), b = floor[0].at(11);
  EXPECT_NEAR(std::abs(b.x - a.x), 20.0, 0.01);
  EXPECT_NEAR(std::abs(b.y - a.y), 3.0, 0.01);
  EXPECT_GT(std::min(a.x, b.x), 105.0) << "the plan ends there";
  EXPECT_EQ(on(all, "SECTION_FRAME", "POLYLINE").size(), 1u);
  const auto names = on(all, "NAMES", "TEXT");
  ASSERT_EQ(names.size(), 1u);
  EXPECT_EQ(names[0].values.at(1), "section");
}

TEST(Dxf, TextsAreAsHighAsOnTheSheetAndKeepTheirLetters) {
  const auto notes = on(entities(to_dxf(sheet())), "PLAN_NOTE", "TEXT");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].values.at(1), "2 m\\U+00B2");
  EXPECT_NEAR(notes[0].number(40), 0.72 * 20.0 / 80.0, 1e-4);
}

TEST(Dxf, TextsAreNoControlCodesAndKeepTheirPercentSigns) {
  draw::Page page;
  draw::Panel plan = page.panel("plan", {{{-10, -5}, {10, 5}}, 80.0, 80.0}, draw::sheet_margin);
  for (const char* text : {"50%%c", "50 %"}) {
    plan.text("note", {0, 0}, {0, 0}, text, draw::small_font, draw::ink, draw::Labels::Align::left);
  }
  const auto notes = on(entities(to_dxf(page.finish())), "PLAN_NOTE", "TEXT");
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].values.at(1), "50%%%%%%c");  // %%% is the code of a percent sign
  EXPECT_EQ(notes[1].values.at(1), "50 %");
}

TEST(Dxf, LeavesOutWhatBelongsToThePage) {
  const std::string dxf = to_dxf(sheet());
  for (const char* layer : {"SCALE", "AXIS", "EXPLANATION", "TITLE"}) EXPECT_EQ(dxf.find(layer), std::string::npos);
}

TEST(Dxf, IsWrittenForSheetsInMetresOnly) {
  const TestFolder folder;
  EXPECT_THROW(draw::PictureFile(folder.file("chart.dxf")), roam::app::UsageError);
  draw::PictureFile(folder.file("sheet.DXF"), draw::PictureFile::Views::in_metres).write(sheet());
  std::ifstream in(folder.file("sheet.DXF"));
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  EXPECT_EQ(text, to_dxf(sheet()));
}

}  // namespace
