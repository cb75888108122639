// roam view of scenes whose pages are hostile: the process that draws opens no file of a scene and starts nothing but
// readers. Seen from outside, by strace.

#include <filesystem>
#include <map>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/Texture2D>
#include <regex>
#include <set>

#include "graphics/shading.h"
#include "hostile_scene.h"
#include "view/page_source.h"
#include "view/shown_objects.h"
#include "view_scenes.h"

namespace {

namespace fs = std::filesystem;

/// A floor of 40 m by 40 m.
const std::string floor_geode =
    "Geode {\nnum_drawables 1\nGeometry {\nPrimitives 1\n{\nDrawArrays QUADS 0 4\n}\nVertexArray Vec3Array 4\n{\n-20 "
    "-20 "
    "0\n20 -20 0\n20 20 0\n-20 20 0\n}\n}\n}\n";

std::string group(const std::vector<std::string>& children) {
  std::string text = "Group {\nnum_children " + std::to_string(children.size()) + "\n";
  for (const std::string& child : children) text += child;
  return text + "}\n";
}

/// A floor that a page takes the place of, wherever the eye is.
std::string paged(const std::string& page) {
  return "PagedLOD {\nCenter 0 0 0\nRadius 30\nRangeList 2 {\n1e+9 1e+10\n0 1e+9\n}\nFileNameList 2 {\n\"\"\n\"" +
         page + "\"\n}\nnum_children 1\n" + floor_geode + "}\n";
}

/// What strace saw, line by line: the call, and whether a reader made it.
struct Call {
  std::string text;
  bool by_reader = false;
};

std::vector<Call> calls_in(const std::string& trace) {
  const std::vector<TracedCall> calls = traced_calls(trace);
  std::set<std::string> readers;
  std::map<std::string, std::string> parent;
  const std::regex born("(?:clone|clone3|fork|vfork)[^=]*=.*?(\\d+)$");
  for (const auto& [process, text] : calls) {
    if (text.starts_with("execve(") && contains(text, "roam-reader\"")) readers.insert(process);
    std::smatch child;
    if (std::regex_search(text, child, born)) parent[child[1]] = process;
  }
  std::vector<Call> all;
  for (const auto& [process, text] : calls) {
    Call call{text, false};
    for (std::string one = process; !one.empty() && !call.by_reader; one = parent[one]) {
      call.by_reader = readers.contains(one);
    }
    all.push_back(call);
  }
  return all;
}

/// A part with a textured triangle, and a node with one level that is there and one that is a page.
roam::DisplayPart small_part() {
  roam::DisplayPart part;
  part.textures.push_back(
      {1, 1, roam::DisplayTexels::rgb, roam::DisplayWrap::repeat, roam::DisplayWrap::clamp, 1, {9, 8, 7}});
  part.looks = {{0, roam::DisplayCover::cut, 0.25f}, {}};
  roam::DisplayGeometry geometry;
  geometry.cell = {256, 0, 0};
  geometry.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  geometry.colours.assign(3, {1, 2, 3, 4});
  geometry.coordinates.assign(3, {0.5f, 0.25f});
  geometry.indices = {0, 1, 2};
  part.geometries = {geometry};
  part.groups = 2;
  part.pages.push_back(
      {0, {1, 2, 3}, 5.0f, roam::DisplayMeasure::pixels, {{0, 100, 1, {}}, {100, 1e30f, 0, "/secret/file.osgb"}}});
  return part;
}

const auto rules = std::make_shared<roam::app::PageRules>();

TEST(ViewPages, AreNodesAsThePictureWantsThem) {
  roam::app::SceneObjects objects;
  const osg::ref_ptr<osg::Group> node = roam::app::make_node(
      small_part(), {4.0f}, [](const std::string&) { return std::string("page-1"); }, objects, rules);
  ASSERT_EQ(node->getNumChildren(), 2u);
  const auto* cell = dynamic_cast<osg::MatrixTransform*>(node->getChild(0));
  ASSERT_TRUE(cell && cell->getNumChildren() == 1);
  EXPECT_EQ(cell->getMatrix().getTrans(), osg::Vec3d(256, 0, 0));
  const osg::Geometry* geometry = cell->getChild(0)->asGeometry();
  ASSERT_TRUE(geometry && geometry->getStateSet());
  EXPECT_TRUE(geometry->getUseVertexBufferObjects());
  EXPECT_FALSE(geometry->getUseDisplayList());
  EXPECT_TRUE(geometry->getColorArray()->getNormalize());
  EXPECT_EQ(geometry->getNormalArray()->getBinding(), osg::Array::BIND_OVERALL);
  const osg::StateSet& state = *geometry->getStateSet();
  EXPECT_TRUE(state.getDefinePair(roam::graphics::textured_define));
  EXPECT_TRUE(state.getUniform("roam_cutoff"));
  const auto* texture = dynamic_cast<const osg::Texture2D*>(state.getTextureAttribute(0, osg::StateAttribute::TEXTURE));
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->getMaxAnisotropy(), 4.0f);
  EXPECT_EQ(texture->getWrap(osg::Texture::WRAP_T), osg::Texture::CLAMP_TO_EDGE);
  EXPECT_EQ(texture->getImage()->data()[2], 7);
  const auto* pages = dynamic_cast<osg::PagedLOD*>(node->getChild(1));
  ASSERT_TRUE(pages && pages->getNumChildren() == 1 && pages->getNumFileNames() == 2);
  EXPECT_EQ(pages->getFileName(1), "page-1");
  EXPECT_EQ(pages->getMinRange(1), 100.0f);
  EXPECT_EQ(pages->getCenter(), osg::LOD::vec_type(1, 2, 3));
}

