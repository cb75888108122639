// The C interface gives the results of C++, to the bit.
#include "roam/world.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "c_rig.h"

namespace {

using roam::Vec3;

TEST(CWorld, SweepsAsCppDoes) {
  const c_rig::Scene scene(1);
  int hits = 0;
  for (const roam::Query& query : scene.queries) {
    roam_impact impact{};
    impact.size = sizeof impact;
    const roam_query asked = c_rig::of(query);
    ASSERT_EQ(roam_sweep(scene.handle, &asked, &impact), ROAM_OK) << roam_error();
    const roam::Impact expected = scene.world.sweep(query);
    c_rig::expect_same(impact, expected);
    hits += impact.hit;
  }
  EXPECT_GT(hits, 100);
}

TEST(CWorld, MeasuresAsCppDoes) {
  const c_rig::Scene scene(2);
  int found = 0;
  for (const roam::Query& query : scene.queries) {
    const roam_query asked = c_rig::of(query);
    roam_contact nearest{};
    nearest.size = sizeof nearest;
    ASSERT_EQ(roam_clearance(scene.handle, &asked, 2.0, &nearest), ROAM_OK) << roam_error();
    const roam::Clearance expected = scene.world.clearance(query, 2.0);
    EXPECT_EQ(nearest.found != 0, expected.found);
    EXPECT_EQ(nearest.gap, expected.distance);
    EXPECT_EQ(nearest.triangle, expected.triangle);
    found += nearest.found;

    roam_contact contacts[5] = {};
    contacts[0].size = sizeof contacts[0];
    std::size_t count = 0;
    ASSERT_EQ(roam_contacts(scene.handle, &asked, 2.0, contacts, 5, &count), ROAM_OK) << roam_error();
    roam::Contact expected_contacts[5];
    ASSERT_EQ(count, scene.world.contacts(query, 2.0, expected_contacts));
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(contacts[i].triangle, expected_contacts[i].triangle);
      EXPECT_EQ(contacts[i].gap, expected_contacts[i].distance);
    }

    std::int32_t fits = -1;
    ASSERT_EQ(roam_fits(scene.handle, &asked, &fits), ROAM_OK) << roam_error();
    EXPECT_EQ(fits != 0, scene.world.fits(query.body, query.from));
  }
  EXPECT_GT(found, 100);
}

TEST(CWorld, BatchesOfAnyLayoutGiveTheSameBits) {
  const c_rig::Scene scene(3);
  struct Row {
    char odd;  // nothing behind it is aligned
    double radius, half_height;
    double from[3], motion[3], point[3], normal[3];
    double time, gap;
    std::uint64_t triangle;
    std::uint8_t hit;
  } __attribute__((packed));
  std::vector<Row> rows(scene.queries.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const roam::Query& q = scene.queries[i];
    rows[i] = {'x',
               q.body.radius,
               q.body.half_height,
               {q.from.x, q.from.y, q.from.z},
               {q.motion.x, q.motion.y, q.motion.z},
               {},
               {},
               0,
               0,
               0,
               0};
  }
  char* const first = reinterpret_cast<char*>(rows.data());
  const auto at = [&](std::size_t offset) { return roam_output{first + offset, sizeof(Row)}; };
  const auto in = [&](std::size_t offset) { return roam_input{first + offset, sizeof(Row)}; };
  roam_batch batch{};
  batch.size = sizeof batch;
  batch.count = rows.size();
  batch.from = in(offsetof(Row, from));
  batch.motion = in(offsetof(Row, motion));
  batch.radius = in(offsetof(Row, radius));
  batch.half_height = in(offsetof(Row, half_height));
  batch.time = at(offsetof(Row, time));
  batch.gap = at(offsetof(Row, gap));
  batch.point = at(offsetof(Row, point));
  batch.normal = at(offsetof(Row, normal));
  batch.triangle = at(offsetof(Row, triangle));
  batch.hit = at(offsetof(Row, hit));
  ASSERT_EQ(roam_sweep_batch(scene.handle, &batch), ROAM_OK) << roam_error();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row row = rows[i];
    const roam::Impact expected = scene.world.sweep(scene.queries[i]);
    EXPECT_EQ(std::memcmp(&row.point, &expected.point, sizeof row.point), 0) << i;
    EXPECT_EQ(std::memcmp(&row.normal, &expected.normal, sizeof row.normal), 0) << i;
    EXPECT_EQ(double{row.time}, expected.time) << i;
    EXPECT_EQ(double{row.gap}, expected.distance) << i;
    EXPECT_EQ(std::uint64_t{row.triangle}, expected.triangle) << i;
    EXPECT_EQ(row.hit != 0, expected.hit) << i;
  }

  // Without the contact: the same times.
  std::vector<double> times(rows.size());
  batch.gap = batch.point = batch.normal = {};
  batch.time = {times.data(), sizeof(double)};
  ASSERT_EQ(roam_sweep_batch(scene.handle, &batch), ROAM_OK) << roam_error();
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(times[i], double{rows[i].time}) << i;
}

