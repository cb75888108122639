// Names and notes that a file's author chose, as a terminal sees them, and as data.

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "program.h"
#include "text/printable.h"

namespace {

using nlohmann::json;

/// An escape sequence, a C1 control, a right-to-left override, a bell, and a byte that is no UTF-8.
const std::string hostile =
    "a\x1B]0;owned\x07"
    "b\xC2\x9B"
    "2Jc\xE2\x80\xAE"
    "d\x7F"
    "e\xFF"
    "f";

std::string box(const std::string& name, double x, double size) {
  std::string text = "o " + name + "\n";
  for (int i = 0; i < 8; ++i) {
    text += "v " + std::to_string(x + ((i & 1) != 0 ? size : 0.0)) + ' ' + std::to_string((i & 2) != 0 ? size : -size) +
            ' ' + std::to_string((i & 4) != 0 ? size : 0.0) + '\n';
  }
  for (const char* face : {"-8 -7 -5 -6", "-4 -3 -1 -2", "-8 -7 -3 -4", "-6 -5 -1 -2", "-8 -6 -2 -4", "-7 -5 -1 -3"}) {
    text += std::string("f ") + face + '\n';
  }
  return text;
}

/// A room, and in it a block that is met on the way.
std::string scene_text(const std::string& name) {
  return "mtllib " + name + ".mtl\nusemtl " + name + "\n" + box("room " + name, -4.0, 8.0) +
         box("block " + name, 1.0, 2.0);
}

void expect_printable(const std::string& text) {
  constexpr std::size_t longest_line = 1100;
  std::size_t begin = 0;
  for (std::size_t end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    EXPECT_EQ(line, roam::printable(line, line.size())) << "not printable: " << json(roam::printable(line, 300));
    EXPECT_LE(roam::printable(line, line.size()).size(), longest_line);
  }
}

class Names : public testing::Test {
 protected:
  void SetUp() override { setenv("XDG_CONFIG_HOME", folder_.file("config").c_str(), 1); }

  ProgramResult run(const std::vector<std::string>& arguments) {
    SCOPED_TRACE(arguments[0]);
    ProgramResult result = run_program(ROAM_PROGRAM, arguments, {.input = "-3,0,1,9,0,0,0.3\n"});
    expect_printable(result.out);
    expect_printable(result.err);
    return result;
  }
  /// The same where standard output is data.
  json data(const std::vector<std::string>& arguments) {
    const ProgramResult result = run_program(ROAM_PROGRAM, arguments);
    expect_printable(result.err);
    expect_printable(result.out);
    return json::parse(result.out, nullptr, false);
  }

  TestFolder folder_;
};

TEST_F(Names, OfEveryVerb) {
  const std::string scene = folder_.write(hostile + "\n.obj", scene_text(hostile));
  const std::string path = folder_.write(hostile + ".path", "-3 0 1\n4 0 1\n");
  const std::string store = folder_.file("s\x1B[2J\n.roam");
  for (const char* what : {"*gone*", "block*"}) {
    EXPECT_EQ(run({"info", scene, "--ignore", what}).status, 0);
  }
  const ProgramResult walked = run({"walk", scene, "--path", path, "--mode", "fly", "--no-profile"});
  EXPECT_EQ(walked.status, 3) << walked.err;
  EXPECT_NE(walked.out.find("block a"), std::string::npos) << walked.out;
  EXPECT_EQ(run({"sweep", scene}).status, 0);
  EXPECT_EQ(run({"build", scene, "-o", store}).status, 0);
  EXPECT_EQ(run({"info", store}).status, 0);
  EXPECT_EQ(run({"verify", store}).status, 0);
  run({"walk", store, "--path", path, "--mode", "fly", "--no-profile"});
  EXPECT_EQ(run({"train", scene, "-o", folder_.file("p\x1B[2J\n.json"), "--paths", "1"}).status, 0);
  run({"probe", scene, "--from=-3,0,0.9", "--to=3,-3,0.9", "--radius", "0.3", "--height", "1.7"});
  const ProgramResult seen = run(
      {"view", scene, "--headless", "--no-profile", "--at", "-3,0,1", "--screenshot", folder_.file("s\x1B[2J.png")});
  EXPECT_EQ(seen.status, 0) << seen.err;
  EXPECT_NE(seen.err.find("note:"), std::string::npos) << "a library that is not there is noted: " << seen.err;
}

TEST_F(Names, OfWhatIsRefused) {
  const std::string gone = folder_.file("gone\x1B[2J\n" + hostile + ".obj");
  const std::string empty = folder_.write("empty\x1B[2J\n" + hostile + ".obj", "\n");
  for (const char* verb : {"info", "walk", "sweep", "build", "verify", "train", "view"}) {
    EXPECT_NE(run({verb, gone}).status, 0);
    EXPECT_NE(run({verb, empty}).status, 0);
  }
  EXPECT_NE(run({"check", gone, empty}).status, 0);
  EXPECT_NE(run({"check", empty, gone}).status, 0);
  EXPECT_EQ(run({"info", "--no-such\x1B[2J\noption"}).status, 2);
  EXPECT_EQ(run({"info\x1B[2J\n"}).status, 2);
  EXPECT_EQ(run({"walk", empty, "--mode", "fl\x1B[2J\ny"}).status, 2);
  const std::string path = folder_.write("bad\x1B[2J.path", "1 2 \x1B[2Jthree\n");
  const std::string scene = folder_.write("scene.obj", scene_text("plain"));
  EXPECT_EQ(run({"walk", scene, "--path", path}).status, 1);
}

TEST_F(Names, OfAnElementAreShortened) {
  const std::string name(70000, 'x');
  const std::string header = "ply\nformat ascii 1.0\ncomment \x1B[2J\nelement " + name;
  const std::string file = folder_.write("long.ply", header + " 99999999\nproperty float n\nend_header\n1\n");
  const ProgramResult result = run({"info", file});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("xxx"), std::string::npos) << result.err;
  EXPECT_LT(result.err.size(), 1100U);
}

