// Objects on and off by name.
#include "view/layers.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <sstream>

#include "view_stores.h"

namespace {

using namespace roam;
using namespace roam::app;

/// A body in a room of 20 m x 4 m x 3 m, at (10, 0), looking along +x at its wall "front".
class Layered : public view_stores::Driven {
 public:
  explicit Layered(const std::vector<std::string>& hide = {}, bool has_store = false) {
    write_scene();
    options.size = "640x360";
    options.at = {10, 0, 0.95, 0};
    options.hide = hide;
    if (has_store) build();
    begin();
    run(0.5);
  }
  /// Clicks the row of the list with this text, or its arrow.
  void click(const std::string& text) {
    run(0.1);
    session->stage().draw();  // one clicks on what one sees
    const graphics::Hud& hud = session->stage().hud();
    // The list says its rows from top to bottom, and each is one of the names at its height.
    std::vector<std::string> rows;
    std::istringstream lines(hud.text());
    bool in_list = false;
    for (std::string line; std::getline(lines, line);) {
      if (in_list) rows.push_back(line.size() > 4 && line[0] == '[' ? line.substr(4) : line);
      in_list = in_list || line.starts_with("Objects: ");
    }
    const auto row = std::find(rows.begin(), rows.end(), text);
    ASSERT_NE(row, rows.end()) << hud.text();
    std::string last;
    std::ptrdiff_t seen = -1;
    constexpr double x = 0.9;
    for (double y = 1.0; y > -1.0; y -= 0.005) {
      const std::string name = hud.list_at(x, y);
      if (name.empty() || name == graphics::Hud::list_search || name == last) continue;
      last = name;
      if (++seen == row - rows.begin()) return press_at(x, y - 0.01);
    }
    ADD_FAILURE() << text << " is not to be seen";
  }
  /// Clicks the part of the list with this name.
  void click_part(const std::string& name, unsigned button = 1, int times = 1) {
    run(0.1);
    session->stage().draw();
    constexpr double x = 0.9;
    for (double y = 1.0; y > -1.0; y -= 0.005) {
      if (session->stage().hud().list_at(x, y) == name) return press_at(x, y - 0.01, button, times);
    }
    ADD_FAILURE() << name << " is not to be seen";
  }
  void press_at(double x, double y, unsigned button = 1, int times = 1) {
    const osgGA::GUIEventAdapter& now = *events().getCurrentEventState();
    const bool upwards = now.getMouseYOrientation() == osgGA::GUIEventAdapter::Y_INCREASING_UPWARDS;
    const auto place = [](double share, float least, float most) {
      return least + static_cast<float>(0.5 * (1.0 + share)) * (most - least);
    };
    const float across = place(x, now.getXmin(), now.getXmax());
    const float up = place(upwards ? y : -y, now.getYmin(), now.getYmax());
    for (int i = 0; i < times; ++i) {
      events().mouseButtonPress(across, up, button);
      events().mouseButtonRelease(across, up, button);
    }
    run(1.0 / 60.0);
  }
  void show_list() { session->run("layers"); }
  /// Walks ahead for some seconds.
  void walk(double seconds) {
    press(osgGA::GUIEventAdapter::KEY_Up);  // letters are for the list
    run(seconds);
    release(osgGA::GUIEventAdapter::KEY_Up);
    run(0.5);
  }
  /// The triangles that are drawn.
  [[nodiscard]] std::uint64_t drawn() {
    class Count : public osg::NodeVisitor {
     public:
      Count() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
      void apply(osg::Geometry& geometry) override {
        for (unsigned i = 0; i < geometry.getNumPrimitiveSets(); ++i) {
          triangles += geometry.getPrimitiveSet(i)->getNumIndices() / 3;
        }
      }
      std::uint64_t triangles = 0;
    } count;
    run(0.2);
    session->stage().frame().space()->accept(count);
    return count.triangles;
  }
};

/// Begins with the list of the scene's objects.
void list_layers(view_stores::Driven& d) {
  d.options.size = "640x360";
  d.options.at = {10, 0, 0.95, 0};
  d.begin();
  d.session->run("layers");
}

TEST(Layers, AreHiddenAndShownByTheMouse) {
  Layered d;
  const std::uint64_t all = d.drawn();
  d.show_list();
  EXPECT_TRUE(contains(d.hud(), "Objects: 6, hidden: 0")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "[x] ceiling")) << d.hud();
  d.click("front");
  EXPECT_TRUE(contains(d.hud(), "[ ] front")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "hidden: 1 of 6 objects; the body meets them")) << d.hud();
  EXPECT_EQ(d.drawn(), all - 2) << "its two triangles";
  d.walk(9.0);
  EXPECT_NEAR(d.place().x, 19.7, 0.02) << "it is still a wall";
  d.click("front");
  EXPECT_EQ(d.drawn(), all);
  d.click("left");
  d.click("right");
  EXPECT_EQ(d.drawn(), all - 4);
  d.click("show all");
  EXPECT_EQ(d.drawn(), all);
}

