// The sheet of a walk: that its marks are where things happened, its measures true and its texts readable.
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "cli/interrupt.h"
#include "draw/labels.h"
#include "draw/opening.h"
#include "draw/page.h"
#include "draw/picture_file.h"
#include "draw/walk_panels.h"
#include "draw/walk_sheet.h"
#include "program.h"
#include "roam/error.h"
#include "roam/generate.h"
#include "sheet_items.h"
#include "walker_scenes.h"

namespace {

namespace draw = roam::draw;
namespace words = roam::words;
using draw::Disc;
using draw::Lines;
using draw::Point;
using draw::Sheet;
using draw::Text;
using roam::Mesh;
using roam::Mode;
using roam::Vec3;

/// A walk along waypoints, and its sheet.
struct Drawn {
  draw::Record record;
  words::EndedWalk report;
  Sheet sheet;

  Drawn(const std::vector<Mesh>& meshes, const std::vector<Vec3>& path, Mode mode, roam::WalkerSettings settings = {},
        double speed = 1.4, const std::string& title = "scene.obj along p.path") {
    const roam::World world = roam::World::build(meshes);
    roam::Walker walker(world, settings, mode, path[0]);
    if (mode == Mode::ghost) {
      append(record, walker.report(), true);
      const Vec3 way = path[1] - path[0];
      for (int i = 0; i < 50; ++i) append(record, walker.step({.velocity = 0.02 * way}, 1.0), false);
      report.result.end = walker.position();
    } else {
      roam::Route route(walker, path, {.speed = speed});
      append(record, walker.report(), true);
      roam::measure::Along along(world, settings, mode);
      along.put(walker.position());
      while (!route.done()) {
        append(record, route.advance(), false);
        along.add(walker.report());
      }
      report.result = route.result();
      report.narrowest = along.narrowest();
    }
    report.mode = mode;
    report.settings = settings;
    report.waypoints = path.size();
    if (report.result.blocked_at) report.object = world.object_name(report.result.blocked_at->triangle);
    const draw::Measured measured = draw::measure(world, report, record);
    const auto triangles = [&](const roam::Box&, const std::function<void(std::span<const Mesh>)>& take) {
      take(meshes);
    };
    sheet = draw::make_sheet({title, report, record, measured, world.bounds(), triangles});
  }

