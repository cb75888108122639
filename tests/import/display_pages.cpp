// Pages of a scene that is shown: read one by one in another process, with what holds for all that is shown.

#include <sys/wait.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <functional>
#include <glm/geometric.hpp>
#include <string>
#include <thread>
#include <vector>

#include "import/find_reader.h"
#include "import/page_reader.h"
#include "shown_scene.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

std::string triangle_at(const std::string& x) {
  return "Geode {\nnum_drawables 1\nGeometry {\nPrimitives 1\n{\nDrawArrays TRIANGLES 0 3\n}\nVertexArray Vec3Array "
         "3\n{\n" +
         x + " 0 0\n" + x + " 1 0\n" + x + " 0 1\n}\n}\n}\n";
}

std::string group(const std::string& name, const std::string& inside, const std::string& child,
                  const std::string& kind = "Group") {
  return kind + " {\nname \"" + name + "\"\n" + inside + "num_children 1\n" + child + "}\n";
}

/// A node that shows `coarse` from 100 m on, and the pages nearer.
std::string paged(const std::string& coarse, const std::vector<std::string>& files) {
  std::string ranges = "RangeList " + std::to_string(1 + files.size()) + " {\n100 1e+10\n";
  std::string names = "FileNameList " + std::to_string(1 + files.size()) + " {\n\"\"\n";
  for (const std::string& file : files) {
    ranges += "0 100\n";
    names += "\"" + file + "\"\n";
  }
  return "PagedLOD {\nCenter 1 2 3\nRadius 10\n" + ranges + "}\n" + names + "}\nnum_children 1\n" + coarse + "}\n";
}

const std::string moved = "Matrix {\n2 0 0 0\n0 2 0 0\n0 0 2 0\n10 0 0 1\n}\n";

TEST(ImportDisplayPages, AreReadWithWhatStandsAboveThem) {
  const TemporaryFolder folder;
  folder.write("pages/fine.osg", triangle_at("5"));
  const std::string red = "StateSet {\nMaterial {\nColorMode OFF\ndiffuseColor 1 0 0 1\n}\nGL_LIGHTING ON\n}\n";
  const auto file = folder.write(
      "root.osg",
      group("site", red, group("hall", moved, paged(triangle_at("1"), {"pages/fine.osg"}), "MatrixTransform")));
  Paging paging(file, {.up = UpAxis::y, .unit = LengthUnit::ft});
  const double ft = 0.3048;
  ASSERT_EQ(paging.root.pages.size(), 1u);
  const DisplayPages& pages = paging.root.pages[0];
  EXPECT_LT(glm::length(pages.center - ft * Vec3(12, -6, 4)), 1e-6);
  EXPECT_NEAR(pages.radius, ft * 20, 1e-5);
  ASSERT_EQ(pages.levels.size(), 2u);
  EXPECT_NEAR(pages.levels[0].from, ft * 200, 1e-4);
  EXPECT_EQ(pages.levels[0].group, 1u);
  EXPECT_NEAR(pages.levels[1].to, ft * 200, 1e-4);
  ASSERT_EQ(paging.root.geometries.size(), 1u);
  EXPECT_EQ(paging.root.geometries[0].group, 1u);

  const auto fine = triangles_of(paging.page(pages.levels[1]));
  ASSERT_EQ(fine.size(), 1u);
  EXPECT_LT(glm::length(fine[0].corners[1] - ft * Vec3(20, 0, 2)), 1e-5);
  EXPECT_EQ(fine[0].colours[0], (Colour{255, 0, 0, 255}));
}

TEST(ImportDisplayPages, AreNotLookedForOutsideOfTheScene) {
  const TemporaryFolder folder;
  folder.write("elsewhere/fine.osg", triangle_at("5"));
  for (const char* name : {"there", "not_there"}) {
    const std::string page = (folder.path() / (name == std::string("there") ? "elsewhere" : "nowhere")).string();
    const auto file = folder.write(std::string(name) + "/root.osg", paged(triangle_at("1"), {page + "/fine.osg"}));
    const Shown shown = show({file});
    EXPECT_TRUE(shown.pages().empty()) << name;
    EXPECT_EQ(shown.report.import.outside_references, 1u) << name;
  }
}

