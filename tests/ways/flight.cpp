// Training in the air: which spheres fly everywhere, in ducts, up shafts and under the sky.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flight_scenes.h"
#include "roam/train.h"
#include "words/training.h"

namespace {

using roam::Mesh;
using roam::Mode;
using roam::Outcome;
using roam::Training;
using roam::words::answer;

constexpr double flight_error = 5e-4;  // m

Training trained(const Mesh& mesh, double spacing = 0.2) {
  const roam::Survey survey = roam::Survey::build({mesh}, {.threads = 1, .lossless = true, .progress = {}});
  return roam::train(survey, {.mode = Mode::fly, .spacing = spacing, .threads = 1});
}

/// One answer, which all trials bear out.
void expect_proven(const Training& t) {
  EXPECT_TRUE(t.feasible) << answer(t);
  EXPECT_TRUE(t.complete);
  EXPECT_TRUE(t.contradictions.empty()) << roam::words::contradiction(t.contradictions.front());
  EXPECT_GE(t.paths.size(), 5u);
}

void expect_largest(const Training& t, double radius) {
  expect_proven(t);
  ASSERT_TRUE(t.largest) << answer(t);
  EXPECT_NEAR(*t.largest, radius, flight_error) << answer(t);
}

TEST(TrainFlight, ADuctDecidesAndNoEndOfAPathInIt) {
  expect_largest(trained(flight::joined_by_duct(0.4, 0.4, 3.0, 0.0)), 0.2);
}

TEST(TrainFlight, AnObliqueDuctDecidesByWhatIsNarrowestAcrossIt) {
  expect_largest(trained(flight::joined_by_duct(0.6, 0.5, 4.0, 3.0)), 0.2);
}

TEST(TrainFlight, ARoomIsReachedThroughAShaft) { expect_largest(trained(flight::joined_by_shaft(0.7, 4.0)), 0.35); }

TEST(TrainFlight, OfADoorAndAWindowTheWiderDecides) {
  expect_largest(trained(flight::joined_by_openings({{0.5, 1.1, 0.0, 2.0}, {2.2, 3.1, 1.0, 1.9}})), 0.45);
}

TEST(TrainFlight, RoomsWithoutAWayBetweenThemAreTwoParts) {
  const Training t = trained(flight::joined_by_openings({}));
  expect_proven(t);
  EXPECT_FALSE(t.largest);
  EXPECT_EQ(std::count_if(t.parts.begin(), t.parts.end(), [](const auto& part) { return part.trained; }), 2);
}

TEST(TrainFlight, UnderTheSkyWhatIsOpenIsTrainedAndNotTheInsideOfBlocks) {
  const Training t = trained(flight::open_country(2), 0.4);
  expect_proven(t);
  EXPECT_FALSE(t.largest) << answer(t);
  for (const roam::TrainedPath& path : t.paths) {
    for (const roam::Vec3& place : path.way) {
      const double x = std::fmod(place.x, 16.0), y = std::fmod(place.y, 16.0);
      EXPECT_FALSE(place.z < 2.0 && x > 2.5 && x < 6.5 && y > 2.5 && y < 5.5) << place.x << " " << place.y;
    }
  }
  for (const roam::TrainedPath& path : t.paths)
    for (const roam::Trial& trial : path.trials) EXPECT_EQ(trial.outcome, Outcome::reached);
}

}  // namespace