TEST(CWorld, BatchesOfContactsFillAllTheirRoom) {
  const c_rig::Scene scene(4);
  constexpr std::size_t most = 3;
  const std::size_t n = scene.queries.size();
  std::vector<double> gaps(n * most);
  std::vector<std::size_t> found(n);
  std::vector<std::uint64_t> triangles(n * most);
  const double radius = 0.2;
  roam_batch batch{};
  batch.size = sizeof batch;
  batch.count = n;
  batch.from = {&scene.queries[0].from, sizeof(roam::Query)};
  batch.radius = {&radius, 0};
  batch.reach = 0.5;
  batch.most = most;
  batch.gap = {gaps.data(), most * sizeof(double)};
  batch.triangle = {triangles.data(), most * sizeof(std::uint64_t)};
  batch.found = {found.data(), sizeof(std::size_t)};
  ASSERT_EQ(roam_contacts_batch(scene.handle, &batch), ROAM_OK) << roam_error();
  std::size_t all = 0;
  for (std::size_t i = 0; i < n; ++i) {
    roam::Contact expected[most];
    ASSERT_EQ(found[i], scene.world.contacts({{0.2, 0.0}, scene.queries[i].from}, 0.5, expected));
    for (std::size_t k = 0; k < most; ++k) {
      EXPECT_EQ(gaps[i * most + k], k < found[i] ? expected[k].distance : 0.5);
      EXPECT_EQ(triangles[i * most + k], k < found[i] ? expected[k].triangle : ROAM_NO_TRIANGLE);
    }
    all += found[i];
  }
  EXPECT_GT(all, 100u);
}

TEST(CWorld, ABatchOfContactsThatAreManyCallsBackBetweenItsQueries) {
  const c_rig::Room room;
  const Vec3 from(1, 0, 1);
  std::vector<std::uint8_t> hit(64 * 64);
  std::vector<double> seen;
  roam_batch batch{};
  batch.size = sizeof batch;
  batch.count = 64;
  batch.from = {&from, 0};
  batch.reach = 10.0;
  batch.most = 64;
  batch.hit = {hit.data(), 64};
  batch.progress = [](double done, void* data) {
    static_cast<std::vector<double>*>(data)->push_back(done);
    return 0;
  };
  batch.progress_data = &seen;
  ASSERT_EQ(roam_contacts_batch(room.handle, &batch), ROAM_OK) << roam_error();
  ASSERT_FALSE(seen.empty());
  EXPECT_LT(seen[0], 1.0);
}

TEST(CWorld, IgnoresObjects) {
  const c_rig::Room room;
  roam_query query{};
  query.size = sizeof query;
  query.from = {1, 0, 1};
  query.motion = {20, 0, 0};
  roam_impact impact{};
  impact.size = sizeof impact;
  ASSERT_EQ(roam_sweep(room.handle, &query, &impact), ROAM_OK);
  EXPECT_EQ(impact.object, 1u);
  char name[32];
  EXPECT_EQ(roam_object_name(room.handle, impact.triangle, name, sizeof name), 4u);
  EXPECT_STREQ(name, "wall");
  EXPECT_EQ(roam_object_name(room.handle, impact.triangle, name, 3), 4u);
  EXPECT_STREQ(name, "wa");

  const std::uint32_t wall = 1;
  query.ignored = &wall;
  query.ignored_count = 1;
  ASSERT_EQ(roam_sweep(room.handle, &query, &impact), ROAM_OK);
  EXPECT_EQ(impact.hit, 0);

  roam_space* without = nullptr;
  ASSERT_EQ(roam_filtered_create(room.handle, &without), ROAM_OK);
  ASSERT_EQ(roam_filtered_ignore_only(without, &wall, 1), ROAM_OK);
  query.ignored_count = 0;
  ASSERT_EQ(roam_sweep(without, &query, &impact), ROAM_OK);
  EXPECT_EQ(impact.hit, 0);
  EXPECT_EQ(roam_filtered_ignore_only(room.handle, &wall, 1), ROAM_INVALID);
  roam_space_free(without);
}

TEST(CWorld, ABatchOfFitsSaysWhatIsInTheWay) {
  const c_rig::Room room;
  const Vec3 from[2] = {{1, 0, 1}, {4.9, 0, 1}};
  const double radius = 0.3;
  std::uint8_t fits[2] = {7, 7}, unknown[2] = {7, 7};
  std::uint64_t triangle[2] = {};
  std::uint32_t object[2] = {};
  roam_batch batch{};
  batch.size = sizeof batch;
  batch.count = 2;
  batch.from = {from, sizeof(Vec3)};
  batch.radius = {&radius, 0};
  batch.hit = {fits, 1};
  batch.unknown = {unknown, 1};
  batch.triangle = {triangle, sizeof(std::uint64_t)};
  batch.object = {object, sizeof(std::uint32_t)};
  ASSERT_EQ(roam_fits_batch(room.handle, &batch), ROAM_OK) << roam_error();
  EXPECT_EQ(fits[0], 1);
  EXPECT_EQ(triangle[0], ROAM_NO_TRIANGLE);
  EXPECT_EQ(fits[1], 0);
  EXPECT_TRUE(triangle[1] == 2 || triangle[1] == 3) << triangle[1];
  EXPECT_EQ(object[1], 1u);
  EXPECT_EQ(unknown[0] + unknown[1], 0);
}

