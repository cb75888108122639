// A store that the pager's memory does not hold: long sweeps and pictures of long ways.
#include <sstream>

#include "store_verbs.h"

namespace {

using namespace store_verbs;

/// 13 MB of collision, walked in 8 MiB.
class LargeStore : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TestFolder;
    roam::generate::write_scene(roam::generate::gallery({.triangles = 1'200'000, .seed = 1}), scene());
    folder_->write("straight.path", "-13739 253 182\n-12504 1566 182\n");
    const ProgramResult built = run({"build", scene()});
    ASSERT_EQ(built.status, 0) << built.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string scene() { return folder_->file("gallery.ply"); }
  static std::string store() { return scene() + ".roam"; }
  static std::string path() { return folder_->file("straight.path"); }

  static inline TestFolder* folder_ = nullptr;
};

/// The rows of the answers; 0 for the feature, which is a word.
std::vector<std::vector<double>> numbers(const std::string& csv) {
  constexpr std::size_t feature = 9;
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) {
      rows.back().push_back(rows.back().size() == feature ? 0.0 : std::stod(field));
    }
  }
  return rows;
}

TEST_F(LargeStore, AnswersMotionsThatAreTooLongForItsMemory) {
  // Through the whole gallery, in two pieces, down to the floor, and across the mountain: there and back.
  const std::string queries =
      "-13739,253,182,1235,1313,0,0.3\n-12504,1566,182,276,361,0,0.3\n-13739,253,182,0,0,-3,0.2\n"
      "-14300,-300,290,2600,2800,-100,0.5\n-11700,2500,190,-2600,-2800,100,0.5\n-12504,1566,182,-1235,-1313,0,0.3\n";
  const ProgramResult whole = run({"sweep", scene()}, queries),
                      paged = run({"sweep", store(), "--memory", "8M"}, queries);
  ASSERT_EQ(paged.status, 0) << paged.err;
  const auto expected = numbers(whole.out), answers = numbers(paged.out);
  ASSERT_EQ(answers.size(), 6U);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    ASSERT_EQ(answers[i].size(), 11U);
    EXPECT_EQ(answers[i][0], expected[i][0]) << i;
    EXPECT_NEAR(answers[i][1], expected[i][1], 1e-4) << i;
    // Certified either way; less where memory did not hold what lies beside the way.
    EXPECT_LE(answers[i][10], expected[i][10] + 2e-3) << i;
    if (answers[i][0] == 0.0) {
      EXPECT_GT(answers[i][10], 0.2 * expected[i][10]) << i;
    }
  }
  EXPECT_EQ(answers[0][0], 0.0) << "one motion goes through all of the gallery";
  EXPECT_EQ(answers[2][0], 1.0);
}

TEST_F(LargeStore, DrawsALongWayAsIfItHadHeldAllOfIt) {
  // A ghost goes the same way whatever has been loaded by then.
  const auto drawn = [&](const std::string& memory, const std::string& name) {
    const ProgramResult walked = run({"walk", store(), "--path", path(), "--mode", "ghost", "--speed", "100",
                                      "--memory", memory, "--picture", folder_->file(name)});
    EXPECT_EQ(walked.status, 0) << walked.err;
    return folder_->read(name);
  };
  const std::string little = drawn("64M", "little.svg"), much = drawn("256M", "much.svg");
  EXPECT_GT(little.size(), 20'000U);
  EXPECT_TRUE(little == much) << "what has left the pager's memory again is drawn as what it is";
}

}  // namespace
