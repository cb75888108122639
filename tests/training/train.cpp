// Training: what is answered of a scene, and both halves of the paper's claim on the made gallery.
#include "roam/train.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floor_pieces.h"
#include "roam/generate.h"
#include "roam/profile.h"
#include "train_scenes.h"
#include "ways/trials/trials.h"
#include "words/training.h"

namespace {

using roam::Mesh;
using roam::Method;
using roam::Mode;
using roam::Outcome;
using roam::Survey;
using roam::Training;
using roam::TrainOptions;
using roam::Vec3;
using roam::ways::BodyKind;
using roam::ways::settings_of;
using roam::ways::try_way;
using roam::words::answer;

bool says(const Training& t, const std::string& part) { return answer(t).find(part) != std::string::npos; }

/// Every body of a training that is sent along a path by hand does as the training says.
Outcome walked(const Survey& survey, double radius, double support, const std::vector<Vec3>& way, double height = 0.0) {
  return try_way(survey, BodyKind{.height = height}, radius, support, way).outcome;
}

TEST(Trial, EndsWhereItsPatienceDoes) {
  const Survey survey = corridor({.door = 1.0});
  const auto tried = [&](double patience) {
    return try_way(survey, {.height = 1.8}, 0.3, 0.0, corridor_way, {}, patience);
  };
  EXPECT_EQ(tried(roam::ways::trial_patience).outcome, Outcome::reached);
  EXPECT_EQ(tried(1.0).outcome, Outcome::reached);
  const roam::Trial impatient = tried(0.5);
  EXPECT_EQ(impatient.outcome, Outcome::blocked);
  EXPECT_GT(impatient.at.x, 2.0);
  EXPECT_LT(impatient.at.x, 8.0);
}

TEST(Training, FindsBothEndsAndTakesAPersonWhereOneFits) {
  const Training t = roam::train(corridor({.door = 1.0, .split = 0.4}), {.height = 1.8});
  ASSERT_TRUE(t.largest);
  EXPECT_NEAR(*t.largest, 0.5, 5e-4);
  EXPECT_NEAR(t.smallest, 0.2, 5e-4);
  EXPECT_TRUE(t.feasible);
  EXPECT_DOUBLE_EQ(t.radius, 0.3);
  EXPECT_DOUBLE_EQ(t.support_radius, 0.0);
  EXPECT_TRUE(t.complete);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  ASSERT_TRUE(t.narrowest && t.widest);
  EXPECT_EQ(t.narrowest->kind, roam::Opening::Kind::door);
  EXPECT_NEAR(t.narrowest->width, 1.0, 1e-3);
  EXPECT_NEAR(t.narrowest->point.x, 7.1, 0.2);
  EXPECT_NEAR(t.widest->radius, 0.2, 5e-4);
  EXPECT_NEAR(t.widest->point.x, 3.0, 0.01);
}

TEST(Training, BecomesAProfileThatHoldsAllOfTheBodyAndIsOfTheScene) {
  const Survey survey = Survey::build({corridor_mesh({.door = 0.3})}, {.lossless = true}, 40.0);
  const roam::SceneIdentity scene = roam::identity_of(survey.meshes());
  for (const auto& options :
       std::vector<TrainOptions>{{.paths = 1, .height = 1.8, .step = 0.25},
                                 {.paths = 1},
                                 {.mode = Mode::fly, .paths = 1, .spacing = 0.4},
                                 {.method = Method::paper, .paths = 1, .height = 1.8, .step = 0.25}}) {
    const Training t = roam::train(survey, options);
    const roam::Profile p = roam::profile_of(t, survey);
    EXPECT_NO_THROW(roam::check(p));
    EXPECT_TRUE(p.belongs_to(scene));
    EXPECT_EQ(p.mode, options.mode);
    EXPECT_EQ(p.method, roam::to_string(options.method));
    EXPECT_EQ(p.radius, t.radius);
    EXPECT_EQ(p.height, options.height > 0.0 ? 1.8 : 2.0 * t.radius);
    EXPECT_EQ(p.support_radius, t.support_radius);
    EXPECT_EQ(p.step, options.height > 0.0 ? 0.25 : std::min(t.step, t.radius));
    EXPECT_EQ(p.slope_degrees, 40.0);
    EXPECT_EQ(p.smallest, t.smallest);
    EXPECT_EQ(p.largest, t.largest);
    EXPECT_TRUE(p.complete);
  }
  EXPECT_EQ(roam::train(survey, {.paths = 1, .height = 1.8, .step = 1.6}).step, 0.9) << "half the height";
  const Training ended = roam::train(survey, {.progress = [](roam::TrainStage, double) { return false; }});
  EXPECT_FALSE(roam::profile_of(ended, survey).complete);
}

TEST(Training, TakesARadiusOfTheIntervalWhereAPersonIsTooWideOrTooSlim) {
  const Training slim = roam::train(corridor({.door = 0.5}), {.height = 1.8});
  EXPECT_LT(slim.radius, 0.25);
  EXPECT_GT(slim.radius, 0.23);
  const Training wide = roam::train(corridor({.door = 1.6, .split = 0.9}), {.height = 1.8});
  EXPECT_TRUE(wide.feasible);
  EXPECT_GT(wide.radius, 0.45);
  EXPECT_LT(wide.radius, 0.8);
  EXPECT_TRUE(wide.contradictions.empty()) << answer(wide);
}

TEST(Training, GivesADiscWhereNoOneRadiusServes) {
  const Training t = roam::train(corridor({.door = 0.8, .split = 1.25}), {.height = 1.8});
  EXPECT_FALSE(t.feasible);
  EXPECT_DOUBLE_EQ(t.radius, 0.3);
  EXPECT_NEAR(t.support_radius, 0.645, 1e-3);
  EXPECT_NEAR(t.trapped_radius, (0.625 * 0.625 + 0.09) / 0.6, 1e-3);
  EXPECT_TRUE(says(t, "No one radius serves")) << answer(t);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
}

TEST(Training, KeepsTheSmallestRadiusThatIsWanted) {
  const roam::Survey survey = corridor({.door = 0.8});
  const Training wide = roam::train(survey, {.radius_min = 0.35, .radius_max = 0.45, .height = 1.8});
  EXPECT_TRUE(wide.feasible) << answer(wide);
  EXPECT_DOUBLE_EQ(wide.radius, 0.35);
  const Training wider = roam::train(survey, {.radius_min = 0.45, .radius_max = 0.6, .height = 1.8});
  EXPECT_FALSE(wider.feasible) << answer(wider);
}

TEST(Training, IsTheSameForTheSameSeedAndAnyNumberOfThreads) {
  const Survey survey = corridor({.door = 0.8, .split = 0.5});
  for (const Method method : {Method::interval, Method::paper}) {
    const Training a = roam::train(survey, {.method = method, .seed = 7, .threads = 1});
    const Training b = roam::train(survey, {.method = method, .seed = 7, .threads = 0});
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.smallest, b.smallest);
    EXPECT_EQ(a.largest, b.largest);
    EXPECT_EQ(answer(a), answer(b));
    ASSERT_EQ(a.paths.size(), b.paths.size());
    for (std::size_t i = 0; i < a.paths.size(); ++i) {
      EXPECT_EQ(a.paths[i].way, b.paths[i].way);
      ASSERT_EQ(a.paths[i].trials.size(), b.paths[i].trials.size());
      for (std::size_t k = 0; k < a.paths[i].trials.size(); ++k)
        EXPECT_EQ(a.paths[i].trials[k].at, b.paths[i].trials[k].at);
    }
  }
}