TEST(Layers, LetTheBodyThroughIfItIsSaid) {
  Layered d;
  d.session->roamer().setMode(Mode::fly);  // there is no floor behind the wall
  d.show_list();
  d.click("front");
  d.click("the body passes through what is hidden");
  EXPECT_TRUE(contains(d.hud(), "hidden: 1 of 6 objects; the body passes through")) << d.hud();
  EXPECT_NEAR(d.place().x, 10.0, 1e-6) << "it stays where it was";
  d.walk(9.0);
  EXPECT_GT(d.place().x, 20.3) << "past the wall at 20";
  // Back inside, the wall is solid again.
  d.session->roamer().setPose({12, 0, 1.5}, 0.0, 0.0);
  d.click("front");
  EXPECT_FALSE(contains(d.hud(), "hidden: 1 of")) << d.hud();
  d.walk(9.0);
  EXPECT_NEAR(d.place().x, 19.7, 0.02);
  const Json json = json_report(d.finish());
  EXPECT_EQ(json["hidden"]["objects"], 0);
  EXPECT_EQ(json["hidden"]["passed"], true);
}

TEST(Layers, StayWallsWhileAllMovesAreVerified) {
  view_stores::Driven d;
  d.write_scene();
  d.options.at = {10, 0, 0.95, 0};
  d.options.verify = true;
  d.options.hide = {"front"};
  d.begin();
  const std::shared_ptr<const Space> space = d.session->roamer().space();
  d.session->hidden().pass_through(true);
  EXPECT_TRUE(contains(d.hud(), "stays a wall while all moves are verified")) << d.hud();
  EXPECT_EQ(d.session->roamer().space(), space);
}

TEST(Layers, ArePassedAsSoonAsTheWallsAreLoaded) {
  view_stores::Driven d;
  d.write_scene();
  d.options.at = {10, 0, 0.95, 0};
  d.options.hide = {"front"};
  d.session.emplace(d.options, make_plan(d.options, {}), ViewSettings{});
  d.session->hidden().pass_through(true);
  ASSERT_TRUE(d.until([&] { return d.session->roaming() && d.session->hidden().visible() != nullptr; }));
  EXPECT_FALSE(d.session->roamer().space()->ray({10, 0, 1.5}, {50, 0, 0}).hit);
  EXPECT_FALSE(contains(d.hud(), "a store")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "the body passes through")) << d.hud();
}

TEST(Layers, OfAStoreAreHiddenButStayWalls) {
  Layered d({}, true);
  ASSERT_TRUE(d.on_store());
  const std::uint64_t all = d.drawn();
  d.show_list();
  d.click("front");
  EXPECT_EQ(d.drawn(), all - 2);
  d.click("the body passes through what is hidden");
  EXPECT_TRUE(contains(d.hud(), "With a store, the body meets hidden objects")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "hidden: 1 of 6 objects; the body meets them")) << d.hud();
  d.walk(9.0);
  EXPECT_NEAR(d.place().x, 19.7, 0.02);
}

