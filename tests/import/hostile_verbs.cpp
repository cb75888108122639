// What no verb does for a scene whose author wants it: run code, ask for a network, touch a file.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <map>
#include <sstream>

#include "environment_variable.h"
#include "hostile_scene.h"
#include "messages.h"
#include "program.h"

namespace {

namespace fs = std::filesystem;

/// Runs the program in a folder, as somebody who works there.
ProgramResult roam_in(const std::string& folder, const std::string& arguments) {
  return run_program("/bin/sh", {"-c", "cd " + quoted(folder) + " && exec '" ROAM_PROGRAM "' " + arguments});
}

/// An OSGT file: a class may name the library that brings it.
std::string osgt_of_class(const std::string& name) {
  return "#Ascii Scene\n#Version 161\n#Generator OpenSceneGraph 3.6.5\n\n" + name + " {\n  UniqueID 1\n}\n";
}

/// The ways in, as files of a scene.
std::vector<std::string> write_ways_in(const TestFolder& folder) {
  std::vector<std::string> scenes;
  std::vector<std::string> proxies, pages;
  for (const std::string& name : hostile_names()) {
    proxies.push_back(proxy_of(name));
    pages.push_back(page_of(name));
  }
  proxies.push_back(hostile_triangle("0"));
  scenes.push_back(folder.write("scene/proxies.osg", hostile_group(proxies)));
  scenes.push_back(folder.write("scene/pages.osg", hostile_group(pages)));
  scenes.push_back(folder.write("scene/class.osgt", osgt_of_class("xyz::Foo")));
  scenes.push_back(folder.write("scene/class.osg", "xyz::Foo {\n}\n"));
  scenes.push_back(folder.write("scene/class_in_group.osg", hostile_group({hostile_triangle("0"), "xyz::Foo {\n}\n"})));
  return scenes;
}

/// Every entry below a folder, with what can be told of it but for when it was read last.
std::map<std::string, std::string> tree_of(const std::string& folder) {
  std::map<std::string, std::string> tree;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    struct stat status {};
    ::lstat(entry.path().c_str(), &status);
    std::ostringstream told;
    told << std::oct << status.st_mode << std::dec << ' ' << status.st_size << ' ' << status.st_ino << ' '
         << status.st_mtim.tv_sec << '.' << status.st_mtim.tv_nsec << ' ' << status.st_ctim.tv_sec << '.'
         << status.st_ctim.tv_nsec;
    tree[fs::relative(entry.path(), folder).string()] = told.str();
  }
  return tree;
}

/// What `arguments` are for a scene, whose output is called OUT: "build SCENE -o OUT".
std::string filled_in(std::string arguments, const std::string& scene, const std::string& out) {
  arguments.replace(arguments.find("SCENE"), 5, quoted(scene));
  if (const auto at = arguments.find("OUT"); at != std::string::npos) arguments.replace(at, 3, quoted(out));
  return arguments;
}

class ImportHostile : public testing::TestWithParam<const char*> {};

TEST_P(ImportHostile, RunsNoCodeOfAScene) {
  const TestFolder folder;
  fs::create_directories(folder.file("scene"));
  fs::create_directories(folder.file("elsewhere"));
  write_bait(folder.file("scene"), HOSTILE_PLUGIN);
  write_bait(folder.file("elsewhere"), HOSTILE_PLUGIN);
  const std::vector<std::string> scenes = write_ways_in(folder);
  fs::create_directories(folder.file("made"));
  fs::create_directories(folder.file("config"));
  setenv("XDG_CONFIG_HOME", folder.file("config").c_str(), 1);
  setenv("TMPDIR", folder.file("").c_str(), 1);
  for (const std::string& scene : scenes) {
    for (const char* place : {"scene", "elsewhere"}) {
      const std::string arguments = filled_in(GetParam(), scene, folder.file("made/out"));
      const auto before = tree_of(folder.file(""));
      const ProgramResult result = roam_in(folder.file(place), arguments);
      EXPECT_LT(result.status, 128) << arguments << result.err;
      EXPECT_EQ(marks_in(folder.file("")), std::vector<std::string>()) << arguments << " in " << place;
      // Nothing is written, changed or removed but what was asked for.
      for (const auto& entry : fs::directory_iterator(folder.file("made"))) fs::remove_all(entry.path());
      auto after = tree_of(folder.file(""));
      after["made"] = before.at("made");
      EXPECT_EQ(after, before) << arguments << " in " << place;
    }
  }
  unsetenv("TMPDIR");
}

TEST_P(ImportHostile, AsksForNoNetworkAndNoName) {
  if (!can_trace()) GTEST_SKIP() << "strace is not there, or may not trace here";
  const TestFolder folder;
  fs::create_directories(folder.file("scene"));
  std::vector<std::string> children{hostile_triangle("0")};
  for (const char* name :
       {"http://example.invalid/a.osg", "example.invalid/a.osgt.curl", "//example.invalid/a.osg",
        "file://example.invalid/a.osg", "ftp://example.invalid/a.osgb", "\\\\\\\\example.invalid\\\\a.osg"}) {
    children.push_back(proxy_of(name));
    children.push_back(page_of(name));
  }
  const std::string scene = folder.write("scene/net.osg", hostile_group(children));
  const auto asked_by = [&](const std::string& command) {
    const std::string strace = "exec strace -f -o " + quoted(folder.file("trace")) + " -e trace=%network,open,openat ";
    EXPECT_LT(run_program("/bin/sh", {"-c", strace + command}).status, 128) << command;
    std::vector<std::string> asked;
    std::istringstream trace(folder.read("trace"));
    for (std::string line; std::getline(trace, line);) {
      // Of these the last two are how the C library begins to look up a name.
      for (const char* sign : {"AF_INET", "AF_NETLINK", "/etc/hosts", "/etc/resolv.conf"}) {
        if (contains(line, sign)) asked.push_back(line);
      }
    }
    return asked;
  };
  EXPECT_EQ(asked_by("'" ROAM_PROGRAM "' " + filled_in(GetParam(), scene, folder.file("out"))),
            std::vector<std::string>());
  EXPECT_NE(asked_by("getent hosts example.invalid"), std::vector<std::string>()) << "nothing would be seen";
}

/// Libraries write what they think of a file to the standard error.
TEST_P(ImportHostile, KeepsTheComplaintsOfLibrariesFromTheTerminal) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.osg", hostile_group({hostile_triangle("0")}));
  const std::string reader =
      folder.write("reader",
                   "#!/bin/sh\ni=0\nwhile [ $i -lt 70 ]; do echo \"Error: complaint $i\" >&2; i=$((i + 1)); done\n"
                   "exec '" ROAM_READER_PROGRAM "' \"$@\"\n");
  fs::permissions(reader, fs::perms::owner_all);
  const EnvironmentVariable takes_it("ROAM_READER", reader);
  const ProgramResult result =
      run_program("/bin/sh", {"-c", "exec '" ROAM_PROGRAM "' " + filled_in(GetParam(), scene, folder.file("out"))});
  EXPECT_LT(result.status, 128) << result.err;
  EXPECT_FALSE(contains(result.err, "complaint")) << result.err;
}

INSTANTIATE_TEST_SUITE_P(Verbs, ImportHostile,
                         testing::Values("info SCENE", "walk SCENE --wander 1", "build SCENE -o OUT",
                                         "view SCENE --headless --size 160x120 --mode fly --at 0,0,2,0,-30 "
                                         "--screenshot OUT.png"));

}  // namespace
