// Training on the seeded galleries, whose both ends are known by construction.
#include <gtest/gtest.h>

#include <vector>

#include "roam/passage.h"
#include "roam/train.h"
#include "seeded_gallery.h"
#include "ways/trials/trials.h"
#include "words/training.h"

namespace {

using roam::Outcome;
using roam::Survey;
using roam::Training;
using roam::TrainOptions;
using roam::ways::BodyKind;
using roam::ways::try_way;
using roam::words::answer;

constexpr double height = 1.9;
constexpr double support_margin = 0.02;

struct Trained {
  seeded::Gallery gallery;
  Survey survey;
  Training training;
  std::vector<roam::Vec3> way;  ///< through all of it

  explicit Trained(std::uint64_t seed)
      : gallery(seeded::gallery(seed)), survey(Survey::build({gallery.mesh}, {.threads = 1, .lossless = true})) {
    training = roam::train(survey, {.height = height, .threads = 1});
    way = roam::widest_way(survey, gallery.from, gallery.to, {.height = height}).way;
  }
  [[nodiscard]] Outcome tried(double radius, double support) const {
    return try_way(survey, BodyKind{.height = height}, radius, support, way).outcome;
  }
};

class TrainedGallery : public ::testing::TestWithParam<int> {};

TEST_P(TrainedGallery, HasBothEndsAndBodiesProveThem) {
  const Trained g(static_cast<std::uint64_t>(GetParam()));
  ASSERT_TRUE(g.training.largest);
  const double upper = g.gallery.upper(), lower = g.gallery.lower();
  EXPECT_NEAR(*g.training.largest, upper, 0.001);
  EXPECT_NEAR(g.training.smallest, lower, 0.001);
  EXPECT_EQ(g.training.feasible, lower <= upper);
  EXPECT_TRUE(g.training.complete);
  EXPECT_TRUE(g.training.contradictions.empty()) << answer(g.training);

  EXPECT_EQ(g.tried(0.97 * upper, lower + support_margin), Outcome::reached);
  EXPECT_EQ(g.tried(1.02 * upper, lower + support_margin), Outcome::blocked);
  // A body that is wide enough itself, or is carried by the rims, needs no foot.
  if (0.97 * upper < lower - support_margin) {
    EXPECT_EQ(g.tried(0.97 * upper, lower - support_margin), Outcome::fell);
  }
  EXPECT_EQ(g.tried(g.training.radius, g.training.support_radius), Outcome::reached);
}

INSTANTIATE_TEST_SUITE_P(FiftySeeds, TrainedGallery, ::testing::Range(1, 51));

}  // namespace