TEST(Training, ByThePapersMethodEndsBetweenWhatFellAndWhatWasBlocked) {
  const Training t = roam::train(corridor({.door = 1.2, .split = 0.8}), {.method = Method::paper});
  EXPECT_TRUE(t.feasible) << answer(t);
  EXPECT_GT(t.radius, 0.4);
  EXPECT_LT(t.radius, 0.6);
  const Training none = roam::train(corridor({.door = 0.8, .split = 1.25}), {.method = Method::paper});
  EXPECT_FALSE(none.feasible);
  ASSERT_TRUE(none.paper);
  EXPECT_EQ(none.paper->ending, roam::PaperResult::Ending::contradiction) << answer(none);
}

/// The walls of a corridor lie beside the lattice as they like.
TEST(Training, IsNotDecidedByTheWallBesideTheEndOfAPath) {
  using namespace scenes;
  for (const double width : {0.5, 0.6, 0.7, 0.8}) {
    Mesh mesh;
    add_floor(mesh, 0.0, 0.0, width, 6.0, 0.0);
    for (const double x : {0.0, width}) add_wall(mesh, x, 0.0, x, 6.0, 0.0, 2.5);
    for (const double y : {0.0, 6.0}) add_wall(mesh, 0.0, y, width, y, 0.0, 2.5);
    const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
    ASSERT_TRUE(t.largest) << width << ": " << answer(t);
    EXPECT_NEAR(*t.largest, 0.5 * width, 1e-3) << width;
  }
}

