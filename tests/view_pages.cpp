// roam view of scenes whose pages are hostile: the process that draws opens no file of a scene and starts nothing but
// readers. Seen from outside, by strace.

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

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
  std::vector<std::pair<std::string, std::string>> calls;
  std::set<std::string> readers;
  std::map<std::string, std::string> parent, unfinished;
  const std::regex born("(?:clone|clone3|fork|vfork)[^=]*=.*?(\\d+)$");
  std::istringstream lines(trace);
  for (std::string line; std::getline(lines, line);) {
    const std::string process = line.substr(0, line.find(' '));
    std::string text = line.substr(line.find_first_not_of(' ', process.size()));
    // A call that another process's interrupted is in two lines.
    if (const auto end = text.find(" <unfinished ...>"); end != std::string::npos) {
      unfinished[process] = text.substr(0, end);
      continue;
    }
    if (text.starts_with("<... ")) text = unfinished[process] + text;
    if (text.starts_with("execve(") && contains(text, "roam-reader\"")) readers.insert(process);
    std::smatch child;
    if (std::regex_search(text, child, born)) parent[child[1]] = process;
    calls.emplace_back(process, text);
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
    } else if (call.text.starts_with("open")) {
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
}

}  // namespace