TEST(ViewPages, MaterialsOfTheirSurfacesAreDrawn) {
  roam::DisplayPart part = small_part();
  roam::DisplayLook& look = part.looks[0];
  look = {};
  roam::app::SceneObjects objects(std::vector<std::string>{});
  const auto state_of = [&] {
    const auto node = roam::app::make_node(
        part, {}, [](const std::string&) { return std::string("page-1"); }, objects, rules);
    const osg::ref_ptr<osg::Node> drawn = node->getChild(0)->asGroup()->getChild(0);
    return osg::ref_ptr<const osg::StateSet>(drawn->getStateSet());
  };
  part.geometries[0].coordinates.clear();
  EXPECT_FALSE(state_of()) << "nothing to set for a dull surface";
  look.roughness = 0.5f;
  ASSERT_TRUE(state_of());
  EXPECT_TRUE(state_of()->getUniform("roam_gloss"));
  look.emission = {255, 0, 0};
  EXPECT_TRUE(state_of()->getUniform("roam_emission"));
  part.geometries[0].coordinates.assign(3, {0.5f, 0.25f});
  look.gloss_texture = look.emission_texture = 0;
  for (const unsigned unit : {roam::graphics::gloss_unit, roam::graphics::emission_unit}) {
    EXPECT_TRUE(state_of()->getTextureAttribute(unit, osg::StateAttribute::TEXTURE));
  }
  EXPECT_FALSE(state_of()->getDefinePair(roam::graphics::textured_define));
}

TEST(ViewPages, ShowTheObjectsThatAreNotHidden) {
  roam::DisplayPart part = small_part();
  part.geometries[0].indices = {0, 1, 2, 2, 1, 0, 1, 0, 2};
  part.geometries[0].runs = {{1, 1}, {0, 2}};
  part.objects = {"wall", "door"};
  part.triangles = 3;
  roam::app::SceneObjects objects({"door"});
  const osg::ref_ptr<osg::Group> node = roam::app::make_node(
      part, {}, [](const std::string&) { return std::string("page"); }, objects, rules);
  osg::Geometry& geometry = *node->getChild(0)->asGroup()->getChild(0)->asGeometry();
  const auto indices = [&] {
    std::vector<unsigned> all;
    for (unsigned i = 0; i < geometry.getPrimitiveSet(0)->getNumIndices(); ++i) {
      all.push_back(geometry.getPrimitiveSet(0)->index(i));
    }
    return all;
  };
  EXPECT_EQ(indices(), (std::vector<unsigned>{2, 1, 0, 1, 0, 2})) << "hidden from the start";
  objects.set_hidden(0, true);
  EXPECT_TRUE(roam::app::show_objects(*node, *objects.flags()));
  EXPECT_FALSE(roam::app::show_objects(*node, *objects.flags())) << "it shows that already";
  EXPECT_EQ(geometry.getNodeMask(), 0u);
  objects.show_all();
  EXPECT_TRUE(roam::app::show_objects(*node, *objects.flags()));
  EXPECT_NE(geometry.getNodeMask(), 0u);
  EXPECT_EQ(indices().size(), 9u);
}

TEST(ViewPages, AreReadByMadeUpNamesAndNothingElseIs) {
  const TestFolder folder;
  const std::string image = folder.write("a.png", "");
  const osg::ref_ptr<roam::app::PageSource> source =
      new roam::app::PageSource({folder.file("gone.osg")}, {}, {}, std::make_shared<roam::app::SceneObjects>());
  const osg::ref_ptr<osg::Group> node = source->make(small_part());
  const std::string name = dynamic_cast<osg::PagedLOD&>(*node->getChild(1)).getFileName(1);
  EXPECT_FALSE(contains(name, "secret"));
  EXPECT_EQ(name.find_first_of("./"), std::string::npos);
  EXPECT_EQ(dynamic_cast<osg::PagedLOD&>(*source->make(small_part())->getChild(1)).getFileName(1), name);

  for (const std::string& other : {image, std::string("/secret/file.osgb"), std::string("page-99"), std::string()}) {
    EXPECT_FALSE(source->readNode(other, nullptr).success()) << other;
    EXPECT_FALSE(source->readObject(other, nullptr).success());
    EXPECT_FALSE(source->readImage(other, nullptr).success());
    EXPECT_FALSE(source->readShader(other, nullptr).success());
    EXPECT_FALSE(source->readScript(other, nullptr).success());
    EXPECT_FALSE(source->readHeightField(other, nullptr).success());
  }
  EXPECT_EQ(source->events(), 0u);
  EXPECT_EQ(source->missing(), 0u);
  // A page that cannot be read is missing once, and is not asked for again.
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(source->readNode(name, nullptr).validNode());
  EXPECT_EQ(source->missing(), 1u);
  EXPECT_EQ(source->events(), 2u);
}