TEST(Layers, AreHiddenFromTheStartByAnOption) {
  const std::uint64_t all = Layered().drawn();
  Layered d({"front", "ce*", "nothing"});
  EXPECT_EQ(d.drawn(), all - 4);
  EXPECT_TRUE(contains(d.hud(), "hidden: 2 of 6 objects")) << d.hud();
  const ViewReport report = d.finish();
  EXPECT_EQ(report.hidden_objects, 2u);
  EXPECT_EQ(
      std::count_if(report.notes.begin(), report.notes.end(),
                    [](const std::string& note) { return contains(note, "matches 'nothing'; nothing was hidden"); }),
      1)
      << "however short the session was";
}

TEST(Layers, OfTooGreatANumberArePassedByNoProbe) {
  std::string obj = room_obj();
  for (int i = 0; i < 1001; ++i) obj += "o shelf_" + std::to_string(i) + "\nf 1 2 3\n";
  view_stores::Driven d;
  d.write_scene(obj);
  d.options.at = {10, 0, 0.95, 0};
  d.options.hide = {"shelf_*"};
  d.begin();
  d.session->hidden().pass_through(true);
  d.tap('t');
  d.session->stage().draw();
  const osgGA::GUIEventAdapter& now = *d.events().getCurrentEventState();
  const float x = 0.5f * (now.getXmin() + now.getXmax()), y = 0.5f * (now.getYmin() + now.getYmax());
  d.events().mouseButtonPress(x, y, 1);
  d.events().mouseButtonRelease(x, y, 1);
  d.run(0.1);
  d.session->run("probe");
  EXPECT_TRUE(contains(d.hud(), "Too many objects are hidden for a probe")) << d.hud();
}

TEST(Layers, KeepAButtonNoLongerThanItIsDown) {
  Layered d;
  d.show_list();
  d.run(0.1);
  d.session->stage().draw();
  const osgGA::GUIEventAdapter& now = *d.events().getCurrentEventState();
  const auto at = [&](float across) { return now.getXmin() + across * (now.getXmax() - now.getXmin()); };
  const float y = 0.5f * (now.getYmin() + now.getYmax());
  d.events().mouseButtonPress(at(0.95f), y, 1);
  d.run(0.1);
  d.show_list();  // hides it
  d.events().mouseButtonRelease(at(0.95f), y, 1);
  d.run(0.1);
  d.show_list();
  d.run(0.1);
  const double before = d.session->roamer().yaw();
  d.events().mouseButtonPress(at(0.2f), y, 1);
  for (const float across : {0.25f, 0.3f, 0.35f}) d.events().mouseMotion(at(across), y);
  d.run(0.1);
  d.events().mouseButtonRelease(at(0.35f), y, 1);
  EXPECT_NE(d.session->roamer().yaw(), before) << "a drag outside of the list turns the head";
}

TEST(Layers, AreNotFoundByClicksWhenHidden) {
  Layered d({"front"});
  d.tap('t');
  d.session->stage().draw();
  d.press_at(0.0, 0.0);
  EXPECT_TRUE(contains(d.hud(), "There is no surface here")) << d.hud();
  EXPECT_FALSE(contains(d.hud(), "ahead: front")) << d.hud();
}

TEST(Layers, AreSearched) {
  Layered d;
  d.show_list();
  d.run(0.1);
  d.session->stage().draw();
  const graphics::Hud& hud = d.session->stage().hud();
  double y = 1.0;
  while (y > -1.0 && hud.list_at(0.9, y) != graphics::Hud::list_search) y -= 0.01;
  ASSERT_GT(y, -1.0);
  d.press_at(0.9, y - 0.01);
  for (const char c : std::string("ri")) d.tap(c);
  d.tap(osgGA::GUIEventAdapter::KEY_Return);
  EXPECT_TRUE(contains(d.hud(), "[x] right")) << d.hud();
  EXPECT_FALSE(contains(d.hud(), "left")) << d.hud();
  d.press_at(0.9, y - 0.01);
  EXPECT_TRUE(contains(d.hud(), "[x] left")) << "another click ends the search: " << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  EXPECT_FALSE(contains(d.hud(), "Objects: ")) << d.hud();
}

