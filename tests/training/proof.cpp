// The trials that prove the ends of an interval: an end that was measured wrongly is found.
#include <gtest/gtest.h>

#include <algorithm>

#include "train_scenes.h"
#include "training/interval.h"
#include "words/training.h"

namespace {

using namespace roam;
using namespace roam::training;

/// Training up to its trials, with every opening measured `share` times as wide as it is.
Training proven(const Survey& survey, double share) {
  const TrainOptions options{.height = 1.8};
  const ways::BodyKind kind = kind_of(survey, options);
  Stages stages(options.progress);
  Layout layout = lay_out(survey, options, stages);
  cracks::RimEdges rims(survey, crack_options(options, layout.measure));
  Evidence evidence = find_cracks(survey, options, layout, rims, stages);
  for (PlannedPath& path : layout.paths) {
    if (!path.passage.opening) continue;
    path.passage.radius *= share;
    path.passage.opening->width *= share;
  }
  Training training;
  find_ends(survey, options, layout, evidence, training);
  choose_body(kind, options, evidence, training);
  prove(survey, kind, layout, evidence, stages, training);
  return training;
}

bool contradicts(const Training& training, Contradiction::Body body) {
  return std::any_of(training.contradictions.begin(), training.contradictions.end(),
                     [&](const Contradiction& c) { return c.body == body; });
}

/// A door; and two benches, higher than a step and lower than a wide body's middle.
std::vector<Survey> openings() {
  Mesh benches = corridor_mesh({});
  for (const double side : {-1.0, 1.0}) {
    const double near = side * 0.45, far = side * 2.0;
    scenes::add_box(benches, {6.0, std::min(near, far), 0.0}, {7.5, std::max(near, far), 0.4});
  }
  std::vector<Survey> surveys;
  surveys.push_back(corridor({.door = 0.9}));
  surveys.push_back(survey_of({benches}));
  return surveys;
}

TEST(Proof, ContradictsNoOpeningThatIsMeasuredWell) {
  for (const Survey& survey : openings()) {
    const Training t = proven(survey, 1.0);
    EXPECT_TRUE(t.contradictions.empty()) << words::answer(t);
    ASSERT_FALSE(t.paths.empty());
    // The chosen body, and bodies just inside and just outside the opening.
    EXPECT_TRUE(std::any_of(t.paths.begin(), t.paths.end(), [](const TrainedPath& p) { return p.trials.size() == 3; }));
  }
}

TEST(Proof, ContradictsAnOpeningThatIsMeasuredTooWide) {
  for (const Survey& survey : openings())
    EXPECT_TRUE(contradicts(proven(survey, 1.1), Contradiction::Body::inside_opening));
}

TEST(Proof, ContradictsAnOpeningThatIsMeasuredTooNarrow) {
  for (const double share : {0.95, 0.85}) {
    for (const Survey& survey : openings())
      EXPECT_TRUE(contradicts(proven(survey, share), Contradiction::Body::outside_opening)) << share;
  }
}

TEST(Proof, OfBothEndsIsByBodiesJustInsideAndJustOutside) {
  const Training t = roam::train(corridor({.door = 0.8, .split = 1.25}), {.height = 1.8});
  int inside = 0, blocked = 0, fell = 0;
  for (const roam::TrainedPath& path : t.paths) {
    for (const roam::Trial& trial : path.trials) {
      if (trial.outcome == Outcome::reached) {
        ++inside;
        EXPECT_LT(trial.radius, 0.4);
      } else if (trial.outcome == Outcome::blocked) {
        ++blocked;
        EXPECT_NEAR(trial.radius, 1.02 * 0.4, 1e-3);
      } else {
        ++fell;
        EXPECT_EQ(trial.outcome, Outcome::fell);
        EXPECT_NEAR(trial.support_radius, 0.605, 1e-3);
      }
    }
  }
  EXPECT_GT(inside, 0);
  EXPECT_GT(blocked, 0);
  EXPECT_GT(fell, 0);
}

}  // namespace
