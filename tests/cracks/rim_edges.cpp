// What floors end at is found out whoever comes there: ahead, by parts or again, the cracks are the same bits.
#include "cracks/rim_edges.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include "cracks/voids.h"
#include "floor_cases.h"

namespace {

using namespace std::chrono_literals;
using floors::floor_cases;
using floors::FloorCase;
using roam::Mesh;
using roam::Survey;
using roam::Vec3;
using roam::cracks::find_cracks;
using roam::cracks::FoundCrack;
using roam::cracks::RimEdges;

Survey survey_of(const Mesh& mesh) { return Survey::build({mesh}, {.threads = 1, .lossless = true, .progress = {}}); }

void expect_same(const std::vector<FoundCrack>& a, const std::vector<FoundCrack>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].kind, b[i].kind);
    EXPECT_EQ(a[i].radius, b[i].radius);
    EXPECT_EQ(a[i].point, b[i].point);
    EXPECT_EQ(a[i].rim, b[i].rim);
  }
}

/// The edges of which it is known by now that they have no void.
std::size_t known(RimEdges& edges) {
  std::atomic<std::size_t> set{0};
  edges.look_at_all(
      [&](std::size_t, std::uint8_t& without, bool) { set += static_cast<std::size_t>(std::popcount(without)); }, {});
  return set;
}

/// A split in a fine mesh.
FloorCase fine_split() {
  for (FloorCase& c : floor_cases())
    if (c.name == "SplitInAFineMesh") return c;
  ADD_FAILURE();
  return {};
}

/// Far from each other: no edge is shared, and nothing is beside any.
Mesh lone_floors(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(0.04, 0, 0), Vec3(0, 0.04, 0)})
      mesh.vertices.push_back(Vec3(i % 100, i / 100, 0) + corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
    // A floor just below: nobody sinks.
    for (const Vec3& corner : {Vec3(-0.2, -0.2, -0.1), Vec3(0.4, -0.2, -0.1), Vec3(-0.2, 0.4, -0.1)})
      mesh.vertices.push_back(Vec3(i % 100, i / 100, 0) + corner);
    mesh.triangles.push_back({first + 3, first + 4, first + 5});
  }
  return mesh;
}

TEST(RimEdges, ChangeNoCrack) {
  for (const FloorCase& c : floor_cases()) {
    SCOPED_TRACE(c.name);
    const Survey survey = survey_of(c.mesh);
    const auto alone = find_cracks(survey, {}, c.is_reached);
    RimEdges edges(survey, {});
    edges.look_ahead();
    // Who comes to nothing leaves what others come to.
    EXPECT_TRUE(find_cracks(survey, edges, [](const Vec3&) { return false; }).empty());
    expect_same(find_cracks(survey, edges, c.is_reached), alone);
    expect_same(find_cracks(survey, edges, c.is_reached), alone);
  }
}