TEST(Layers, AreSearchedByTyping) {
  Layered d;
  const Vec3 before = d.place();
  d.show_list();
  for (const char c : std::string("wri")) d.tap(c);
  EXPECT_FALSE(contains(d.hud(), "right")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "show all")) << d.hud();
  for (int i = 0; i < 2; ++i) d.tap(osgGA::GUIEventAdapter::KEY_BackSpace);
  d.tap(osgGA::GUIEventAdapter::KEY_BackSpace);
  for (const char c : std::string("ri")) d.tap(c);
  EXPECT_TRUE(contains(d.hud(), "[x] right")) << "at each letter: " << d.hud();
  EXPECT_FALSE(contains(d.hud(), "left")) << d.hud();
  d.run(0.5);
  EXPECT_LT(glm::distance(d.place(), before), 1e-6) << "the letters move nobody";
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  EXPECT_FALSE(contains(d.hud(), "Objects: ")) << d.hud();
  d.press('w');
  d.run(1.0);
  EXPECT_GT(glm::distance(d.place(), before), 0.5) << "without the list they do";
}

TEST(Layers, AreSearchedByTypingInEveryCamera) {
  Layered d;
  d.tap('2');
  d.show_list();
  d.tap('l');
  EXPECT_TRUE(contains(d.hud(), "[x] left")) << d.hud();
  EXPECT_FALSE(contains(d.hud(), "front")) << d.hud();
  EXPECT_EQ(d.session->tools().plan().size(), graphics::PlanSize::none) << "which is on that key";
}

TEST(Layers, AreNamedWithoutTheIdentifiersOfIfc) {
  std::string obj = room_obj();
  for (const char* name :
       {"Roof_0YvctVUKr0kugbFTf53O9L", "Wall_1YvctVUKr0kugbFTf53O9L", "Wall_2YvctVUKr0kugbFTf53O9L"}) {
    obj += std::string("o ") + name + "\nf 1 2 3\n";
  }
  view_stores::Driven d;
  d.write_scene(obj);
  list_layers(d);
  EXPECT_TRUE(contains(d.hud(), "[x] Roof\n")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "[x] Wall_1YvctVUKr0kugbFTf53O9L\n")) << "it is not the only wall: " << d.hud();
}

TEST(Layers, OfSeveralScenesAreBelowTheirFiles) {
  view_stores::Driven d;
  d.write_scene();
  d.options.scene.scenes.emplace_back(d.folder.write("shelf.obj", "v 1 0 0\nv 2 0 0\nv 2 1 0\no shelf\nf 1 2 3\n"));
  list_layers(d);
  ASSERT_TRUE(d.until([&] { return d.session->scene().report().has_value(); }));
  EXPECT_TRUE(contains(d.hud(), "[x] scene.obj (6)\n[x] shelf.obj (1)\n")) << d.hud();
}

TEST(Layers, AreScrolled) {
  std::string obj = room_obj();
  for (int i = 0; i < 100; ++i) obj += "o shelf_" + std::to_string(100 + i) + "\nf 1 2 3\n";
  view_stores::Driven d;
  d.write_scene(obj);
  list_layers(d);
  EXPECT_TRUE(contains(d.hud(), "floor")) << d.hud();
  EXPECT_FALSE(contains(d.hud(), "shelf_199")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "wheel: ")) << d.hud();
  d.session->stage().draw();
  const osgGA::GUIEventAdapter& now = *d.events().getCurrentEventState();
  const float x = now.getXmin() + 0.9f * (now.getXmax() - now.getXmin());
  const float y = 0.5f * (now.getYmin() + now.getYmax());
  d.events().mouseMotion(x, y);
  const double speed = d.session->roamer().speed();
  for (int i = 0; i < 60; ++i) d.events().mouseScroll(osgGA::GUIEventAdapter::SCROLL_DOWN);
  EXPECT_TRUE(contains(d.hud(), "shelf_199")) << d.hud();
  EXPECT_FALSE(contains(d.hud(), "[x] floor")) << d.hud();
  EXPECT_FALSE(contains(d.hud(), "wheel: ")) << d.hud();
  EXPECT_EQ(d.session->roamer().speed(), speed) << "the wheel is the list's";
}

