// Files that are no profile: the message says what is wrong, where, and what to do.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "messages.h"
#include "profile_made.h"
#include "program.h"

namespace {

using Json = nlohmann::ordered_json;
using made::complaint;
using made::full_profile;

/// A change of a good file, and what must be said of it.
struct Fault {
  const char* member;
  std::function<void(Json&)> make;
};

TEST(Profile, NamesTheMemberThatIsWrong) {
  const TestFolder folder;
  const std::string file = folder.file("dam.ply.roam.json");
  roam::save_profile(full_profile(), file);
  const Json good = Json::parse(folder.read("dam.ply.roam.json"));
  const std::vector<Fault> faults{
      {"\"roam_profile\"", [](Json& j) { j["roam_profile"] = 0; }},
      {"\"roam_profile\"", [](Json& j) { j["roam_profile"] = "1"; }},
      {"\"scene\"", [](Json& j) { j["scene"] = Json::array(); }},
      {"\"scene\"", [](Json& j) { j["scene"]["hash"] = nullptr; }},
      {"\"scene.hash\"", [](Json& j) { j["scene"]["hash"] = "0123"; }},
      {"\"scene.hash\"", [](Json& j) { j["scene"]["hash"] = std::string(32, 'G'); }},
      {"\"scene.hash\"", [](Json& j) { j["scene"].erase("hash"); }},
      {"\"scene.geometry_hash\"", [](Json& j) { j["scene"]["geometry_hash"] = "xyz"; }},
      {"\"scene.triangles\"", [](Json& j) { j["scene"]["triangles"] = -2; }},
      {"\"scene.triangles\"", [](Json& j) { j["scene"]["triangles"] = 2.5; }},
      {"\"scene.bounds.min\"",
       [](Json& j) {
         j["scene"]["bounds"]["min"] = {1, 2};
       }},
      {"\"scene.bounds.max\"", [](Json& j) { j["scene"]["bounds"]["max"][1] = "0"; }},
      {"\"scene.bounds\"", [](Json& j) { j["scene"]["bounds"]["max"][1] = -1e9; }},
      {"\"mode\"", [](Json& j) { j["mode"] = "ghost"; }},
      {"radius", [](Json& j) { j["radius"] = 0.0; }},
      {"radius", [](Json& j) { j["radius"] = -0.3; }},
      {"at least 0.001", [](Json& j) { j["radius"] = 5e-324; }},
      {"radius", [](Json& j) { j["radius"] = 1e6; }},
      {"\"radius\"", [](Json& j) { j["radius"] = "0.3"; }},
      {"\"radius\"", [](Json& j) { j["radius"] = nullptr; }},
      {"height", [](Json& j) { j["height"] = 0.5; }},
      {"step", [](Json& j) { j["step"] = 1.0; }},
      {"slope", [](Json& j) { j["slope"] = 90; }},
      {"\"support_radius\"", [](Json& j) { j["support_radius"] = -0.1; }},
      {"\"interval.min\"", [](Json& j) { j["interval"]["min"] = -1; }},
      {"\"interval.max\"", [](Json& j) { j["interval"]["max"] = 0; }},
      {"\"interval\"", [](Json& j) { j["interval"] = 0.3; }},
      {"\"regions\"", [](Json& j) { j["regions"] = Json::object(); }},
      {"\"regions[1]\"", [](Json& j) { j["regions"][1] = 7; }},
      {"\"regions[1].bounds\"", [](Json& j) { j["regions"][1]["bounds"]["min"][2] = 3; }},
      {"\"regions[0].radius\"", [](Json& j) { j["regions"][0]["radius"] = 0; }},
      {"at least 0.001", [](Json& j) { j["regions"][0]["radius"] = 0.0009; }},
      {"\"regions[0].radius\"", [](Json& j) { j["regions"][0]["radius"] = 1; }},
      {"\"regions[1].support_radius\"", [](Json& j) { j["regions"][1]["support_radius"] = 1e9; }},
      {"\"regions[0].why\"", [](Json& j) { j["regions"][0]["why"] = 5; }},
      {"\"method\"", [](Json& j) { j["method"] = "guessed\x1b[2J"; }},
      {"\"complete\"", [](Json& j) { j["complete"] = 1; }},
  };
  for (const auto& [name, value] : good.items()) {
    const std::string key = name;
    Json bad = good;
    bad.erase(key);
    folder.write("dam.ply.roam.json", bad.dump());
    const std::string said = complaint([&] { (void)roam::load_profile(file); });
    EXPECT_TRUE(contains(said, "\"" + key + "\" is missing")) << key << ": " << said;
  }
  for (const Fault& fault : faults) {
    Json bad = good;
    fault.make(bad);
    folder.write("dam.ply.roam.json", bad.dump());
    const std::string said = complaint([&] { (void)roam::load_profile(file); });
    EXPECT_TRUE(contains(said, file)) << bad.dump();
    EXPECT_TRUE(contains(said, fault.member)) << said << "\n" << bad.dump();
    EXPECT_TRUE(contains(said, "train again")) << said;
    EXPECT_FALSE(contains(said, "\x1b")) << "text of the file is made printable";
  }
}

TEST(Profile, NamesTheLineOfWhatIsNoJson) {
  const TestFolder folder;
  const std::string file = folder.write("p.json", "{\n  \"roam_profile\": 1,\n  oops\n}\n");
  const std::string said = complaint([&] { (void)roam::load_profile(file); });
  EXPECT_TRUE(contains(said, file + ": is no JSON") && contains(said, "line 3")) << said;
  for (const char* text : {"", "[]", "null", "{",
                           "\x7f"
                           "ELF",
                           "{\"roam_profile\": 1e999}"}) {
    EXPECT_NE(complaint([&] { (void)roam::load_profile(folder.write("q.json", text)); }), "") << text;
  }
  // Nested deeper than a stack.
  EXPECT_NE(complaint([&] { (void)roam::load_profile(folder.write("d.json", std::string(1000000, '['))); }), "");
  const std::string nested = "{\"roam_profile\":" + std::string(500000, '[') + std::string(500000, ']') + "}";
  EXPECT_NE(complaint([&] { (void)roam::load_profile(folder.write("e.json", nested)); }), "");
}

TEST(Profile, OfANewerVersionIsRefusedAndSaysSo) {
  const TestFolder folder;
  const std::string file = folder.write("p.json", "{\"roam_profile\": 2, \"all\": \"else is new\"}");
  const std::string said = complaint([&] { (void)roam::load_profile(file); });
  EXPECT_TRUE(contains(said, "version 2") && contains(said, "newer roam")) << said;
}

TEST(Profile, NamesAFrameThatIsNone) {
  const TestFolder folder;
  const auto said = [&](const std::string& frame) {
    const std::string file = folder.write("p.json", "{\"roam_profile\": 1, \"frame\": " + frame + "}");
    return complaint([&] { (void)roam::load_profile(file); });
  };
  EXPECT_TRUE(contains(said("3"), "\"frame\" must be an object")) << said("3");
  EXPECT_TRUE(contains(said("{\"up\": \"y\"}"), "\"frame.unit\" is missing"));
  EXPECT_TRUE(contains(said("{\"up\": \"w\", \"unit\": \"m\"}"), "\"frame.up\" 'w' is no axis"));
  EXPECT_TRUE(contains(said("{\"up\": \"y\", \"unit\": 1}"), "\"frame.unit\" must be a text"));
}

}  // namespace