TEST(RimEdges, AreLookedAtAheadWhereThereIsAnotherCore) {
  const Survey survey = survey_of(lone_floors(5'000));
  const auto known_after = [&](int threads, std::chrono::milliseconds wait) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    RimEdges edges(survey, {});
    edges.look_ahead();
    std::this_thread::sleep_for(wait);
    return known(edges);
  };
  EXPECT_EQ(known_after(1, 20ms), 0u);
  constexpr std::size_t enough = 15'000 / 5;
  std::size_t known = 0;
  for (auto wait = 20ms; known < enough && wait < 60s; wait *= 2) known = known_after(4, wait);
  EXPECT_GE(known, enough);
}

TEST(RimEdges, AreTheSameHoweverFarTheOtherCoreHasCome) {
  const FloorCase c = fine_split();
  const Survey survey = survey_of(c.mesh);
  const auto alone = find_cracks(survey, {}, c.is_reached);
  ASSERT_EQ(alone.size(), 1u);
  constexpr int together = 100;
  const std::size_t floors = survey.floor_triangles().size(), of_floors = (floors + together - 1) / together;
  std::size_t pieces = 0;
  for (RimEdges edges(survey, {}, together); edges.look_ahead_here();) ++pieces;
  ASSERT_GT(pieces, of_floors);
  ASSERT_GT(of_floors, 20u);
  // Among what floors share, and among the floors.
  const std::size_t shared = pieces - of_floors;
  for (const std::size_t ahead : {shared / 2, shared + 1, shared + of_floors / 3, pieces - 2, pieces}) {
    SCOPED_TRACE(ahead);
    RimEdges edges(survey, {}, together);
    for (std::size_t i = 0; i < ahead; ++i) EXPECT_TRUE(edges.look_ahead_here());
    std::atomic<std::size_t> are_known{0};
    // Ended at the last moment, so that it stays as it is.
    EXPECT_FALSE(edges.look_at_all([&](std::size_t, std::uint8_t&, bool is_known) { are_known += is_known ? 1 : 0; },
                                   [](double done) { return done < 1.0; }));
    EXPECT_EQ(are_known, ahead > shared ? std::min(floors, together * (ahead - shared)) : 0);
    expect_same(find_cracks(survey, edges, c.is_reached), alone);
    EXPECT_FALSE(edges.look_ahead_here());
  }
}

TEST(RimEdges, KnowNoMoreThanWasLookedAtWhenTheyAreToldToEnd) {
  const FloorCase c = fine_split();
  const Survey survey = survey_of(c.mesh);
  const auto alone = find_cracks(survey, {}, c.is_reached);
  RimEdges edges(survey, {});
  (void)find_cracks(survey, edges, c.is_reached, [](double) { return false; });
  expect_same(find_cracks(survey, edges, c.is_reached), alone);
}

TEST(RimEdges, OfEnormousTrianglesAreExaminedAtALimitedNumberOfPlaces) {
  using roam::cracks::rim_places;
  EXPECT_EQ(rim_places(0.0, 0.05), 1.0);
  EXPECT_EQ(rim_places(6550.05, 0.05), 65501.0) << "edges of several kilometres are examined as densely as all";
  EXPECT_EQ(rim_places(2e9, 0.05), 65536.0);
}

TEST(RimEdges, AreNotExaminedFurtherOnceTheyMayEnd) {
  const Survey survey = survey_of(lone_floors(1));
  const roam::cracks::CrackOptions options;
  const roam::cracks::VoidProbe probe(survey, options);
  const auto without = [&](bool is_stopped) {
    const std::atomic<bool> stop{is_stopped};
    return edges_without_void(probe, options, survey.triangle(survey.floor_triangles()[0]), 0, stop);
  };
  EXPECT_EQ(without(false), 7);
  EXPECT_EQ(without(true), 0) << "a place that is not examined may have a void";
}

TEST(RimEdges, OfLongEdgesAskOftenWhetherToGoOn) {
  Mesh mesh;
  for (int i = 0; i < 16; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(900, 0, 0), Vec3(0, 900, 0)})
      mesh.vertices.push_back(Vec3(0, 0, 1000 * i) + corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const Survey survey = survey_of(mesh);
  RimEdges edges(survey, {});
  int asked = 0;
  std::atomic<int> looked{0};
  EXPECT_FALSE(
      edges.look_at_all([&](std::size_t, std::uint8_t&, bool) { ++looked; }, [&](double) { return ++asked < 3; }));
  EXPECT_EQ(asked, 3);
  EXPECT_LT(looked, 16);
}

TEST(RimEdges, AreLeftWhereTheyEndBeforeTheOtherCore) {
  const FloorCase c = fine_split();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
  const auto alone = find_cracks(survey_of(c.mesh), {}, c.is_reached);
  for (int i = 0; i < 20; ++i) {
    const Survey survey = survey_of(c.mesh);
    RimEdges(survey, {}, 50).look_ahead();
    RimEdges edges(survey, {}, 50);
    edges.look_ahead();
    expect_same(find_cracks(survey, edges, c.is_reached), alone);
  }
}

}  // namespace
