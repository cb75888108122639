// Scenes whose authors want more than to be read: code of theirs, a network, files of others, all the time and memory.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "hostile_scene.h"
#include "import_files.h"
#include "messages.h"
#include "program.h"
#include "sanitizer.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using roam::test::test_data;

json info_of(const std::string& scene, const std::string& options = "") {
  const ProgramResult result =
      run_program("/bin/sh", {"-c", "exec '" ROAM_PROGRAM "' info --json " + options + " " + quoted(scene)});
  json report = json::parse(result.out, nullptr, false);
  return report.is_object() ? report : json{{"error", result.err}};
}

TEST(ImportHostile, ReachesNoNetwork) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(listen(listener, 8), 0);
  getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  const std::string host = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  const TestFolder folder;
  fs::create_directories(folder.file("scene"));
  const std::string scene = folder.write(
      "scene/net.osg", hostile_group({hostile_triangle("0"), proxy_of(host + "/a.osgt.curl"),
                                      proxy_of("http://" + host + "/a.osg"), page_of(host + "/b.osgt.curl")}));
  json report = info_of(scene);
  EXPECT_EQ(report["triangles"], 2) << report;
  EXPECT_LT(accept(listener, nullptr, nullptr), 0);
  close(listener);
}

/// What strace saw readers name in system calls once the walls stood.
struct Named {
  std::set<std::string> opened, others;
};

Named named_behind_walls(const std::string& trace) {
  Named files;
  std::set<std::string> walled;
  const std::regex opened("^open(?:at)?\\((?:AT_FDCWD, )?\"([^\"]*)\".*= \\d+$");
  const std::regex named("^\\w+\\((?:AT_FDCWD, )?\"([^\"]+)\"");
  for (const auto& [process, text] : traced_calls(trace)) {
    if (contains(text, "landlock_restrict_self(") || contains(text, "syscall_0x1be(")) walled.insert(process);
    std::smatch found;
    if (!walled.contains(process)) continue;
    if (std::regex_search(text, found, opened)) {
      files.opened.insert(found[1]);
    } else if (std::regex_search(text, found, named)) {
      files.others.insert(found[1]);
    }
  }
  return files;
}

Named named_by_info(const TestFolder& folder, const std::string& scene) {
  const ProgramResult result = run_program(
      "/bin/sh", {"-c", "exec strace -f -s 4096 -o " + quoted(folder.file("trace")) +
                            " -e trace=%file,landlock_restrict_self '" ROAM_PROGRAM "' info --json " + quoted(scene)});
  return named_behind_walls(folder.read("trace"));
}

TEST(ImportHostile, LooksAtNothingThatALinkOfTheSceneLeadsTo) {
  if (!can_trace()) GTEST_SKIP() << "strace is not there, or may not trace here";
  const TestFolder folder;
  fs::create_directories(folder.file("outside/Tile_1"));
  folder.write("outside/Tile_1/Tile_1.osgb", "x");
  fs::create_directories(folder.file("city/Data/Tile_0"));
  folder.write("city/Data/Tile_0/Tile_0.osgb", "x");
  fs::create_directory_symlink(folder.file("outside/Tile_1"), folder.file("city/Data/Tile_1"));
  fs::create_symlink(folder.file("outside/Tile_1/Tile_1.osgb"), folder.file("city/metadata.xml"));
  const Named files = named_by_info(folder, folder.file("city"));
  const std::string city = fs::canonical(folder.file("city")).string();
  EXPECT_TRUE(files.opened.contains(city + "/Data/Tile_0/Tile_0.osgb"));
  for (const std::set<std::string>& some : {files.opened, files.others}) {
    for (const std::string& name : some) {
      EXPECT_TRUE(name.starts_with(city)) << name;
      EXPECT_FALSE(name.starts_with(city + "/Data/Tile_1/")) << name;
    }
  }
}