TEST(Training, TakesADiscThatCarriesBesideAWall) {
  using namespace scenes;
  Mesh mesh;
  constexpr double gap = 0.6;
  add_floor(mesh, 0.0, gap, 8.0, 6.0, 0.0);
  add_floor(mesh, 0.0, 0.0, 8.0, 6.0, 3.0);
  add_floor(mesh, 0.0, 0.0, 8.0, gap, -5.0);
  add_wall(mesh, 0.0, gap, 8.0, gap, -5.0, 0.0);
  for (const double x : {0.0, 8.0}) add_wall(mesh, x, 0.0, x, 6.0, -5.0, 3.0);
  for (const double y : {0.0, 6.0}) add_wall(mesh, 0.0, y, 8.0, y, -5.0, 3.0);
  const Survey survey = survey_of({mesh});
  const Training t = roam::train(survey, {.height = 1.8});
  ASSERT_GT(t.support_radius, 0.5 * gap + 0.02) << answer(t);
  const std::vector<Vec3> along{{2.0, 2.0, 0.0}, {3.0, 0.35, 0.0}, {5.0, 0.35, 0.0}, {6.0, 2.0, 0.0}};
  EXPECT_EQ(walked(survey, 0.25, t.support_radius, along, 1.8), Outcome::reached);
  EXPECT_EQ(walked(survey, 0.25, 0.5 * gap + 0.02, along, 1.8), Outcome::fell);
}

/// What it climbs is lower than it was asked for: the trench is none for a step of 0.3 m.
TEST(Training, LooksForCracksWithTheStepThatItsPathsAreOf) {
  const Training t = roam::train(corridor({.door = 0.4, .split = 0.5, .depth = 0.25}));
  EXPECT_LT(t.step, 0.2) << answer(t);
  EXPECT_GT(t.step, 0.15) << answer(t);
  const auto trench = std::find_if(t.cracks.begin(), t.cracks.end(),
                                   [](const roam::Crack& crack) { return std::abs(crack.point.x - 3.0) < 0.1; });
  ASSERT_NE(trench, t.cracks.end()) << answer(t);
  EXPECT_NEAR(trench->radius, 0.25, 1e-3);
  EXPECT_FALSE(t.feasible) << answer(t);
  EXPECT_FALSE(says(t, "no crack lies on the way")) << answer(t);
}

/// The walker's foot takes what is at most 0.25 m deep for floor, and is carried over a gap that is deeper.
TEST(Training, RecommendsNoDiscForATrenchThatNoneHelpsOver) {
  for (const double depth : {0.23, 0.25, 0.4}) {
    const Training t = roam::train(corridor({.door = 0.8, .split = 1.2, .depth = depth}), {.height = 1.8, .step = 0.2});
    const bool helps = depth > 0.25;
    EXPECT_EQ(t.support_radius > 0.0, helps) << depth << ": " << answer(t);
    ASSERT_EQ(t.trench.has_value(), !helps) << depth << ": " << answer(t);
    if (t.trench) {
      EXPECT_NEAR(t.trench->crack.radius, 0.6, 1e-3);
    }
    EXPECT_TRUE(t.contradictions.empty()) << depth << ": " << answer(t);
  }
}

TEST(Training, SaysWhyThereIsNothingToTrain) {
  EXPECT_EQ(roam::train(survey_of({})).nowhere, roam::Nowhere::empty_scene);
  Mesh wall;
  scenes::add_wall(wall, 0.0, 0.0, 5.0, 0.0, 0.0, 3.0);
  EXPECT_EQ(roam::train(survey_of({wall})).nowhere, roam::Nowhere::no_floor);
  Mesh low;  // a ceiling over the floor, and a steep roof over the ceiling
  scenes::add_floor(low, 0.0, 0.0, 1.0, 5.0, 0.0);
  scenes::add_floor(low, 0.0, 0.0, 1.0, 5.0, 0.4);
  for (const double x : {0.0, 1.0}) {
    scenes::add_wall(low, x, 0.0, x, 5.0, 0.0, 0.4);
    scenes::add_quad(low, {x, 0.0, 0.4}, {x, 5.0, 0.4}, {0.5, 5.0, 1.9}, {0.5, 0.0, 1.9});
  }
  for (const double y : {0.0, 5.0}) {
    scenes::add_wall(low, 0.0, y, 1.0, y, 0.0, 0.4);
    scenes::add_triangle(low, {0.0, y, 0.4}, {1.0, y, 0.4}, {0.5, y, 1.9});
  }
  const Training t = roam::train(survey_of({low}), {.height = 1.8});
  EXPECT_TRUE(t.complete);
  EXPECT_FALSE(t.feasible);
  EXPECT_TRUE(t.paths.empty());
  EXPECT_EQ(t.nowhere, roam::Nowhere::no_room) << answer(t);
}

