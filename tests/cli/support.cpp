// roam walk --support-radius as a shell sees it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli_scenes.h"
#include "messages.h"
#include "program.h"

namespace {

const std::string way = "2 0 0.95\n12 0 0.95\n";

ProgramResult walk(const TestFolder& folder, const std::string& path, std::vector<std::string> more) {
  // A floor with a gap of 1.5 m, 10 m deep.
  std::vector<std::string> arguments{"walk", folder.write("scene.obj", gap_obj("6.5")), "--path",
                                     folder.write("p.path", path)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(ROAM_PROGRAM, arguments);
}

TEST(SupportRadius, CarriesOverAGapThatTheBodyFallsInto) {
  const TestFolder folder;
  for (const char* foot : {"0.73", "0.77"}) {
    const ProgramResult result =
        walk(folder, way, {"--radius", "0.3", "--height", "1.8", "--support-radius", foot, "--json", "--verify"});
    const auto report = nlohmann::json::parse(result.out, nullptr, false);
    const bool wide = std::string(foot) == "0.77";
    EXPECT_EQ(result.status, wide ? 0 : 3) << result.err;
    EXPECT_EQ(report["outcome"], wide ? "reached" : "fell") << result.out;
    EXPECT_EQ(report["support_radius"], wide ? 0.77 : 0.73);
    EXPECT_EQ(report["violations"], 0);
    EXPECT_GE(report["least_gap_m"].get<double>(), -1e-6);
    if (wide) {
      EXPECT_TRUE(contains(result.out, "\"bridged\""));
    } else {
      EXPECT_TRUE(contains(report["why"], "support radius of 0.73 m does not bridge"));
    }
  }
}

TEST(SupportRadius, IsRefusedOutOfRange) {
  const TestFolder folder;
  for (const char* foot : {"-0.1", "nan", "251", "wide"}) {
    const ProgramResult result = walk(folder, way, {std::string("--support-radius=") + foot});
    EXPECT_EQ(result.status, 2) << foot;
    EXPECT_TRUE(contains(result.err, "support")) << result.err;
  }
}

TEST(SupportRadius, IsTakenFromTheBodyThatRecordedThePath) {
  const TestFolder folder;
  const std::string body = "# roam: mode walk radius 0.3 height 1.8 eye 1.6 step 0.3 slope 45";
  const ProgramResult with = walk(folder, body + " support 0.8\n" + way, {});
  EXPECT_EQ(with.status, 0) << with.out << with.err;
  EXPECT_EQ(nlohmann::json::parse(walk(folder, body + " support 0.8\n" + way, {"--json"}).out)["support_radius"], 0.8);
  EXPECT_EQ(walk(folder, body + "\n" + way, {}).status, 3);
  // A person reads no sixteen digits.
  const ProgramResult measured = walk(folder, body + " support 0.8049999670494647\n" + way, {});
  EXPECT_FALSE(contains(measured.out, "0.80499")) << measured.out;
  const ProgramResult other = walk(folder, body + " support 0.8\n" + way, {"--support-radius", "0.9"});
  EXPECT_TRUE(contains(other.err, "support radius of 0.8 m; this one has 0.9 m")) << other.err;
}

}  // namespace