TEST(ImportHostile, OpensTheFilesOfTheSceneAndNoOthers) {
  if (!can_trace()) GTEST_SKIP() << "strace is not there, or may not trace here";
  const TestFolder folder;
  fs::create_directories(folder.file("scene/inner"));
  fs::create_directories(folder.file("secret"));
  write_bait(folder.file("scene"), HOSTILE_PLUGIN);
  folder.write("secret/outside.osg", hostile_triangle("1"));
  folder.write("scene/inner/inside.osg", hostile_triangle("2"));
  fs::create_symlink(folder.file("secret/outside.osg"), folder.file("scene/link.osg"));
  fs::create_directory_symlink(folder.file("secret"), folder.file("scene/door"));
  fs::create_symlink(folder.file("scene/inner/inside.osg"), folder.file("scene/good_link.osg"));
  std::vector<std::string> children{hostile_triangle("0")};
  for (const std::string& name : hostile_names()) children.push_back(proxy_of(name));
  for (const std::string& name :
       {std::string("../secret/outside.osg"), folder.file("secret/outside.osg"), std::string("link.osg"),
        std::string("door/outside.osg"), std::string("/etc/passwd"), std::string("../../../../../../etc/hostname"),
        std::string("good_link.osg"), std::string("/proc/self/environ"), std::string("/dev/zero")}) {
    children.push_back(proxy_of(name));
  }
  const std::string scene = folder.write("scene/all.osg", hostile_group(children));
  const ProgramResult result =
      run_program("/bin/sh", {"-c", "exec strace -f -s 4096 -o " + quoted(folder.file("trace")) +
                                        " -e trace=open,openat,landlock_restrict_self '" ROAM_PROGRAM "' info --json " +
                                        quoted(scene)});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string real = fs::canonical(folder.file("scene")).string();
  EXPECT_EQ(named_behind_walls(folder.read("trace")).opened,
            (std::set<std::string>{real + "/all.osg", real + "/inner/inside.osg"}));
  json report = json::parse(result.out);
  EXPECT_EQ(report["triangles"], 2);
  EXPECT_EQ(report["import"]["outside_references"], 7) << report["import"]["outside_files"];
}

// --- references that lead out

TEST(ImportHostile, LeavesOutWhatLiesOutsideAndLetsItInWhenToldSo) {
  const TestFolder folder;
  fs::create_directories(folder.file("scene"));
  fs::create_directories(folder.file("shared"));
  folder.write("shared/part.osg", hostile_triangle("1"));
  fs::create_symlink(folder.file("shared/part.osg"), folder.file("scene/link.osg"));
  for (const std::string& name : {std::string("../shared/part.osg"), folder.file("shared/part.osg"),
                                  std::string("link.osg"), std::string("..\\\\shared\\\\part.osg")}) {
    const std::string scene = folder.write("scene/house.osg", hostile_group({hostile_triangle("0"), proxy_of(name)}));
    json alone = info_of(scene);
    EXPECT_EQ(alone["triangles"], 1) << name << alone;
    EXPECT_EQ(alone["import"]["outside_references"], 1) << name;
    EXPECT_TRUE(contains(alone["import"]["outside_files"].dump(), name == "link.osg" ? "link.osg" : "shared/part.osg"));
    EXPECT_TRUE(contains(alone["import"]["notes"].dump(), "--allow")) << alone["import"]["notes"];
    json allowed = info_of(scene, "--allow " + quoted(folder.file("shared")));
    EXPECT_EQ(allowed["triangles"], 2) << name << allowed;
    EXPECT_EQ(allowed["import"]["outside_references"], 0);
  }
  const std::string gltf = folder.write(
      "scene/out.gltf",
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{)"
      R"("attributes":{"POSITION":0}}]}],"buffers":[{"uri":"../shared/out.bin","byteLength":36}],"bufferViews":[{)"
      R"("buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
      R"("min":[0,0,0],"max":[1,1,0]}]})");
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  folder.write("shared/out.bin", std::string(reinterpret_cast<const char*>(corners), sizeof(corners)));
  json refused = info_of(gltf);
  EXPECT_TRUE(contains(refused.dump(), "outside of its folder")) << refused;
  EXPECT_TRUE(contains(refused.dump(), "--allow")) << refused;
  EXPECT_EQ(info_of(gltf, "--allow " + quoted(folder.file("shared")))["triangles"], 1);
  EXPECT_TRUE(contains(info_of(gltf, "--allow " + quoted(folder.file("nowhere"))).dump(), "no such folder"));
}