TEST(Training, OfOneTriangleIsNotLimited) {
  Mesh mesh;
  scenes::add_triangle(mesh, {0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0});
  const Training t = roam::train(survey_of({mesh}), {.height = 1.8});
  EXPECT_TRUE(t.feasible);
  EXPECT_FALSE(t.largest);
  EXPECT_EQ(t.smallest, 0.0);
  EXPECT_DOUBLE_EQ(t.radius, 0.3);
}

TEST(Training, WithoutAPathServesNobody) {
  Mesh mesh;
  scenes::add_triangle(mesh, {0.0, 0.0, 0.0}, {0.15, 0.0, 0.0}, {0.0, 0.15, 0.0});
  for (const Method method : {Method::interval, Method::paper}) {
    const Training t = roam::train(survey_of({mesh}), {.method = method, .height = 1.8});
    EXPECT_GT(t.places, 0u);
    EXPECT_TRUE(t.paths.empty());
    EXPECT_FALSE(t.feasible);
    EXPECT_TRUE(says(t, "was not tested")) << answer(t);
  }
}

/// Cracks for discs so small that tolerances would exceed them are not looked for.
TEST(Training, OfTheSmallestSpheresEndsBesideAnObliqueCrack) {
  Mesh mesh;
  floors::Floor(0.0, 0.0, 3.0, 2.0).without(floors::strip(1.5, 1.0, 0.03, 30.0)).add_to(mesh, 0.0);
  const Training t = roam::train(survey_of({mesh}), {.radius_min = 0.01, .radius_max = 0.01});
  EXPECT_TRUE(t.complete);
  EXPECT_DOUBLE_EQ(t.radius, 0.01);
}

TEST(Training, ThatIsToldToEndAnswersWhatItKnowsAndSaysSo) {
  const Survey survey = corridor({.door = 0.8, .split = 0.5});
  using roam::TrainStage;
  const auto ended = [&](TrainStage at, Method method = Method::interval) {
    TrainOptions options{.method = method, .height = 1.8};
    options.progress = [&](TrainStage stage, double) { return stage != at; };
    Training t = roam::train(survey, options);
    EXPECT_FALSE(t.complete) << answer(t);
    EXPECT_FALSE(t.feasible) << answer(t);
    EXPECT_DOUBLE_EQ(t.radius, 0.3) << answer(t);
    EXPECT_EQ(t.ended, at) << answer(t);
    EXPECT_TRUE(says(t, std::string("Ended early, while ") + roam::words::stage(at))) << answer(t);
    return t;
  };
  const Training places = ended(TrainStage::places);
  EXPECT_FALSE(places.nowhere);
  EXPECT_TRUE(says(places, "No pla")) << answer(places);
  EXPECT_TRUE(places.paths.empty());
  const Training paths = ended(TrainStage::planning);
  EXPECT_TRUE(says(paths, "No path was planned yet")) << answer(paths);
  const Training cracks = ended(TrainStage::cracks);
  EXPECT_NEAR(cracks.largest.value_or(0.0), 0.4, 1e-3);
  EXPECT_EQ(cracks.smallest, 0.0);
  EXPECT_FALSE(cracks.all_cracks) << answer(cracks);
  const Training trials = ended(TrainStage::trials);
  EXPECT_NEAR(trials.largest.value_or(0.0), 0.4, 1e-3);
  EXPECT_NEAR(trials.smallest, 0.25, 1e-3);
  EXPECT_TRUE(says(trials, "the best so far")) << answer(trials);
  const Training paper = ended(TrainStage::roaming_paths, Method::paper);
  ASSERT_TRUE(paper.paper);
  EXPECT_EQ(paper.paper->ending, roam::PaperResult::Ending::cancelled);
  EXPECT_EQ(paper.paper->radius, 0.0);
  EXPECT_TRUE(says(paper, "none passed any path")) << answer(paper);
  EXPECT_FALSE(says(paper, "0.000 m")) << answer(paper);
}

TEST(Training, TellsAShareOfTheWorkThatOnlyRisesFromNothingToAll) {
  for (const TrainOptions& asked : std::vector<TrainOptions>{
           {.paths = 1, .height = 1.8}, {.paths = 1}, {.method = Method::paper, .paths = 1, .height = 1.8}}) {
    std::vector<double> told;
    TrainOptions options = asked;
    options.progress = [&](roam::TrainStage, double done) {
      told.push_back(done);
      return true;
    };
    EXPECT_TRUE(roam::train(corridor({.door = 0.6, .split = 0.5}), options).complete);
    ASSERT_GT(told.size(), 10u);
    EXPECT_EQ(told.front(), 0.0);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.back(), 1.0);
    EXPECT_EQ(std::count(told.begin(), told.end(), 1.0), 1) << "nothing is done after all";
    EXPECT_GT(std::unique(told.begin(), told.end()) - told.begin(), 10);
  }
}

