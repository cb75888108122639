// roam walk --picture as a shell sees it.
#include <cairo.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli_scenes.h"
#include "messages.h"
#include "program.h"

namespace {

/// A room with something to walk along in a folder of its own.
struct Picture {
  TestFolder folder;
  std::string scene = folder.write("room.obj", room_obj());
  std::string path = folder.write("tour.path", "2 0 0.9\n18 0 0.9\n");
  ProgramResult result;

  void draw(const std::string& file, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"walk",     scene, "--path",    path,
                                       "--height", "1.8", "--picture", folder.file(file)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    result = run_program(ROAM_PROGRAM, arguments);
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.file("")), {}));
  }
};

void collect(const tinyxml2::XMLElement& element, std::multiset<std::string>& names) {
  names.insert(element.Name());
  for (auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    collect(*child, names);
  }
}

TEST(WalkPicture, IsWellFormedSvg) {
  Picture picture;
  picture.draw("tour.svg");
  EXPECT_EQ(picture.result.status, 0) << picture.result.err;
  const std::string svg = picture.folder.read("tour.svg");
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(svg.data(), svg.size()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  const tinyxml2::XMLElement* root = document.RootElement();
  ASSERT_STREQ(root->Name(), "svg");
  EXPECT_EQ(root->IntAttribute("width"), 2000);
  EXPECT_GT(root->IntAttribute("height"), 500);
  std::multiset<std::string> names;
  collect(*root, names);
  EXPECT_GT(names.count("path"), 50u);  // walls, way, bodies, marks, frames, the glyphs of the texts
  EXPECT_GT(names.count("use"), 100u);  // the letters
  EXPECT_LT(svg.size(), 1'000'000u);
  EXPECT_EQ(picture.files(), 3u);  // nothing temporary is left
}

TEST(WalkPicture, IsAPngWithSomethingOnIt) {
  Picture picture;
  picture.draw("tour.PNG", {"--json", "--verify", "--trace", picture.folder.file("tour.csv")});
  EXPECT_EQ(picture.result.status, 0) << picture.result.err;
  EXPECT_EQ(nlohmann::json::parse(picture.result.out)["violations"], 0);
  EXPECT_TRUE(contains(picture.folder.read("tour.csv"), "step,t,x,y,z"));
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> image(
      cairo_image_surface_create_from_png(picture.folder.file("tour.PNG").c_str()), cairo_surface_destroy);
  ASSERT_EQ(cairo_surface_status(image.get()), CAIRO_STATUS_SUCCESS);
  EXPECT_EQ(cairo_image_surface_get_width(image.get()), 2000);
  const int height = cairo_image_surface_get_height(image.get());
  ASSERT_GT(height, 500);
  std::set<std::uint32_t> colours;
  std::size_t drawn = 0;
  for (int y = 0; y < height; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(image.get()) +
                                                             y * cairo_image_surface_get_stride(image.get()));
    for (int x = 0; x < 2000; ++x) {
      colours.insert(row[x] & 0xffffffU);
      if ((row[x] & 0xffffffU) != 0xffffffU) ++drawn;
    }
  }
  const auto share = static_cast<double>(drawn) / (2000.0 * height);
  EXPECT_GT(share, 0.01);
  EXPECT_LT(share, 0.3);
  EXPECT_GT(colours.size(), 20u);
}

TEST(WalkPicture, IsDrawnOfEveryOutcome) {
  Picture picture;
  picture.path = picture.folder.write("tour.path", "2 0 0.9\n25 0 0.9\n");
  picture.draw("blocked.svg");
  EXPECT_EQ(picture.result.status, 3);
  EXPECT_TRUE(std::filesystem::exists(picture.folder.file("blocked.svg")));
  picture.draw("ghost.svg", {"--mode", "ghost"});
  EXPECT_EQ(picture.result.status, 0);
  EXPECT_TRUE(std::filesystem::exists(picture.folder.file("ghost.svg")));
  const auto wandered = run_program(
      ROAM_PROGRAM, {"walk", picture.scene, "--wander", "5", "--picture", picture.folder.file("wander.svg")});
  EXPECT_EQ(wandered.status, 0) << wandered.err;
  EXPECT_TRUE(std::filesystem::exists(picture.folder.file("wander.svg")));
}

TEST(WalkPicture, IsTheSameEachTime) {
  Picture picture;
  picture.draw("one.png");
  picture.draw("two.png", {"--threads", "1"});
  EXPECT_EQ(picture.folder.read("one.png"), picture.folder.read("two.png"));
  EXPECT_FALSE(picture.folder.read("one.png").empty());
}

TEST(WalkPicture, IsRefusedInOtherFormatsBeforeTheSceneIsRead) {
  Picture picture;
  picture.scene = picture.folder.write("broken.obj", "this is no scene");
  for (const char* file : {"tour.pdf", "tour", "tour.svgz", "tour.jpg"}) {
    picture.draw(file);
    EXPECT_EQ(picture.result.status, 2) << file;
    EXPECT_TRUE(contains(picture.result.err, "an .svg, a .png or a .dxf")) << picture.result.err;
    EXPECT_FALSE(std::filesystem::exists(picture.folder.file(file)));
  }
}

TEST(WalkPicture, DoesNotOverwriteWhatIsReadOrTheTrace) {
  Picture picture;
  const std::string scene = picture.folder.write("scene.svg", room_obj());
  const std::string path = picture.folder.write("way.png", "2 0 0.9\n18 0 0.9\n");
  const auto run = [&](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"walk", scene, "--path", path, "--picture", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(ROAM_PROGRAM, arguments);
  };
  const auto over_scene = run(scene, {}), over_path = run(path, {});
  EXPECT_EQ(over_scene.status, 2);
  EXPECT_TRUE(contains(over_scene.err, "would overwrite the scene")) << over_scene.err;
  EXPECT_EQ(over_path.status, 2);
  EXPECT_TRUE(contains(over_path.err, "would overwrite the path")) << over_path.err;
  EXPECT_EQ(picture.folder.read("scene.svg"), room_obj());
  const std::string both = picture.folder.file("new.svg");
  const auto over_trace = run(both, {"--trace", picture.folder.file("") + "./new.svg"});
  EXPECT_EQ(over_trace.status, 2);
  EXPECT_TRUE(contains(over_trace.err, "would overwrite the file of --trace")) << over_trace.err;
}

TEST(WalkPicture, FailsEarlyWhereItCannotBeWritten) {
  Picture picture;
  picture.draw("no/such/folder/tour.svg");
  EXPECT_EQ(picture.result.status, 2);
  EXPECT_TRUE(contains(picture.result.err, "there is no folder ")) << picture.result.err;
  EXPECT_TRUE(picture.result.out.empty());
}

TEST(WalkPicture, LeavesTheOldOneWhenTheWalkFails) {
  Picture picture;
  const std::string old = "<?xml version=\"1.0\"?>\n<!-- made by roam -->\n";
  picture.folder.write("tour.svg", old);
  picture.scene = picture.folder.write("broken.obj", "this is no scene");
  picture.draw("tour.svg");
  EXPECT_EQ(picture.result.status, 1);
  EXPECT_EQ(picture.folder.read("tour.svg"), old);
  EXPECT_EQ(picture.files(), 4u);
}

}  // namespace