  /// The whole name counts: details have plans and sections of their own.
  template <class Item>
  [[nodiscard]] std::vector<Item> all(const std::string& what) const {
    std::vector<Item> found = sheets::all<Item>(sheet, what);
    std::erase_if(found, [&](const Item& item) { return item.what != what; });
    return found;
  }
  template <class Item>
  [[nodiscard]] Item only(const std::string& what) const {
    const auto found = all<Item>(what);
    EXPECT_EQ(found.size(), 1u) << what;
    return found.empty() ? Item{} : found[0];
  }
  [[nodiscard]] bool says(const std::string& text) const {
    return std::any_of(sheet.items.begin(), sheet.items.end(), [&](const auto& item) {
      const Text* t = std::get_if<Text>(&item);
      return t != nullptr && t->text.find(text) != std::string::npos;
    });
  }
  /// Pixels per metre, from a scale bar and the length that stands at it.
  [[nodiscard]] double scale(const std::string& what) const {
    const draw::Polyline bar = only<Lines>(what + " bar").lines.at(0);
    const Text text = only<Text>(what + " length");
    char* unit = nullptr;
    const double length = std::strtod(text.text.c_str(), &unit) * (std::string(unit) == " km" ? 1000.0 : 1.0);
    EXPECT_TRUE(std::string(unit) == " m" || std::string(unit) == " km") << text.text;
    return glm::distance(bar.at(1), bar.at(2)) / length;
  }
};

Mesh part(const std::string& name) {
  Mesh mesh;
  mesh.name = name;
  return mesh;
}

/// A corridor along x, 4 m wide and 3 m high, with a door of the given width in its middle, 10 m from its beginning.
std::vector<Mesh> corridor(double door) {
  std::vector<Mesh> meshes{part("corridor"), part("Door_12/left"), part("Door_12/right")};
  scenes::add_box(meshes[0], {0, 0, 0}, {20, 4, 3});
  scenes::add_box(meshes[1], {10, 2 + 0.5 * door, 0}, {10.2, 4, 3});
  scenes::add_box(meshes[2], {10, 0, 0}, {10.2, 2 - 0.5 * door, 3});
  return meshes;
}

std::vector<Mesh> floors_with_gap(double width) {
  std::vector<Mesh> meshes{part("near"), part("far"), part("bottom")};
  scenes::add_floor(meshes[0], 0, -2, 5, 2, 0);
  scenes::add_floor(meshes[1], 5 + width, -2, 15, 2, 0);
  scenes::add_floor(meshes[2], 0, -2, 15, 2, -10);
  return meshes;
}

const std::vector<Vec3> along_corridor{{2, 2, 0.9}, {18, 2, 0.9}};

/// Every kind of picture: one scale and details, all outcomes, all modes, names that are hard to set.
std::vector<Drawn> drawings() {
  std::vector<Drawn> all;
  all.emplace_back(corridor(1.2), along_corridor, Mode::walk);
  all.emplace_back(corridor(0.5), along_corridor, Mode::walk);
  all.emplace_back(corridor(1.2), along_corridor, Mode::fly, roam::WalkerSettings::sphere(0.5));
  all.emplace_back(corridor(0.5), along_corridor, Mode::ghost);
  all.emplace_back(floors_with_gap(1.5), std::vector<Vec3>{{2, 0, 0.9}, {12, 0, 0.9}}, Mode::walk);
  all.emplace_back(corridor(1.2), std::vector<Vec3>{{2, 2, 0.9}}, Mode::walk);
  const auto gallery = roam::generate::collect(roam::generate::gallery({.triangles = 10'000}));
  const auto& straight = roam::generate::gallery_paths[0];
  all.emplace_back(gallery, std::vector<Vec3>{straight.from, straight.to}, Mode::fly, roam::WalkerSettings::sphere(0.3),
                   50.0);
  all.emplace_back(gallery, std::vector<Vec3>{straight.from, straight.to}, Mode::walk, roam::WalkerSettings{}, 50.0);
  auto odd = corridor(0.5);
  for (Mesh& mesh : odd) {
    mesh.name = std::string(300, 'W') + "\xff\x01 Tür";
    scenes::shift(mesh, {6.378e6, -6.378e6, 123456.7});
  }
  std::vector<Vec3> far_path = along_corridor;
  for (Vec3& p : far_path) p += Vec3(6.378e6, -6.378e6, 123456.7);
  all.emplace_back(odd, far_path, Mode::walk, roam::WalkerSettings{}, 1.4, std::string(400, 'W') + "\xff.obj");
  return all;
}

TEST(PictureSheet, HasItsTextsInsideAndNoneOverAnother) {
  for (const Drawn& drawn : drawings()) {
    sheets::expect_readable(drawn.sheet);
    const auto texts = sheets::all<Text>(drawn.sheet);
    EXPECT_GT(texts.size(), 10u);
    for (const Text& text : texts) {
      EXPECT_NEAR(text.box.width(), draw::measure_text(text.text, text.font).width(), 1e-9);
    }
  }
}

TEST(PictureSheet, HasPlanSectionScaleAxesTitleAndLegend) {
  for (const Drawn& drawn : drawings()) {
    for (const char* what : {"plan frame", "plan way", "plan start", "section frame", "section way", "section walls",
                             "plan scale bar", "section scale bar", "plan axis x", "plan axis y"}) {
      const bool shown = !drawn.all<Lines>(what).empty() || !drawn.all<Disc>(what).empty();
      // A body that stays where it is has no way.
      const bool stands = drawn.record.places.size() == 1 && std::string(what).ends_with("way");
      EXPECT_EQ(shown, !stands) << what;
    }
    EXPECT_FALSE(drawn.all<Text>("title").empty());
    EXPECT_FALSE(drawn.all<Text>("legend").empty());
    const std::string headline = words::headline(drawn.report);
    EXPECT_TRUE(drawn.says(headline.substr(0, headline.find(':')))) << headline;
  }
}

TEST(PictureSheet, MarksWhatBlocksWhereItWasTouched) {
  const Drawn drawn(corridor(0.5), along_corridor, Mode::walk);
  ASSERT_EQ(drawn.report.result.outcome, roam::Outcome::blocked);
  const double scale = drawn.scale("plan scale");
  const Point start = drawn.only<Disc>("plan start").centre;
  const Vec3 way = drawn.report.result.blocked_at->point - drawn.record.places[0].position;
  const Lines cross = drawn.only<Lines>("plan blocked");
  const Point centre = 0.5 * (cross.lines.at(0).at(0) + cross.lines.at(0).at(1));
  EXPECT_NEAR(centre.x, start.x + scale * way.x, 0.5);
  EXPECT_NEAR(centre.y, start.y - scale * way.y, 0.5);  // a sheet's y points down
  const Lines in_section = drawn.only<Lines>("section blocked");
  EXPECT_NEAR(0.5 * (in_section.lines.at(0).at(0).x + in_section.lines.at(0).at(1).x),
              drawn.only<Disc>("section start").centre.x + drawn.scale("section scale") * way.x, 0.5);
  EXPECT_TRUE(drawn.says("by \"Door_12/"));
  EXPECT_TRUE(drawn.says("opening 0.50 m"));
  EXPECT_FALSE(drawn.says("0.60 m clear"));  // where it stands wedged is no passage
}

TEST(PictureSheet, ShowsBodiesAndWallsToScale) {
  const Drawn drawn(corridor(1.2), along_corridor, Mode::walk);
  const double scale = drawn.scale("plan scale");
  const auto bodies = drawn.all<Disc>("plan body");
  ASSERT_EQ(bodies.size(), 3u);  // start, narrowest, end
  for (const Disc& body : bodies) EXPECT_NEAR(body.radius, 0.3 * scale, 1e-6);
  const draw::Rect walls = sheets::box(drawn.only<Lines>("plan walls"));
  EXPECT_NEAR(walls.width(), 20.0 * scale, 0.3);
  EXPECT_NEAR(walls.height(), 4.0 * scale, 0.3);
  EXPECT_TRUE(drawn.says("1.20 m clear") || drawn.says("1.19 m clear"));
}

TEST(PictureSheet, ShowsNoWallInGroundAsSteepAsTheBodyWalks) {
  std::vector<Mesh> meshes{part("valley")};
  scenes::add_floor(meshes[0], 0, -1, 20, 1, 0);
  for (const double y : {1.0, -1.0}) scenes::add_quad(meshes[0], {0, y, 0}, {20, y, 0}, {20, 9 * y, 8}, {0, 9 * y, 8});
  for (const double slope : {44.9, 45.0}) {
    roam::WalkerSettings settings;
    settings.slope_degrees = slope;
    const Drawn drawn(meshes, {{2, 0, 0.9}, {18, 0, 0.9}}, Mode::walk, settings);
    EXPECT_EQ(drawn.all<Lines>("plan walls").empty(), slope == 45.0) << slope;
  }
}

TEST(PictureSheet, ShowsTheWallsBesideAShortWayAndTheWholeNarrowestPlace) {
  std::vector<Mesh> meshes{part("corridor"), part("far away")};
  scenes::add_box(meshes[0], {0, 0, 0}, {40, 6.4, 3});
  scenes::add_box(meshes[1], {400, 300, 0}, {410, 310, 3});  // so that the plan does not show the whole scene
  const Drawn drawn(meshes, {{14, 3.6, 0.9}, {26, 3.6, 0.9}}, Mode::walk);
  ASSERT_EQ(drawn.report.result.outcome, roam::Outcome::reached);
  const draw::Rect frame = sheets::box(drawn.only<Lines>("plan frame"));
  const draw::Rect walls = sheets::box(drawn.only<Lines>("plan walls"));
  const draw::Rect narrowest = sheets::box(drawn.only<Lines>("plan narrowest"));
  EXPECT_NEAR(walls.height(), 6.4 * drawn.scale("plan scale"), 0.3);
  EXPECT_NEAR(narrowest.height(), walls.height(), 20.0);
  EXPECT_TRUE(frame.contains(narrowest));
}

TEST(PictureSheet, UnrollsTheSectionToItsScale) {
  const Drawn drawn(corridor(1.2), along_corridor, Mode::walk);
  const double scale = drawn.scale("section scale");
  EXPECT_DOUBLE_EQ(scale, drawn.scale("plan scale"));
  EXPECT_TRUE(drawn.says("lengths to the scale of the plan, heights to the same scale"));
  const Point start = drawn.only<Disc>("section start").centre, end = drawn.only<Disc>("section end").centre;
  EXPECT_NEAR(end.x - start.x, 16.0 * scale, 1.0);
  EXPECT_NEAR(start.x, drawn.only<Disc>("plan start").centre.x, 1e-6);  // below its part of the plan
  const draw::Rect walls = sheets::box(drawn.only<Lines>("section walls"));
  EXPECT_NEAR(walls.height(), 3.0 * scale, 0.3);  // floor and ceiling
}

TEST(PictureSheet, NamesTheLeastCertifiedClearanceOfAFlight) {
  const Drawn drawn(corridor(1.2), along_corridor, Mode::fly, roam::WalkerSettings::sphere(0.5));
  double least = 1e9;
  Vec3 where(0.0);
  for (const auto& place : drawn.record.places) {
    if (place.clearance < least) where = place.position;
    least = std::min(least, place.clearance);
  }
  EXPECT_DOUBLE_EQ(least, drawn.report.result.least_axis_clearance);  // what --trace and the report say
  const Lines mark = drawn.only<Lines>("plan nearest");
  const Point centre = 0.5 * (mark.lines.at(0).at(0) + mark.lines.at(0).at(2));
  const Point start = drawn.only<Disc>("plan start").centre;
  EXPECT_NEAR(centre.x - start.x, drawn.scale("plan scale") * (where.x - drawn.record.places[0].position.x), 0.5);
}

TEST(PictureSheet, TurnsALongWayAndShowsItsPlacesMagnified) {
  const auto gallery = roam::generate::collect(roam::generate::gallery({.triangles = 10'000}));
  const auto& straight = roam::generate::gallery_paths[0];
  const Drawn drawn(gallery, {straight.from, straight.to}, Mode::fly, roam::WalkerSettings::sphere(0.3), 50.0);
  const Point start = drawn.only<Disc>("plan start").centre, end = drawn.only<Disc>("plan end").centre;
  EXPECT_GT(end.x - start.x, 1500.0);
  EXPECT_NEAR(end.y, start.y, 20.0);
  EXPECT_NEAR(glm::distance(start, end), drawn.scale("plan scale") * glm::distance(straight.from, straight.to), 2.0);
  // The axes say how it was turned: the way leads along x + y.
  const auto axis = [&](const char* name) {
    const auto line = drawn.only<Lines>(name).lines.at(0);
    return (line.at(1) - line.at(0)) / glm::distance(line.at(0), line.at(1));
  };
  const Vec3 way = glm::normalize(straight.to - straight.from);
  const Point on_sheet = way.x * axis("plan axis x") + way.y * axis("plan axis y");
  EXPECT_NEAR(on_sheet.x, 1.0, 0.01);
  EXPECT_NEAR(on_sheet.y, 0.0, 0.02);
  EXPECT_FALSE(drawn.all<Lines>("detail A plan walls").empty());
  EXPECT_FALSE(drawn.all<Lines>("detail A section walls").empty());
  EXPECT_NEAR(drawn.only<Disc>("detail A plan body").radius, 0.3 * drawn.scale("detail scale"), 1e-6);
  EXPECT_TRUE(drawn.says("heights exaggerated"));
}

TEST(PictureSheet, ShowsTheSpaceOfTheBodyInADetailOfALongPiece) {
  // Measured only at both ends, as a way of hours is.
  const draw::Record record;
  const draw::Way way;
  draw::RoomSurvey survey;
  for (const double along : {0.0, 100.0}) {
    draw::Station& station = survey.stations.emplace_back();
    station.centre = {along, 0.0, 0.9};
    station.along = along;
    station.height = 1.8;
  }
  const draw::WalkDrawing walk{Mode::walk, 0.3, record, way, survey, 1000, {}, {}, {}, {}};
  for (const double middle : {50.0, -50.0}) {
    draw::Page page;
    draw::Panel panel =
        page.panel("detail A section", {draw::Rect::around({middle, 0.9}, 10.0, 3.0), 80.0, 80.0}, draw::sheet_margin);
    paint_section(panel, walk, {}, 0.0);
    EXPECT_EQ(sheets::all<Lines>(page.finish(), "detail A section band").size(), middle > 0.0 ? 1u : 0u);
  }
}

TEST(PictureSheet, HasAShortTitleForAnyNumberOfFiles) {
  const std::string title = "first.ply" + std::string(100'000, 'W') + " along p.path";
  const Drawn drawn(corridor(1.2), along_corridor, Mode::walk, {}, 1.4, title);
  EXPECT_LT(drawn.sheet.height, 4000.0);
  EXPECT_TRUE(drawn.says("first.ply"));
  EXPECT_TRUE(drawn.says("p.path"));
  const std::vector<Text> texts = sheets::all<Text>(draw::opening_sheet(title, {}, {}), "title");
  EXPECT_LT(texts.size(), 20u);
}

TEST(PictureSheet, SaysWhereItFell) {
  const Drawn drawn(floors_with_gap(1.5), {{2, 0, 0.9}, {12, 0, 0.9}}, Mode::walk);
  ASSERT_EQ(drawn.report.result.outcome, roam::Outcome::fell);
  EXPECT_EQ(drawn.all<Lines>("plan fell").size(), 1u);
  EXPECT_EQ(drawn.all<Text>("section fell label").size(), 1u);
}

TEST(PictureLabels, BreakTextThatIsTooLong) {
  const auto width = [](const std::string& text) { return draw::measure_text(text, draw::small_font).width(); };
  const std::string text = "a few words and " + std::string(200, 'W') + " at the end";
  std::string joined;
  for (const std::string& line : draw::wrapped(text, 300, draw::small_font)) {
    EXPECT_LE(width(line), 300.0) << line;
    for (const char c : line) joined += c == ' ' ? "" : std::string(1, c);
  }
  EXPECT_EQ(joined, "afewwordsand" + std::string(200, 'W') + "attheend");
}

TEST(PictureLabels, ArePrintable) {
  Sheet sheet;
  draw::Labels labels(sheet);
  labels.write("name", "T\xc3\xbcr \xff\x1b[2J", {0.0, 0.0}, draw::small_font, draw::ink);
  labels.write("name", "A\xef\xbf\xbe\xef\xb7\x90\xf0\x9f\xbf\xbeZ", {0.0, 0.0}, draw::small_font, draw::ink);
  EXPECT_EQ(std::get<Text>(sheet.items.at(0)).text, "T\xc3\xbcr \xef\xbf\xbd\xef\xbf\xbd[2J");
  EXPECT_EQ(std::get<Text>(sheet.items.at(1)).text, "A\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbdZ");
}

TEST(PictureFile, ShowsWhatIsDrawnAfterAnyName) {
  const TestFolder folder;
  const auto svg = [&](bool with_box) {
    Sheet sheet;
    sheet.width = sheet.height = 100.0;
    draw::Labels(sheet).write("name", "A\xef\xbf\xbf", {10.0, 20.0}, draw::small_font, draw::ink);
    const draw::Rect box{{20.0, 30.0}, {40.0, 50.0}};
    if (with_box) sheet.items.emplace_back(Lines{"box", {box.outline()}, draw::wall_style, true});
    draw::PictureFile(folder.file("a.svg")).write(sheet);
    return folder.read("a.svg");
  };
  EXPECT_GT(svg(true).size(), svg(false).size());
}

TEST(PictureFile, TellsOnceWhatItLeavesOut) {
  const TestFolder folder;
  for (const bool all : {true, false}) {
    draw::Sheet sheet;
    sheet.width = sheet.height = 100.0;
    if (!all) sheet.coarsest = {"plan walls", 4.0, 0.4, 12};
    if (!all) sheet.runs_left_out = 3;
    testing::internal::CaptureStderr();
    draw::PictureFile(folder.file("a.svg")).draw([&] { return sheet; });
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              all ? ""
                  : "roam: note: too many lines in the picture: the coarsest (plan walls) are rounded to 0.4 m, and "
                    "the 12 shortest left out\n"
                    "roam: note: too many jumps for the picture: 3 parts of the way between them are left out\n");
  }
}

TEST(PictureFileDeathTest, IsLeftOutAfterCtrlC) {
  const TestFolder folder;
  draw::PictureFile file(folder.file("a.svg"));
  const auto interrupted = [&] {
    roam::app::catch_signals();
    std::raise(SIGINT);
    file.draw([]() -> draw::Sheet { throw roam::Cancelled(); });
    std::_Exit(0);
  };
  EXPECT_EXIT(interrupted(), testing::ExitedWithCode(0), "note: .*a.svg was not drawn: Ctrl-C came before");
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.svg")));
}

TEST(PictureFile, IsNotReplacedByOneThatCannotBeDrawn) {
  const TestFolder folder;
  Sheet sheet;
  sheet.width = sheet.height = 100.0;
  for (const char* name : {"a.svg", "a.png"}) {
    draw::PictureFile(folder.file(name)).write(sheet);
    const std::string before = folder.read(name);
    Sheet bad = sheet;
    bad.items.emplace_back(Text{"name", "\xef\xbf\xbf", {10.0, 20.0}, draw::small_font, draw::ink, {}});
    EXPECT_THROW(draw::PictureFile(folder.file(name)).write(bad), roam::Error) << name;
    EXPECT_EQ(folder.read(name), before) << name;
  }
}

}  // namespace