TEST(ImportDisplayPages, LeaveOutWhatIsIgnored) {
  const TemporaryFolder folder;
  folder.write("fine.osg", group("all", "", triangle_at("5")));
  folder.write("part.osg", "Group {\nnum_children 2\n" + group("tree", "", triangle_at("6")) +
                               group("wall", "", triangle_at("7")) + "}\n");
  const auto file =
      folder.write("root.osg", "Group {\nnum_children 2\n" + group("tree", "", paged(triangle_at("1"), {"fine.osg"})) +
                                   group("house", "", paged(triangle_at("2"), {"part.osg"})) + "}\n");
  Paging paging(file, {.ignore = {"tree"}});
  ASSERT_EQ(paging.root.pages.size(), 1u);
  EXPECT_EQ(paging.root.triangles, 1u);
  const auto fine = triangles_of(paging.page(paging.root.pages[0].levels.at(1)));
  ASSERT_EQ(fine.size(), 1u);
  EXPECT_EQ(fine[0].corners[0], Vec3(7, 0, 0));
  EXPECT_TRUE(paging.report.notes.empty());

  // A name above the page counts for what is in it.
  Paging house(file, {.ignore = {"house"}});
  ASSERT_EQ(house.root.pages.size(), 1u);
  EXPECT_EQ(triangles_of(house.page(house.root.pages[0].levels.at(1))).at(0).corners[0], Vec3(5, 0, 0));
  Paging all(file, {.ignore = {"all"}});
  ASSERT_EQ(all.root.pages.size(), 2u);
  EXPECT_EQ(all.page(all.root.pages[0].levels.at(1)).triangles, 0u);
}

TEST(ImportDisplayPages, ThatAreMissingOrGoInCirclesAreSaid) {
  const TemporaryFolder folder;
  folder.write("good.osg", triangle_at("5"));
  folder.write("bad.osg", "garbage");
  const auto file = folder.write("root.osg", paged(triangle_at("1"), {"gone.osg", "bad.osg", "./x/../root.osg",
                                                                      "http://127.0.0.1:9/x.osg", "good.osg"}));
  Paging paging(file);
  const auto& levels = paging.root.pages.at(0).levels;
  ASSERT_EQ(levels.size(), 6u);
  EXPECT_TRUE(contains(paging.error(levels[1]), "gone.osg: this page is absent or unreadable"));
  EXPECT_TRUE(contains(paging.error(levels[2]), "bad.osg: this page is absent or unreadable"));
  EXPECT_TRUE(contains(paging.error(levels[3]), "reached through itself"));
  EXPECT_TRUE(contains(paging.error(levels[4]), "absent or unreadable"));
  EXPECT_EQ(paging.error(levels[5]), "");
  EXPECT_THROW(static_cast<void>(paging.reader.read(0, Vec3(0.0), "no token")), Error);
  EXPECT_EQ(paging.error(levels[5]), "");
}