TEST(ViewPages, ThatAreHostileReachNothingInTheProcessThatDraws) {
  if (run_program("/bin/sh", {"-c", "strace -o /dev/null true"}).status != 0) {
    GTEST_SKIP() << "strace is not there, or may not trace here";
  }
  const TestFolder folder;
  use_no_settings(folder);
  unsetenv("ROAM_READER");
  fs::create_directories(folder.file("scene/osgPlugins-3.6.5"));
  folder.write("scene/evil.lua", "os.execute('touch PWNED-by-lua')\n");
  folder.write("scene/x;touch PWNED-by-tgz;.tgz", "");
  folder.write("scene/a.xyz", "");
  folder.write("scene/osgPlugins-3.6.5/osgdb_xyz.so", "no library");
  folder.write("scene/proxy.osg", "ProxyNode {\nFileNameList 1 {\n\"a.xyz\"\n}\nnum_children 0\n}\n");
  folder.write("scene/good.osg", floor_geode);
  const std::string root =
      folder.write("scene/root.osg", group({paged("evil.lua"), paged("x;touch PWNED-by-tgz;.tgz"), paged("a.xyz"),
                                            paged("127.0.0.1:9/x.osgt.curl"), paged("proxy.osg"), paged("good.osg")}));
  const std::string command =
      "cd '" + folder.file("scene") + "' && exec strace -f -s 4096 -o '" + folder.file("trace") +
      "' -e trace=open,openat,openat2,execve,connect,clone,clone3,fork,vfork '" ROAM_PROGRAM "' view '" + root +
      "' --headless --size 320x200 --json --mode fly --at 0,0,2,0,-30 --screenshot '" + folder.file("shot.png") + "'";
  const ProgramResult result = run_program("/bin/sh", {"-c", command});
  bool good_read = false, font_read = false;
  for (const Call& call : calls_in(folder.read("trace"))) {
    const bool of_scene = contains(call.text, "scene/") || contains(call.text, "osgPlugins-3.6.5/osgdb_xyz") ||
                          contains(call.text, "(AT_FDCWD, \"osgPlugins");
    if (call.by_reader) {
      // What it may reach is seen to by its own tests.
      good_read = good_read || contains(call.text, "scene/good.osg");
      continue;
    }
    font_read = font_read || contains(call.text, ".ttf");
    if (call.text.starts_with("execve(")) {
      EXPECT_TRUE(contains(call.text, "roam-reader\"") || contains(call.text, ROAM_PROGRAM) ||
                  contains(call.text, "Xvfb"))
          << call.text;
    } else if (call.text.starts_with("connect(")) {
      EXPECT_FALSE(contains(call.text, "AF_INET")) << call.text;
    } else if (call.text.starts_with("open") && !contains(call.text, "O_DIRECTORY")) {
      // Whether the scene, or what lies beside it, is the folder of a store is looked at.
      EXPECT_FALSE(of_scene) << call.text;
    }
  }
  EXPECT_TRUE(good_read);
  EXPECT_TRUE(font_read);
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json report = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_TRUE(report.is_object()) << result.out;
  // Every page was wanted, and the hostile ones are missing.
  EXPECT_GE(report["missing_pages"], 4) << result.out;
  EXPECT_TRUE(contains(all(report["notes"]), "page")) << result.out;
}

TEST(ViewPages, WhoseReaderCrashesAreMissing) {
  const TestFolder folder;
  use_no_settings(folder);
  folder.write("good.osg", floor_geode);
  const std::string root = folder.write("root.osg", group({paged("good.osg")}));
  const std::string script = folder.write("reader",
                                          "#!/bin/sh\ncase \"$*\" in *--pages*) head -c 4 >/dev/null; kill -SEGV $$ ;; "
                                          "esac\nexec '" ROAM_READER_PROGRAM "' \"$@\"\n");
  fs::permissions(script, fs::perms::owner_all);
  setenv("ROAM_READER", script.c_str(), 1);
  const ProgramResult result =
      run_program(ROAM_PROGRAM, {"view", root, "--headless", "--size", "320x200", "--json", "--mode", "fly", "--at",
                                 "0,0,2,0,-30", "--screenshot", folder.file("shot.png")});
  unsetenv("ROAM_READER");
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json report = nlohmann::json::parse(result.out, nullptr, false);
  EXPECT_EQ(report["missing_pages"], 1) << result.out;
  EXPECT_TRUE(contains(all(report["notes"]), "1 page of the scene could not be read")) << result.out;
  EXPECT_TRUE(contains(all(report["notes"]), "crash with signal 11")) << result.out;
  EXPECT_FALSE(contains(result.err, "page-1")) << result.err;
}

}  // namespace