TEST(CWorld, NamesTheFirstQueryThatIsRefused) {
  const c_rig::Room room;
  std::vector<Vec3> from(5000, Vec3(1, 0, 1));
  from[4000].y = from[1234].x = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> times(from.size());
  roam_batch batch{};
  batch.size = sizeof batch;
  batch.count = from.size();
  batch.from = {from.data(), sizeof(Vec3)};
  batch.time = {times.data(), sizeof(double)};
  EXPECT_EQ(roam_sweep_batch(room.handle, &batch), ROAM_INVALID);
  EXPECT_STREQ(roam_error(), "query 1234: cannot answer a query: the place is not finite");
}

TEST(CWorld, AQueryThatWasRefusedStaysSoThoughItsInputIsMendedMeanwhile) {
  const c_rig::Room room;
  std::vector<Vec3> from(50, Vec3(1, 0, 1));
  from[7].x = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> times(from.size(), -1.0);
  roam_batch batch{};
  batch.size = sizeof batch;
  batch.count = from.size();
  batch.from = {from.data(), sizeof(Vec3)};
  batch.time = {times.data(), sizeof(double)};
  batch.progress_data = &from[7];
  batch.progress = [](double, void* data) {
    static_cast<Vec3*>(data)->x = 1.0;
    return 0;
  };
  EXPECT_EQ(roam_sweep_batch(room.handle, &batch), ROAM_INVALID);
  EXPECT_STREQ(roam_error(), "query 7: cannot answer a query: the place is not finite");
  EXPECT_EQ(times[8], -1.0) << "and none after it is computed";
}

TEST(CWorld, BatchesEndWhenTheCallbackSaysSo) {
  const c_rig::Room room;
  const Vec3 from(1, 0, 1);
  const Vec3 motion(3, 0, 0);
  struct Calls {
    std::atomic<int> count{0};
  } calls;
  roam_batch batch{};
  batch.size = sizeof batch;
  batch.count = std::size_t{1} << 40;  // hours
  batch.from = {&from, 0};
  batch.motion = {&motion, 0};
  batch.progress = [](double done, void* data) {
    EXPECT_GE(done, 0.0);
    return ++static_cast<Calls*>(data)->count == 5 ? 1 : 0;
  };
  batch.progress_data = &calls;
  EXPECT_EQ(roam_sweep_batch(room.handle, &batch), ROAM_CANCELLED);
  EXPECT_EQ(calls.count, 5);
}

TEST(CWorld, ServesManyThreads) {
  const c_rig::Scene scene(5);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (const roam::Query& query : scene.queries) {
        const roam_query asked = c_rig::of(query);
        roam_impact impact{};
        impact.size = sizeof impact;
        ASSERT_EQ(roam_sweep(scene.handle, &asked, &impact), ROAM_OK);
        ASSERT_EQ(impact.time, scene.world.sweep(query).time);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(CWorld, OpensAFile) {
  const c_rig::Room room;
  roam_space* world = nullptr;
  ASSERT_EQ(roam_world_open(room.file("room.obj").c_str(), nullptr, &world), ROAM_OK) << roam_error();
  roam_space_facts facts{};
  facts.size = sizeof facts;
  ASSERT_EQ(roam_space_get_facts(world, &facts), ROAM_OK);
  EXPECT_EQ(facts.triangles, 4u);
  EXPECT_EQ(facts.objects, 2u);
  EXPECT_EQ(facts.lower.x, 0.0);
  EXPECT_EQ(facts.upper.x, 9.0);
  roam_space_free(world);

  roam_world_options inches{};
  inches.size = sizeof inches;
  inches.unit = "in";
  inches.up = "-z";
  ASSERT_EQ(roam_world_open(room.file("room.obj").c_str(), &inches, &world), ROAM_OK) << roam_error();
  ASSERT_EQ(roam_space_get_facts(world, &facts), ROAM_OK);
  EXPECT_NEAR(facts.upper.x, 9.0 * 0.0254, 1e-9);
  EXPECT_NEAR(facts.lower.z, -3.0 * 0.0254, 1e-9);
  roam_space_free(world);
  inches.unit = "ell";
  EXPECT_EQ(roam_world_open(room.file("room.obj").c_str(), &inches, &world), ROAM_INVALID);
}

}  // namespace