TEST(ImportDisplayPages, CostAReaderThatCrashesOrHangsOrSendsNonsense) {
  const TemporaryFolder folder;
  folder.write("good.osg", triangle_at("5"));
  for (const char* name : {"crash.osg", "nonsense.osg", "hang.osg"}) folder.write(name, triangle_at("6"));
  const auto file =
      folder.write("root.osg", paged(triangle_at("1"), {"crash.osg", "nonsense.osg", "hang.osg", "good.osg"}));
  // A reader that does its worst for the first request that it is sent, by the page's name.
  const std::string program = reader::find_reader({}).string();
  ImportOptions options;
  options.silence_limit = 1.0;
  options.reader = folder.write_script(
      "reader.sh",
      "case \"$*\" in *--pages*) ;; *) exec '" + program + "' \"$@\" ;; esac\n" + "echo start >>'" +
          (folder.path() / "starts").string() + "'\n" + "mode=$(cat '" + (folder.path() / "mode").string() + "')\n" +
          "case $mode in crash) head -c 4 >/dev/null; kill -SEGV $$ ;; nonsense) head -c 4 >/dev/null; head -c "
          "100000 /dev/zero >&3 ;; hang) exec sleep 100 ;; esac\nexec '" +
          program + "' \"$@\"\n");
  folder.write("mode", "good");
  Paging paging(file, options);
  const auto& levels = paging.root.pages.at(0).levels;
  const auto starts = [&] { return fs::file_size(folder.path() / "starts") / 6; };
  EXPECT_EQ(starts(), 1u);
  EXPECT_EQ(paging.error(levels[4]), "");
  EXPECT_EQ(starts(), 1u);
  for (const auto& [mode, words] :
       {std::pair("crash", "crash with signal 11"), std::pair("nonsense", "bytes that are no frame"),
        std::pair("hang", "said nothing for 1 s")}) {
    folder.write("mode", mode);
    PageReader reader({file}, options);
    const auto error = [&] {
      try {
        return std::to_string(reader.read(0, Vec3(0.0), levels[4].page).triangles);
      } catch (const Error& broken) {
        return std::string(broken.what());
      }
    };
    EXPECT_TRUE(contains(error(), words)) << error();
    folder.write("mode", "good");
    EXPECT_EQ(error(), "1") << mode;
  }
}

TEST(ImportDisplayPages, AreReadByOneReaderWhicheverThreadsAskAndEnd) {
  const TemporaryFolder folder;
  folder.write("good.osg", triangle_at("5"));
  const auto file = folder.write("root.osg", paged(triangle_at("1"), {"good.osg"}));
  const std::string program = reader::find_reader({}).string();
  ImportOptions options;
  options.reader = folder.write_script("reader.sh", "case \"$*\" in *--pages*) echo start >>'" +
                                                        (folder.path() / "starts").string() + "' ;; esac\nexec '" +
                                                        program + "' \"$@\"\n");
  const std::string page = Paging(file).root.pages.at(0).levels.at(1).page;
  PageReader reader({file}, options);
  for (int i = 0; i < 3; ++i) {
    std::thread([&] { EXPECT_EQ(reader.read(0, Vec3(0.0), page).triangles, 1u); }).join();
    // A signal that comes with the thread's end has come by then.
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  EXPECT_EQ(fs::file_size(folder.path() / "starts"), 6u) << "it was started more than once";
}

TEST(ImportDisplayPages, AreGivenUpAtOnceAndLeaveNoProcess) {
  const TemporaryFolder folder;
  folder.write("good.osg", triangle_at("5"));
  const auto file = folder.write("root.osg", paged(triangle_at("1"), {"good.osg"}));
  {
    Paging paging(file);
    ImportOptions options;
    options.reader = folder.write_script("reader.sh", "exec sleep 100\n");
    PageReader reader({file}, options);
    std::atomic<bool> cancelled = false;
    std::thread asking([&] {
      EXPECT_THROW(static_cast<void>(reader.read(0, Vec3(0.0), paging.root.pages.at(0).levels.at(1).page)), Cancelled);
      EXPECT_TRUE(cancelled);
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    cancelled = true;
    const auto begin = std::chrono::steady_clock::now();
    reader.cancel();
    asking.join();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
    EXPECT_THROW(static_cast<void>(reader.read(0, Vec3(0.0), "x")), Cancelled);
  }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(ImportDisplayPages, OfThePitAreWhatIsWalkedOn) {
  ROAM_NEEDS_TEST_DATA();
  const fs::path folder = test_data() / "pit_osgb";
  const Finest shown = show_finest({folder});
  const ImportedScene scene = import_scene(folder);
  EXPECT_EQ(not_shown(scene, shown, 4e-5), 0u);
  EXPECT_EQ(shown.missing, scene.report.missing_pages);
}

}  // namespace
}  // namespace roam::test