TEST(BookmarkList, TakesADoubleClickForOne) {
  Layered d;
  d.session->run("bookmarks");
  d.click_part(graphics::Hud::list_search, 1, 2);
  EXPECT_TRUE(contains(d.hud(), "Bookmarks: 1")) << d.hud();
  d.tap('b');
  d.click_part("0", 3, 2);
  EXPECT_TRUE(contains(d.hud(), "Bookmarks: 1")) << "the other one stays: " << d.hud();
}

TEST(BookmarkList, LeadsToWhatIsClicked) {
  Layered d;
  d.session->run("bookmarks");
  EXPECT_TRUE(contains(d.hud(), "Bookmarks: 0")) << d.hud();
  d.click_part(graphics::Hud::list_search);
  EXPECT_TRUE(contains(d.hud(), "Bookmarks: 1")) << d.hud();
  d.walk(2.0);
  ASSERT_GT(d.place().x, 12.0);
  d.click_part("0");
  EXPECT_NEAR(d.place().x, 10.0, 1e-3);
  EXPECT_TRUE(contains(d.hud(), "right click: deletes")) << d.hud();
  d.click_part("0", 3);
  EXPECT_TRUE(contains(d.hud(), "bookmark 1 is deleted") && contains(d.hud(), "Bookmarks: 0")) << d.hud();
  d.show_list();
  EXPECT_TRUE(contains(d.hud(), "Objects: 6")) << d.hud();
  EXPECT_FALSE(contains(d.hud(), "Bookmarks: ")) << "one list at a time";
  d.session->run("bookmarks");
  EXPECT_FALSE(contains(d.hud(), "Objects: ")) << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  EXPECT_FALSE(contains(d.hud(), "Bookmarks: ")) << d.hud();
}

TEST(BookmarkList, SaysWhatAClickCannotDo) {
  Layered d;
  d.tap('b');
  d.session->run("bookmarks");
  const std::string good = d.folder.read("config/roam/bookmarks.json");
  d.folder.write("config/roam/bookmarks.json", "[");
  d.click_part(graphics::Hud::list_search);
  EXPECT_TRUE(contains(d.hud(), "correct the file")) << d.hud();
  d.click_part("0", 3);
  EXPECT_TRUE(contains(d.hud(), "Bookmarks: 1")) << "nothing is deleted: " << d.hud();
  d.folder.write("config/roam/bookmarks.json", good);
  d.click_part("0");  // or both were a double click
  d.click_part("0", 3);
  EXPECT_TRUE(contains(d.hud(), "Bookmarks: 0")) << d.hud();
}

TEST(BookmarkList, SaysThatAPlaceIsNone) {
  Layered d;
  d.tap('b');
  d.session.reset();
  nlohmann::json kept = nlohmann::json::parse(d.folder.read("config/roam/bookmarks.json"));
  kept[0]["bookmarks"][0]["position"] = {1e308, 1e308, 1e308};
  d.folder.write("config/roam/bookmarks.json", kept.dump());
  d.begin();
  const Vec3 before = d.place();
  d.session->run("bookmarks");
  d.click_part("0");
  EXPECT_TRUE(contains(d.hud(), "is not a point within 1e9 m")) << d.hud();
  EXPECT_EQ(d.place(), before);
}

}  // namespace
