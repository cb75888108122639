// A profile that a stranger put beside a scene: it is refused by a sentence, soon and in little memory.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/time.h>

#include "program.h"
#include "roam/profile.h"

namespace {

class HostileProfile : public testing::Test {
 protected:
  /// What is said of the profile that lies there.
  std::string complaint() const {
    try {
      (void)roam::find_profile(std::filesystem::path(folder_.file("dam.ply")));
    } catch (const roam::Error& error) {
      return error.what();
    }
    return {};
  }
  void expect_refused(const std::string& why) const {
    const std::string said = complaint();
    EXPECT_NE(said.find("dam.ply.roam.json"), std::string::npos) << said;
    EXPECT_NE(said.find(why), std::string::npos) << said;
  }

  TestFolder folder_;
};

TEST_F(HostileProfile, ThatIsAPipeIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo(folder_.file("dam.ply.roam.json").c_str(), 0666), 0);
  ::alarm(20);  // ends this test, should it wait
  expect_refused("it is a pipe");
  ::alarm(0);
}

TEST_F(HostileProfile, ThatIsALinkIsNotFollowed) {
  const std::string secret = folder_.write("secret", "passphrase");
  std::filesystem::create_symlink(secret, folder_.file("dam.ply.roam.json"));
  expect_refused("it is a link");
  EXPECT_EQ(complaint().find("pass"), std::string::npos);
  std::filesystem::remove(secret);
  expect_refused("it is a link");
}

TEST_F(HostileProfile, ThatWouldTakeMuchMemoryIsRefused) {
  const auto write = [&](const std::string& text) { (void)folder_.write("dam.ply.roam.json", text); };
  write(std::string(15 << 20, '['));
  expect_refused("nested deeper");
  write(std::string(17, '[') + std::string(17, ']'));
  expect_refused("nested deeper than 16 levels");
  write(std::string(16, '[') + std::string(16, ']'));
  expect_refused("must be an object");
  std::string flat = "[0";
  for (int i = 0; i < 5'000'000; ++i) flat += ",[]";
  write(flat + "]");
  expect_refused("more than 1000000 values");
  std::string wide = "{\"regions\":[{}], \"x\":{\"\":0";
  for (int i = 0; i < 2000; ++i) wide += ",\"" + std::to_string(i) + "\":0";
  write(wide + "}}");
  expect_refused("more than 1000 members");
}

TEST_F(HostileProfile, OfAMillionObjectsIsReadInTheTimeOfItsSize) {
  std::string text = R"({"roam_profile":1,"frame":{"up":"z","unit":"m"},"x":[{})";
  for (int i = 0; i < 999'000; ++i) text += ",{}";
  folder_.write("dam.ply.roam.json", text + "]}");
  // A second would do. What grows with the square takes ten minutes of the processor, and is ended.
  const itimerval most{{}, {.tv_sec = 100, .tv_usec = 0}}, none{};
  ::setitimer(ITIMER_PROF, &most, nullptr);
  EXPECT_EQ(complaint(), "");
  ::setitimer(ITIMER_PROF, &none, nullptr);
}

TEST_F(HostileProfile, OfManyRegionsIsReadAllTheSame) {
  roam::Profile profile;
  profile.scene.geometry_hash = "0123456789abcdef";
  profile.scene.bounds = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  profile.method = "paper";
  profile.radius = 0.3;
  profile.height = 1.8;
  profile.step = 0.25;
  profile.slope_degrees = 50.0;
  profile.regions.assign(40'000, {profile.scene.bounds, 0.2, 0.0, "a door"});
  roam::save_profile(profile, folder_.file("dam.ply.roam.json"));
  EXPECT_EQ(complaint(), "");
}

}  // namespace