TEST(ImportHostile, OpensASceneThatTheUserNamesByALink) {
  const TestFolder folder;
  fs::create_directories(folder.file("real"));
  folder.write("real/house.osg", hostile_triangle("0"));
  fs::create_symlink(folder.file("real/house.osg"), folder.file("link.osg"));
  fs::create_directory_symlink(folder.file("real"), folder.file("folder"));
  EXPECT_EQ(info_of(folder.file("link.osg"))["triangles"], 1);
  EXPECT_EQ(info_of(folder.file("folder/house.osg"))["triangles"], 1);
}

TEST(ImportHostile, NamesTheSceneAsTheUserDoes) {
  const TestFolder folder;
  fs::create_directories(folder.file("real"));
  folder.write("real/broken.obj", "v 0 0 zero\n");
  const ProgramResult result = run_program(
      "/bin/sh", {"-c", "cd " + quoted(folder.file("")) + " && exec '" ROAM_PROGRAM "' info real/broken.obj"});
  EXPECT_TRUE(result.err.starts_with("roam: real/broken.obj:1: ")) << result.err;
}

// --- time and memory

/// Seconds of processor that the budget gives a small file, and what is used before it is looked at.
constexpr double small_budget = 10.0, beside = 5.0;

/// Processor seconds of the programs that run until they end, and of their readers.
double seconds_of(const std::function<void()>& run) {
  const auto used = [] {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  };
  const double before = used();
  run();
  return used() - before;
}

TEST(ImportHostile, ReadsAFileThatNamesItselfOnce) {
  const TestFolder folder;

  const std::string scene = folder.write("self.osg", "Group {\nnum_children 3\n" + hostile_triangle("0") +
                                                         proxy_of("self.osg") + proxy_of("self.osg") + "}\n");
  const std::string pages = folder.write("pages.osg", hostile_group({page_of("pages.osg"), page_of("pages.osg")}));
  json report;
  EXPECT_LT(seconds_of([&] { report = info_of(scene); }), beside);
  EXPECT_EQ(report["triangles"], 1) << report;
  EXPECT_LT(seconds_of([&] { report = info_of(pages); }), beside);
  EXPECT_EQ(report["triangles"], 2) << report;
  EXPECT_EQ(report["import"]["missing_pages"], 2);
}

TEST(ImportHostile, EndsChainsThatDouble) {
  const TestFolder folder;
  constexpr int links = 40;
  for (int i = 0; i < links; ++i) {
    const std::string next = std::to_string(i + 1) + ".osg";
    folder.write("proxy" + std::to_string(i) + ".osg",
                 hostile_group({proxy_of("proxy" + next), proxy_of("proxy" + next)}));
    folder.write("page" + std::to_string(i) + ".osg", hostile_group({page_of("page" + next), page_of("page" + next)}));
  }
  folder.write("proxy40.osg", hostile_triangle("0"));
  folder.write("page40.osg", hostile_triangle("0"));
  for (const char* first : {"proxy0.osg", "page0.osg"}) {
    json report;
    EXPECT_LT(seconds_of([&] { report = info_of(folder.file(first)); }), small_budget + beside) << first;
    EXPECT_TRUE(contains(report.dump(), "refers to itself over and over") || contains(report.dump(), "of memory"))
        << report;
  }
}

