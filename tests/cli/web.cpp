// Verbs over a slow network: slower, with the results of the disk to the last bit.
#include <nlohmann/json.hpp>
#include <sstream>

#include "environment_variable.h"
#include "store_verbs.h"
#include "web_servers.h"

namespace {

using nlohmann::json;
using store_verbs::run;

class WebVerbs : public store_verbs::StoreVerbs {};

/// The trace without its clearances. When a far tile arrives, the body measures again, and may certify a slightly lower
/// clearance.
std::string without_clearances(const std::string& trace) {
  std::string kept;
  std::istringstream lines(trace);
  for (std::string line; std::getline(lines, line);) {
    int column = 0;
    for (const char c : line) {
      column += c == ',' ? 1 : 0;
      if (column != 7) kept += c;
    }
    kept += '\n';
  }
  return kept;
}

TEST_F(WebVerbs, WalkAsOnTheDiskWhateverTheLatencyAndTheRate) {
  const TestFolder folder;
  const support::Misbehaving server(store_verbs::fs::path(store()).parent_path());
  const std::string name = store_verbs::fs::path(store()).filename().string();
  const auto walk = [&](const std::string& of, const std::string& trace) {
    const ProgramResult result = run({"walk", of, "--path", path(), "--mode", "fly", "--speed", "20", "--verify",
                                      "--json", "--trace", folder.file(trace)});
    EXPECT_EQ(result.status, 0) << result.err << result.out;
    json told, report = json::parse(result.out, nullptr, false);
    for (const char* what : {"outcome", "length_m", "simulated_s", "end", "events", "narrowest", "headroom"}) {
      told[what] = report[what];
    }
    return told;
  };
  const json disk = walk(store(), "disk.csv");
  EXPECT_EQ(disk["outcome"], "reached");
  const std::string places = without_clearances(folder.read("disk.csv"));
  EXPECT_TRUE(places.starts_with("step,t,x,y,z,radius,height,contacts,event")) << places.substr(0, 80);
  for (const char* mode : {"late20", "late300", "rate1250"}) {
    EXPECT_EQ(walk(server.address(mode, name), mode), disk) << mode;
    EXPECT_TRUE(without_clearances(folder.read(mode)) == places) << mode;
  }
}

TEST_F(WebVerbs, ProbeAndSweepAsOnTheDisk) {
  const TestFolder folder;
  const support::Misbehaving server(store_verbs::fs::path(store()).parent_path());
  const std::string address = server.address("late100", store_verbs::fs::path(store()).filename().string());
  const auto swept = [&](const std::string& of) {
    return run({"sweep", of}, "x,y,z,dx,dy,dz,radius\n-13739,253,182,100,106,0,0.3\n").out;
  };
  EXPECT_EQ(swept(address), swept(store()));
  static_cast<void>(server.most_at_once());
  const auto probed = [&](const std::string& of) {
    json report = json::parse(run({"probe", of, "--from=-13739,253,182", "--to=-13719,274,182", "--json"}).out);
    for (const char* what : {"scene", "seconds"}) report.erase(what);
    return report;
  };
  EXPECT_EQ(probed(address), probed(store()));
  EXPECT_GE(server.most_at_once(), 2);
}

TEST_F(WebVerbs, InfoNamesWhatKeepsAStoreFromBeingRead) {
  const support::Misbehaving server(store_verbs::fs::path(store()).parent_path());
  const std::string name = store_verbs::fs::path(store()).filename().string();
  const auto said = [&](const char* mode) { return run({"info", server.address(mode, name)}).out; };
  EXPECT_TRUE(contains(said("endless"), "not read    http://")) << said("endless");
  EXPECT_TRUE(contains(said("endless"), "ignores ranges")) << said("endless");
  EXPECT_FALSE(contains(said("good"), "not read")) << said("good");
  EXPECT_TRUE(contains(json::parse(run({"info", server.address("endless", name), "--json"}).out)["not_read"],
                       "ignores ranges"));
}

TEST_F(WebVerbs, GoOnWithoutACacheThatCannotBeWritten) {
  const TestFolder folder;
  const support::Misbehaving server(store_verbs::fs::path(store()).parent_path());
  const EnvironmentVariable cache("XDG_CACHE_HOME", folder.write("file", "in the place of a folder").c_str());
  const std::string address = server.address("good", store_verbs::fs::path(store()).filename().string());
  const ProgramResult walked = run({"walk", address, "--path", path(), "--mode", "fly", "--cache", "64M"});
  EXPECT_EQ(walked.status, 0) << walked.err;
  EXPECT_TRUE(contains(walked.err, "note: nothing is kept for the next time: ")) << walked.err;
  EXPECT_EQ(run({"info", address, "--cache", "1M"}).status, 1) << "too small for any folder";
}

TEST_F(WebVerbs, ShowThePictureOfTheDisk) {
  const TestFolder folder;
  const std::string store = copy(folder);  // away from its scene, which would be shown
  const support::Misbehaving server(store_verbs::fs::path(store).parent_path());
  const auto picture = [&](const std::string& of, const std::string& name) {
    const ProgramResult shown = run({"view", of, "--headless", "--size", "320x200", "--screenshot", folder.file(name)});
    EXPECT_EQ(shown.status, 0) << shown.err;
    return folder.read(name);
  };
  const std::string disk = picture(store, "disk.png");
  EXPECT_GT(disk.size(), 1000U);
  EXPECT_TRUE(picture(server.address("late50", store_verbs::fs::path(store).filename().string()), "web.png") == disk);
}

TEST_F(WebVerbs, CallAFailureOfTheServerNoDamage) {
  const support::Misbehaving server(store_verbs::fs::path(store()).parent_path());
  const std::string name = store_verbs::fs::path(store()).filename().string();
  const auto said = [&](const char* mode) {
    return run({"probe", server.address(mode, name), "--from=-13739,253,182", "--to=-13719,274,182"}).err;
  };
  EXPECT_TRUE(contains(said("403"), "try again when the web server answers")) << said("403");
  EXPECT_TRUE(contains(said("bits"), "publish again")) << said("bits");
}

}  // namespace