TEST_F(Names, AreExactAsData) {
  const std::string name =
      "a\x1B]0;owned\x07"
      "b\xC2\x9B"
      "c\xE2\x80\xAE"
      "d\x7F" +
      std::string(300, 'x');
  const std::string scene = folder_.write("scene\x1B[2J.obj", scene_text(name));
  const std::string path = folder_.write("way.path", "-3 0 1\n4 0 1\n");
  EXPECT_EQ(data({"info", scene, "--json"})["scene"], scene);
  const json left_out = data({"info", scene, "--ignore", "block*", "--json"})["import"]["ignored_objects"];
  ASSERT_EQ(left_out.size(), 1U);
  EXPECT_EQ(left_out[0]["name"], "block " + name);
  const json walked = data({"walk", scene, "--path", path, "--mode", "fly", "--no-profile", "--json"});
  EXPECT_EQ(walked["blocked_at"]["object"], "block " + name);
  const std::string picture = folder_.file("way.svg");
  EXPECT_EQ(run({"walk", scene, "--path", path, "--mode", "fly", "--no-profile", "--picture", picture}).status, 3);
  EXPECT_EQ(folder_.read("way.svg").find('\x1B'), std::string::npos);
}

/// JSON escapes what a line of OBJ cannot hold.
TEST_F(Names, WithLinesInThem) {
  std::string bytes;
  for (const float c : {-9.0F, -9.0F, 0.0F, 9.0F, -9.0F, 0.0F, 0.0F, 9.0F, 0.0F}) {
    bytes.append(reinterpret_cast<const char*>(&c), sizeof c);
  }
  folder_.write("b.bin", bytes);
  const std::string name = "floor\nroam: all is well\n\x1B[2J" + std::string(70000, 'y');
  const json scene = {{"asset", {{"version", "2.0"}}},
                      {"scene", 0},
                      {"scenes", {{{"nodes", {0}}}}},
                      {"nodes", {{{"mesh", 0}, {"name", name}}}},
                      {"meshes", {{{"name", name}, {"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
                      {"buffers", {{{"uri", "b.bin"}, {"byteLength", bytes.size()}}}},
                      {"bufferViews", {{{"buffer", 0}, {"byteLength", bytes.size()}}}},
                      {"accessors",
                       {{{"bufferView", 0},
                         {"componentType", 5126},
                         {"count", 3},
                         {"type", "VEC3"},
                         {"min", {-9, -9, 0}},
                         {"max", {9, 9, 0}}}}}};
  const std::string file = folder_.write("scene.gltf", scene.dump());
  const ProgramResult result = run({"info", file, "--ignore", "*"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err.find("\nroam: all is well"), std::string::npos) << result.err;
  const std::string path = folder_.write("way.path", "0 0 9\n0 0 -9\n");
  const ProgramResult walked = run({"walk", file, "--up", "z", "--path", path, "--mode", "fly", "--no-profile"});
  EXPECT_EQ(walked.out.find("\nroam: all is well"), std::string::npos) << walked.out;
  EXPECT_NE(walked.out.find("floor roam: all is well"), std::string::npos) << walked.out;
}

}  // namespace
