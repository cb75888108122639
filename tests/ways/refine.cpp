// A way through the places of a lattice, made straight and as wide as possible.
#include "ways/refine/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "walker_scenes.h"

namespace {

using namespace scenes;
using roam::Passage;
using roam::Survey;

TEST(RefinedWay, IsAsWideAsItsStraightPieces) {
  // Round a post in a room. The straight piece to its corner leaves out a narrower place of the lattice.
  const Vec3 low(2.2, -0.4, 0.0), high(2.5, 0.1, 3.0);
  Mesh m;
  add_box(m, {0.0, -2.0, 0.0}, {6.0, 2.0, 3.0});
  add_box(m, low, high);
  constexpr double spacing = 0.2;
  std::vector<Vec3> places;
  for (const double y :
       {0.0, 0.1, 0.2, 0.3, 0.1, 0.3, 0.2, 0.4, 0.3, 0.4, 0.6, 0.7, 0.8, 0.8, 0.7, 0.6, 0.6, 0.4, 0.3, 0.4, 0.0}) {
    places.emplace_back(1.0 + spacing * static_cast<double>(places.size()), y, 0.0);
  }
  const Survey survey = Survey::build({m}, {.threads = 1, .lossless = true, .progress = {}});
  roam::ways::Measure person;
  person.height = 1.8;
  const Passage p = roam::ways::refine(survey, person, spacing, places);
  double width = 1.0;
  for (std::size_t i = 1; i < p.way.size(); ++i) {
    for (int k = 0; k <= 1000; ++k) {
      const Vec3 at = p.way[i - 1] + (k / 1000.0) * (p.way[i] - p.way[i - 1]);
      const Vec3 off = at - glm::clamp(at, low, high);
      width = std::min({width, std::hypot(off.x, off.y), at.x, 6.0 - at.x, 2.0 - std::abs(at.y)});
    }
  }
  ASSERT_TRUE(p.found && p.limited);
  EXPECT_NEAR(p.radius, width, 5e-4);
}

}  // namespace