TEST(ImportHostile, GrantsNoTimeForBytesThatAreNotRead) {
  const TestFolder folder;
  // The file says that it is a terabyte long, and has nothing on the disk.
  const std::string scene = folder.write("large.osg", hostile_group({proxy_of("chain.osg")}));
  fs::resize_file(scene, std::uintmax_t{1} << 40);
  constexpr int links = 40;
  for (int i = 0; i < links; ++i) {
    const std::string next = i + 1 < links ? "chain" + std::to_string(i + 1) + ".osg" : "end.osg";
    folder.write(i == 0 ? "chain.osg" : "chain" + std::to_string(i) + ".osg",
                 hostile_group({proxy_of(next), proxy_of(next)}));
  }
  json report;
  EXPECT_LT(seconds_of([&] { report = info_of(scene); }), small_budget + beside);
  EXPECT_TRUE(report.contains("error")) << report;
}

/// Groups in groups, each of ten: 10^levels triangles out of a kilobyte.
std::string repeated(int levels) {
  std::string text = hostile_triangle("0");
  text.insert(text.find('{') + 2, "UniqueID N0\n");
  for (int level = 1; level <= levels; ++level) {
    std::string group = "Group {\nUniqueID N" + std::to_string(level) + "\nnum_children 10\n" + text;
    for (int i = 1; i < 10; ++i) group += "Use N" + std::to_string(level - 1) + "\n";
    text = group + "}\n";
  }
  return text;
}

TEST(ImportHostile, EndsASceneThatRepeatsItselfWithoutEnd) {
  ROAM_NEEDS_PLAIN_MEMORY();
  const TestFolder folder;
  const std::string scene = folder.write("laugh.osg", repeated(9));
  const ProgramResult result =
      run_program(ROAM_PROGRAM, {"build", scene, "-o", folder.file("store"), "--memory", "256M"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "repeats itself over and over")) << result.err;
  EXPECT_EQ(info_of(folder.write("few.osg", repeated(3)))["triangles"], 1000);
}

TEST(ImportHostile, BuildsAStoreOfTilesWithoutLookingOutside) {
  ROAM_NEEDS_TEST_DATA();
  const TestFolder folder;
  fs::create_directories(folder.file("tiles/Data/Tile_A"));
  fs::create_directories(folder.file("secret/deep"));
  folder.write("secret/key", "precious");
  folder.write("secret/deep/key", "precious");
  folder.write("secret/Tile_B.osgb", "");
  fs::copy_file(test_data() / "contextcapture_tiles/fanvanzh_test.osgb", folder.file("tiles/Data/Tile_A/Tile_A.osgb"));
  fs::create_symlink(folder.file("secret/key"), folder.file("tiles/Data/Tile_A/key"));
  fs::create_symlink("/proc/self/pagemap", folder.file("tiles/Data/Tile_A/endless"));
  fs::create_directory_symlink(folder.file("secret"), folder.file("tiles/Data/Tile_B"));
  ASSERT_EQ(mkfifo(folder.file("tiles/metadata.xml").c_str(), 0600), 0);
  const ProgramResult result =
      run_program("/usr/bin/timeout", {"60", ROAM_PROGRAM, "build", folder.file("tiles"), "-o", folder.file("store")});
  ASSERT_EQ(result.status, 0) << result.err;
  std::string seen;
  for (const auto& entry : fs::recursive_directory_iterator(folder.file("store"))) {
    if (entry.is_regular_file())
      seen += folder.read("store/" + fs::relative(entry.path(), folder.file("store")).string());
  }
  for (const char* name : {"secret", "/key", "deep", "endless"}) EXPECT_FALSE(contains(seen, name)) << name;
}

TEST(ImportHostile, ParsesTextOfAnyDepthWithinTheMemory) {
  const TestFolder folder;
  const std::string deep(60u << 20, '[');
  for (const char* name : {"deep.gltf", "deep.json.gltf"}) {
    const std::string scene = folder.write(name, name[4] == '.' && name[5] == 'g' ? deep : "{\"buffers\":" + deep);
    const ProgramResult result =
        run_program(ROAM_PROGRAM, {"build", scene, "-o", folder.file("store"), "--memory", "256M"});
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_LT(result.peak, (256 + 24) * 1024) << result.err;
  }
}

}  // namespace
