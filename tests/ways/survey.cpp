// What a survey calls floor, and that its numbers lead back to the triangles that were passed.
#include "roam/survey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace {

using roam::Mesh;
using roam::Survey;
using roam::Triangle;
using roam::Vec3;

/// A triangle that rises by `degrees` along x, with a corner at `at`.
void add_ramp(Mesh& mesh, const Vec3& at, double degrees, bool flipped = false) {
  const double angle = glm::radians(degrees);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(at);
  mesh.vertices.push_back(at + Vec3(std::cos(angle), 0.0, std::sin(angle)));
  mesh.vertices.push_back(at + Vec3(0.0, 1.0, 0.0));
  if (flipped)
    mesh.triangles.push_back({first, first + 2, first + 1});
  else
    mesh.triangles.push_back({first, first + 1, first + 2});
}

TEST(Survey, FloorIsWhatIsNoSteeperThanTheLimitWhicheverSideIsUp) {
  Mesh mesh;
  add_ramp(mesh, {0.0, 0.0, 0.0}, 0.0);
  add_ramp(mesh, {10.0, 0.0, 0.0}, 44.9);
  add_ramp(mesh, {20.0, 0.0, 0.0}, 45.1);
  add_ramp(mesh, {30.0, 0.0, 0.0}, 44.9, true);
  add_ramp(mesh, {40.0, 0.0, 0.0}, 90.0);
  const Survey survey = Survey::build({mesh});
  ASSERT_EQ(survey.floor_triangles().size(), 3U);
  EXPECT_EQ(survey.floor_triangles()[0], 0U);
  EXPECT_EQ(survey.floor_triangles()[1], 1U);
  EXPECT_EQ(survey.floor_triangles()[2], 3U);
  EXPECT_EQ(survey.floor().stats().triangles, 3U);
  EXPECT_EQ(survey.world().stats().triangles, 5U);
}

TEST(Survey, ARampAtTheLimitIsFloorWhateverItsSize) {
  Mesh mesh;
  add_ramp(mesh, {0.0, 0.0, 0.0}, 0.0);
  const Survey survey = Survey::build({mesh}, {}, 45.0);
  for (const auto& [run, width] : {std::pair{1.0, 1.0}, {4.0, 2.0}, {0.5, 1.0}, {2.0, 3.0}, {10.0, 3.0}}) {
    EXPECT_TRUE(survey.is_floor({Vec3(0.0), Vec3(run, 0.0, run), Vec3(0.0, width, 0.0)})) << run << " x " << width;
  }
}

TEST(Survey, NumbersLeadBackToTheTrianglesAcrossMeshes) {
  std::vector<Mesh> meshes(4);
  for (int i = 0; i < 5; ++i) add_ramp(meshes[0], {double(i) * 10.0, 0.0, 0.0}, i % 2 == 0 ? 10.0 : 80.0);
  // The second has no triangle, the third no floor.
  add_ramp(meshes[2], {0.0, 100.0, 0.0}, 70.0);
  for (int i = 0; i < 3; ++i) add_ramp(meshes[3], {double(i) * 10.0, 200.0, 0.0}, 0.0);
  const std::vector<Mesh> passed = meshes;
  const Survey survey = Survey::build(std::move(meshes));
  ASSERT_EQ(survey.triangles(), 9U);
  roam::TriangleId id = 0;
  for (const Mesh& mesh : passed)
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i, ++id)
      EXPECT_EQ(survey.triangle(id), mesh.triangle(i)) << id;
  // What a query of the floors names is the triangle under it.
  ASSERT_EQ(survey.floor_triangles().size(), 6U);
  for (const roam::TriangleId floor : survey.floor_triangles()) {
    const Triangle corners = survey.triangle(floor);
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const roam::Impact down = survey.floor().ray(middle + Vec3(0.0, 0.0, 0.5), {0.0, 0.0, -1.0});
    ASSERT_TRUE(down.hit);
    EXPECT_EQ(survey.floor_triangles()[down.triangle], floor);
  }
}

TEST(Survey, SpecksAreNoFloorAndNothingIsNothing) {
  Mesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 0}};
  const Survey specks = Survey::build({mesh});
  EXPECT_TRUE(specks.floor_triangles().empty());
  EXPECT_EQ(specks.triangles(), 2U);
  const Survey nothing = Survey::build({});
  EXPECT_EQ(nothing.triangles(), 0U);
  EXPECT_TRUE(nothing.world().bounds().empty());
}

TEST(Survey, RefusesWhatIsOutOfRangeAndWhatWorldRefuses) {
  EXPECT_THROW(static_cast<void>(Survey::build({}, {}, 89.5)), roam::Error);
  EXPECT_THROW(static_cast<void>(Survey::build({}, {}, std::nan(""))), roam::Error);
  EXPECT_THROW(static_cast<void>(Survey::build({}, {.threads = -1})), roam::Error);
  try {
    static_cast<void>(Survey::build({}, {}, 95.0));
    ADD_FAILURE() << "a slope of 95 degrees was taken";
  } catch (const roam::Error& error) {
    EXPECT_NE(std::string(error.what()).find("95 degrees"), std::string::npos) << error.what();
  }
  Mesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_THROW(static_cast<void>(Survey::build({mesh})), roam::Error);
}

TEST(Survey, ProgressGrowsToOneAndCancels) {
  Mesh mesh;
  for (int i = 0; i < 3000; ++i) add_ramp(mesh, {double(i) * 2.0, 0.0, 0.0}, 10.0);
  double last = 0.0;
  const Survey survey = Survey::build({mesh}, {.progress = [&](double done) {
                                        EXPECT_GE(done, last);
                                        EXPECT_LE(done, 1.0);
                                        last = done;
                                        return true;
                                      }});
  EXPECT_GT(last, 0.8);
  EXPECT_THROW(static_cast<void>(Survey::build({mesh}, {.progress = [](double) { return false; }})), roam::Cancelled);
}

}  // namespace
