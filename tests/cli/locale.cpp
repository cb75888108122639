// A host whose locale writes 1.234,5 gets the same sentences and reads the same files.

#include <gtest/gtest.h>

#include <clocale>
#include <cstdio>
#include <functional>
#include <locale>
#include <sstream>

#include "program.h"
#include "roam/import.h"
#include "roam/path_file.h"
#include "roam/probe.h"
#include "roam/profile.h"
#include "roam/standing.h"
#include "roam/sweep.h"
#include "roam/walker.h"
#include "roam/world.h"
#include "words/probe.h"

namespace {

using namespace roam;

class Comma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Both locales of a process, C's and C++'s, write a decimal comma for its life.
class German {
 public:
  German() {
    // Debian has no German locale but what is made of its source, by the package locales.
    const std::string make =
        "localedef -i de_DE -f UTF-8 '" + folder_.file("de_DE.UTF-8") + "' 2>&1 >" + folder_.file("log");
    if (std::system(make.c_str()) != 0) ADD_FAILURE() << "localedef failed: install the package locales";
    setenv("LOCPATH", folder_.file("").c_str(), 1);
    if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) ADD_FAILURE() << "there is no locale de_DE.UTF-8";
    before_ = std::locale::global(std::locale(std::locale::classic(), new Comma));
    // Only C++ has been set back to no name of C's.
    EXPECT_STREQ(std::setlocale(LC_NUMERIC, "de_DE.UTF-8"), "de_DE.UTF-8");
    std::ostringstream stream;
    stream << 1234.5;
    EXPECT_EQ(stream.str(), "1.234,5");
    EXPECT_EQ(std::to_string(0.5), "0,500000");
  }
  ~German() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
  }
  German(const German&) = delete;
  German& operator=(const German&) = delete;

 private:
  TestFolder folder_;
  std::locale before_;
};

void expect_same(const std::function<std::string()>& told) {
  const std::string usual = told();
  EXPECT_NE(usual, "");
  const German german;
  EXPECT_EQ(told(), usual);
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return std::string(error.what()) + "\n";
  }
  ADD_FAILURE() << "not refused";
  return "";
}

const Mesh floor_mesh{"floor", {{-2e3, -2e3, 0.25}, {2e3, -2e3, 0.25}, {0, 2e3, 0.25}}, {{0, 1, 2}}};

TEST(Locale, Refusals) {
  const World world = World::build({&floor_mesh, 1});
  const Triangle triangle = floor_mesh.triangle(0);
  expect_same([&] {
    std::string told;
    told += refusal([&] { static_cast<void>(world.sweep({-1.5}, Vec3(0.0), Vec3(1.0))); });
    told += refusal([&] { static_cast<void>(world.sweep({12345.5}, Vec3(0.0), Vec3(1.0))); });
    told += refusal([&] { static_cast<void>(world.floor_clearance({0.3}, Vec3(0.0), 1.0, {.slope_degrees = 91.5})); });
    told += refusal([&] { static_cast<void>(sweep({-0.5}, Vec3(0.0), Vec3(1.0), triangle)); });
    told += refusal([&] { static_cast<void>(sweep({0.5, -0.25}, Vec3(0.0), Vec3(1.0), triangle)); });
    told += refusal([&] { check(WalkerSettings{.radius = 12345.5}); });
    told += refusal([&] { static_cast<void>(place_to_stand(world, {}, Vec3(0.0), 12345.5)); });
    told += refusal([&] {
      Walker walker(world, {}, Mode::fly, {0.0, 0.0, 5.0});
      walker.step({}, -0.5);
    });
    told += refusal([&] {
      Walker walker(world, {}, Mode::fly, {0.0, 0.0, 5.0});
      const Vec3 way[] = {{0.0, 0.0, 5.0}, {1.0, 0.0, 5.0}};
      static_cast<void>(follow(walker, way, {.speed = -1.5}));
    });
    return told;
  });
}

TEST(Locale, Files) {
  const TestFolder folder;
  folder.write("scene.obj", "v 0.5 0 0\nv 1234.5 0 0\nv 0 1234.25 0\nf 1 2 3\n");
  folder.write("way.path", "0.5 1.25 2000.5\n1.5 1 1e3\n");
  const std::vector<Vec3> way{{0.5, 1234.5, 1e6}, {1.5, 0.25, 1.0}};
  const WalkerSettings body;
  expect_same([&] {
    std::string told;
    ImportOptions options;
    options.unit = LengthUnit::ft;
    const ImportedScene scene = import_scene(folder.file("scene.obj"), options);
    for (const Vec3& v : scene.meshes.at(0).vertices) {
      told +=
          std::to_string(std::bit_cast<std::uint64_t>(v.x)) + " " + std::to_string(std::bit_cast<std::uint64_t>(v.y));
    }
    for (const Waypoint& w : load_path(folder.file("way.path"))) {
      told += std::to_string(std::bit_cast<std::uint64_t>(w.position.z)) + "\n";
    }
    save_path(folder.file("out.path"), way, &body, Mode::walk);
    told += folder.read("out.path");
    Profile profile;
    profile.scene = identity_of({&floor_mesh, 1});
    profile.radius = 0.35;
    profile.height = 1.75;
    profile.regions.push_back({{Vec3(-1234.5), Vec3(0.5)}, 0.25, 0.0, "a door"});
    save_profile(profile, folder.file("p.json"));
    told += folder.read("p.json");
    told +=
        std::to_string(std::bit_cast<std::uint64_t>(load_profile(folder.file("p.json")).regions.at(0).bounds.lower.x));
    return told;
  });
}

TEST(Locale, Answers) {
  const Survey survey = Survey::build({floor_mesh});
  expect_same([&] {
    ProbeQuestion question;
    question.from = {0.5, 0.25, 1.0};
    question.to = {3.5, 0.75, 1.0};
    return words::report(question, probe(survey, question, {0.35, 1.75})).sentences();
  });
}

}  // namespace