TEST(Training, RefusesOptionsThatNobodyCanMean) {
  const Survey survey = corridor({});
  EXPECT_THROW((void)roam::train(survey, {.mode = Mode::ghost}), roam::Error);
  EXPECT_THROW((void)roam::train(survey, {.radius_max = 0.0}), roam::Error);
  EXPECT_THROW((void)roam::train(survey, {.height = 0.15}), roam::Error);
  EXPECT_THROW((void)roam::train(survey, {.spacing = -1.0}), roam::Error);
  EXPECT_THROW((void)roam::train(survey, {.paths = -1}), roam::Error);
}

// ---------------------------------------------------------------------------------------- the paper's claim

/// The lower gallery of the dam with its split and two drainage grottos: too large a body stays out of the grottos, too
/// small a one falls into the split.
class PapersClaim : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::vector<Mesh> meshes;
    for (Mesh& mesh : roam::generate::collect(roam::generate::gallery({.triangles = 100'000})))
      if (mesh.name.starts_with("lower_gallery")) meshes.push_back(std::move(mesh));
    meshes_ = new std::vector<Mesh>(meshes);
    survey_ = new Survey(survey_of(std::move(meshes)));
    training_ = new Training(roam::train(*survey_, {.height = 1.7}));
  }
  static void TearDownTestSuite() {
    delete training_;
    delete survey_;
    delete meshes_;
  }

  static std::vector<Mesh>* meshes_;
  static Survey* survey_;
  static Training* training_;
};

std::vector<Mesh>* PapersClaim::meshes_ = nullptr;
Survey* PapersClaim::survey_ = nullptr;
Training* PapersClaim::training_ = nullptr;

TEST_F(PapersClaim, NoOneRadiusEntersTheGrottosAndIsCarriedOverTheSplit) {
  const Training& t = *training_;
  ASSERT_TRUE(t.largest) << answer(t);
  EXPECT_NEAR(*t.largest, 0.5 * roam::generate::gallery_door_width, 0.002);
  EXPECT_NEAR(t.smallest, 0.5 * roam::generate::gallery_split_width, 0.01);
  EXPECT_FALSE(t.feasible);
  EXPECT_DOUBLE_EQ(t.radius, 0.3);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  EXPECT_GT(t.separate, 1u) << answer(t);  // the bottom of the split is one
}

TEST_F(PapersClaim, TooLargeIsKeptOutTooSmallFallsAndTheTrainedBodyDoesNeither) {
  const Training& t = *training_;
  bool kept_out = false, fell = false;
  for (const roam::TrainedPath& path : t.paths) {
    if (path.largest) kept_out = kept_out || walked(*survey_, 0.5, 0.7, path.way, 1.7) == Outcome::blocked;
    if (path.smallest > 0.5) fell = fell || walked(*survey_, 0.3, 0.0, path.way, 1.7) == Outcome::fell;
    EXPECT_EQ(walked(*survey_, t.radius, t.support_radius, path.way, 1.7), Outcome::reached);
  }
  EXPECT_TRUE(kept_out);
  EXPECT_TRUE(fell);
}

TEST_F(PapersClaim, TheTrainedBodyViolatesNothing) {
  const Training& t = *training_;
  Mesh all;
  for (const Mesh& mesh : *meshes_) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& c : mesh.triangles) all.triangles.push_back({c[0] + first, c[1] + first, c[2] + first});
  }
  const scenes::Judge judge(all);
  const roam::TrainedPath& path = t.paths.front();
  const roam::WalkerSettings settings = settings_of(BodyKind{.height = 1.7}, t.radius, t.support_radius);
  std::vector<Vec3> centres;
  for (const Vec3& foot : path.way) centres.push_back(foot + Vec3(0.0, 0.0, 0.5 * settings.height + 0.05));
  roam::Walker walker(survey_->world(), settings, Mode::walk, centres.front());
  roam::Route route(walker, centres, {.dt = 0.1});
  double least = 0.0;
  while (!route.done()) least = std::min(least, scenes::margin(judge, route.advance(), settings.radius));
  EXPECT_EQ(route.result().outcome, Outcome::reached);
  EXPECT_GE(least, 0.0);
}

}  // namespace
