// Walkers, routes, stores, probes and training behind the C interface.
#include "roam/walker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "c_rig.h"
#include "roam/route.h"

namespace {

using roam::Vec3;

roam_walker_settings person() {
  roam_walker_settings settings{};
  settings.size = sizeof settings;
  EXPECT_EQ(roam_walker_person(&settings, 0.3, 1.8), ROAM_OK);
  return settings;
}

TEST(CWalker, MovesAsCppDoes) {
  const c_rig::Room room;
  const roam::World world = roam::World::build(c_rig::room_meshes());
  roam::Walker expected(world, roam::WalkerSettings::person(0.3, 1.8), roam::Mode::walk, {1, 0, 1});
  const roam_walker_settings settings = person();
  roam_walker* walker = nullptr;
  ASSERT_EQ(roam_walker_create(room.handle, &settings, ROAM_WALK, {1, 0, 1}, &walker), ROAM_OK) << roam_error();
  roam_step step{};
  step.size = sizeof step;
  unsigned events = 0;
  for (int i = 0; i < 300; ++i) {
    roam::WalkerInput wish;
    // It stops and goes on, at times as slowly as limits make it.
    if (i % 40 < 30) wish.velocity = Vec3(2.0 * std::cos(0.004 * i), 2.0 * std::sin(0.004 * i), 0.0);
    wish.jump = i == 100;
    wish.crouch = i >= 150 && i < 180;
    if (i >= 10 && i < 50) wish.acceleration = 5.0;
    if (i >= 60 && i < 90) wish.braking = 4.0;
    roam_walker_input input{};
    input.size = sizeof input;
    input.velocity = c_rig::of(wish.velocity);
    input.jump = wish.jump ? 1 : 0;
    input.crouch = wish.crouch ? 1 : 0;
    if (i >= 10 && i < 50) input.acceleration = wish.acceleration;
    if (i >= 60 && i < 90) input.braking = wish.braking;
    ASSERT_EQ(roam_walker_step(walker, &input, 1.0 / 60, &step), ROAM_OK) << roam_error();
    const roam::StepReport& report = expected.step(wish, 1.0 / 60);
    EXPECT_SAME_VEC(step.to, report.to);
    EXPECT_EQ(step.least_gap, report.least_gap);
    EXPECT_EQ(step.grounded != 0, report.grounded);
    for (const roam::Event& event : report.events) EXPECT_TRUE(step.events >> int(event.kind) & 1u);
    events |= step.events;
  }
  EXPECT_TRUE(events >> ROAM_JUMPED & 1u);
  EXPECT_TRUE(events >> ROAM_LANDED & 1u);
  EXPECT_TRUE(events >> ROAM_SLID & 1u);

  roam_walker* copy = nullptr;
  ASSERT_EQ(roam_walker_copy(walker, &copy), ROAM_OK);
  ASSERT_EQ(roam_walker_place_feet(walker, {2, 2, 0}, &step), ROAM_OK);
  roam_walker_state state{};
  state.size = sizeof state;
  ASSERT_EQ(roam_walker_get_state(walker, &state), ROAM_OK);
  EXPECT_NEAR(state.position.x, 2.0, 0.01);
  ASSERT_EQ(roam_walker_get_state(copy, &state), ROAM_OK);
  EXPECT_SAME_VEC(state.position, expected.position());
  ASSERT_EQ(roam_walker_set_mode(copy, ROAM_GHOST, nullptr), ROAM_OK);
  ASSERT_EQ(roam_walker_get_state(copy, &state), ROAM_OK);
  EXPECT_EQ(state.mode, ROAM_GHOST);
  EXPECT_EQ(roam_walker_set_mode(copy, 3, nullptr), ROAM_INVALID);
  roam_walker_free(copy);
  roam_walker_free(walker);
}

TEST(CWalker, OutlivesTheHandleOfItsSpace) {
  roam_space* world = c_rig::built(c_rig::room_meshes());
  roam_space* without = nullptr;
  ASSERT_EQ(roam_filtered_create(world, &without), ROAM_OK);
  const roam_walker_settings settings = person();
  roam_walker* walker = nullptr;
  ASSERT_EQ(roam_walker_create(without, &settings, ROAM_WALK, {1, 0, 0.9}, &walker), ROAM_OK);
  roam_space_free(world);
  roam_space_free(without);
  const roam_vec3 path[] = {{1, 0, 0.9}, {8, 0, 0.9}};
  roam_route_result result{};
  result.size = sizeof result;
  ASSERT_EQ(roam_route_follow(walker, path, 2, nullptr, &result), ROAM_OK) << roam_error();
  EXPECT_EQ(result.outcome, ROAM_ROUTE_BLOCKED);
  EXPECT_NEAR(result.end.x, 4.7, 0.01);
  EXPECT_EQ(result.waypoints, 1u);

  roam_contact contacts[8] = {};
  contacts[0].size = sizeof contacts[0];
  std::size_t count = 0;
  ASSERT_EQ(roam_walker_get_contacts(walker, contacts, 8, &count), ROAM_OK);
  EXPECT_GE(count, 1u);
  roam_walker_free(walker);
}

TEST(CWalker, WalksInAStore) {
  const made::Folder folder("c_store");
  const std::vector<roam::Mesh> meshes = c_rig::room_meshes();
  (void)made::store(folder.path() / "room.roam", meshes);
  roam_space* store = nullptr;
  ASSERT_EQ(roam_store_open((folder.path() / "room.roam").c_str(), nullptr, &store), ROAM_OK) << roam_error();
  roam_query query{};
  query.size = sizeof query;
  query.from = {1, 0, 1};
  query.motion = {8, 0, 0};
  query.radius = 0.3;
  std::int32_t complete = 0;
  ASSERT_EQ(roam_space_load(store, &query, 20.0, nullptr, nullptr, &complete), ROAM_OK) << roam_error();
  EXPECT_EQ(complete, 1);
  roam_impact impact{};
  impact.size = sizeof impact;
  ASSERT_EQ(roam_sweep(store, &query, &impact), ROAM_OK);
  EXPECT_EQ(impact.hit, 1);
  EXPECT_EQ(impact.unknown, 0);
  EXPECT_NEAR(8.0 * impact.time, 3.7, 0.003);
  const std::uint32_t object = 0;
  query.ignored = &object;
  query.ignored_count = 1;
  EXPECT_EQ(roam_sweep(store, &query, &impact), ROAM_INVALID);
  EXPECT_EQ(std::string(roam_error()), "a store has no objects to ignore; leave them out when it is built");
  query.ignored_count = 0;
  roam_space* without = nullptr;
  ASSERT_EQ(roam_filtered_create(store, &without), ROAM_OK);
  EXPECT_EQ(roam_filtered_ignore_only(without, nullptr, 0), ROAM_OK);
  EXPECT_EQ(roam_filtered_ignore_only(without, &object, 1), ROAM_INVALID);
  roam_space_free(without);
  roam_batch batch{};
  batch.size = sizeof batch;
  batch.ignored = &object;
  batch.ignored_count = 1;
  EXPECT_EQ(roam_sweep_batch(store, &batch), ROAM_INVALID);
  query.motion = {1000, 0, 0};
  ASSERT_EQ(roam_space_load(store, &query, 20.0, nullptr, nullptr, &complete), ROAM_OK) << roam_error();
  EXPECT_EQ(complete, 1);
  query.motion = {1001, 0, 0};
  ASSERT_EQ(roam_space_load(store, &query, 20.0, nullptr, nullptr, &complete), ROAM_OK) << roam_error();
  EXPECT_EQ(complete, 0) << "of a motion longer than it can load";

  const roam_walker_settings settings = person();
  roam_walker* walker = nullptr;
  ASSERT_EQ(roam_walker_create(store, &settings, ROAM_WALK, {1, 0, 0.95}, &walker), ROAM_OK);
  const roam_vec3 path[] = {{1, 0, 0.9}, {4, 2, 0.9}};
  roam_route_result result{};
  result.size = sizeof result;
  ASSERT_EQ(roam_route_follow(walker, path, 2, nullptr, &result), ROAM_OK) << roam_error();
  EXPECT_EQ(result.outcome, ROAM_ROUTE_REACHED);
  std::int32_t changed = -1;
  EXPECT_EQ(roam_space_update(store, walker, &changed), ROAM_OK);

  // Waiting for a store ends, too.
  roam_route_options options{};
  options.size = sizeof options;
  options.progress = [](double, void*) { return 1; };
  EXPECT_EQ(roam_route_follow(walker, path, 2, &options, &result), ROAM_CANCELLED);
  roam_walker_free(walker);
  roam_space_free(store);
}

TEST(CSurvey, ProbesAndTrains) {
  // A room of 9 m by 5 m by 3 m with a wall across it that leaves a door of 1 m.
  const roam::Mesh room{"room",
                        {{0, 0, 0},
                         {9, 0, 0},
                         {9, 5, 0},
                         {0, 5, 0},
                         {0, 0, 3},
                         {9, 0, 3},
                         {9, 5, 3},
                         {0, 5, 3},
                         {4, 0, 0},
                         {4, 2, 0},
                         {4, 2, 3},
                         {4, 0, 3},
                         {4, 3, 0},
                         {4, 5, 0},
                         {4, 5, 3},
                         {4, 3, 3}},
                        {{0, 1, 2},
                         {0, 2, 3},
                         {7, 6, 5},
                         {7, 5, 4},
                         {0, 4, 5},
                         {0, 5, 1},
                         {1, 5, 6},
                         {1, 6, 2},
                         {2, 6, 7},
                         {2, 7, 3},
                         {3, 7, 4},
                         {3, 4, 0},
                         {8, 9, 10},
                         {8, 10, 11},
                         {12, 13, 14},
                         {12, 14, 15}}};
  const roam_mesh mesh = c_rig::of(room);
  roam_survey* survey = nullptr;
  ASSERT_EQ(roam_survey_build(&mesh, 1, nullptr, &survey), ROAM_OK) << roam_error();

  roam_probe_options probe{};
  probe.size = sizeof probe;
  probe.from = {1, 2.5, 1};
  probe.to = {8, 2.5, 1};
  probe.radius = 0.3;
  probe.height = 1.8;
  roam_probe_answer answer{};
  answer.size = sizeof answer;
  roam_path* way = nullptr;
  ASSERT_EQ(roam_probe(survey, &probe, &answer, &way), ROAM_OK) << roam_error();
  EXPECT_EQ(answer.passable, 1);
  EXPECT_NEAR(answer.widest_radius, 0.5, 0.002);
  std::size_t points = 0;
  const roam_vec3* path = roam_path_points(way, &points);
  ASSERT_GE(points, 2u);
  EXPECT_NEAR(path[0].z, 0.9, 0.01);
  roam_path_free(way);

  probe.step = std::nan("");
  EXPECT_EQ(roam_probe(survey, &probe, &answer, nullptr), ROAM_INVALID);
  probe.step = -1.0;
  EXPECT_EQ(roam_probe(survey, &probe, &answer, nullptr), ROAM_OK) << roam_error();

  probe.radius = 0.6;
  ASSERT_EQ(roam_probe(survey, &probe, &answer, nullptr), ROAM_OK) << roam_error();
  EXPECT_EQ(answer.passable, 0);
  EXPECT_EQ(answer.limit, ROAM_LIMIT_DOOR);
  EXPECT_NEAR(answer.limit_size, 1.0, 0.004);
  probe.progress = [](double, void*) { return 1; };
  EXPECT_EQ(roam_probe(survey, &probe, &answer, nullptr), ROAM_CANCELLED);

  roam_train_options train{};
  train.size = sizeof train;
  train.height = 1.8;
  train.paths = 2;
  roam_training training{};
  training.size = sizeof training;
  roam_profile* profile = nullptr;
  ASSERT_EQ(roam_train(survey, &train, &training, &profile), ROAM_OK) << roam_error();
  EXPECT_EQ(training.complete, 1);
  EXPECT_EQ(training.feasible, 1);
  EXPECT_GT(training.places, 0u);

  const made::Folder folder("c_profile");
  const std::string file = (folder.path() / "room.obj.roam.json").string();
  ASSERT_EQ(roam_profile_save(profile, file.c_str()), ROAM_OK) << roam_error();
  roam_profile* loaded = nullptr;
  ASSERT_EQ(roam_profile_beside((folder.path() / "room.obj").c_str(), &loaded), ROAM_OK) << roam_error();
  roam_walker_settings settings = person();
  ASSERT_EQ(roam_profile_apply(loaded, &settings), ROAM_OK);
  EXPECT_EQ(settings.radius, training.radius);
  EXPECT_EQ(roam_profile_save(profile, (folder.path() / "none" / "x.json").c_str()), ROAM_NOT_FOUND);
  EXPECT_EQ(roam_profile_save(profile, ""), ROAM_UNREADABLE);
  roam_space* world = c_rig::built({room});
  roam_walker* walker = nullptr;
  ASSERT_EQ(roam_walker_create(world, &settings, ROAM_WALK, {1, 1, 0.9}, &walker), ROAM_OK) << roam_error();
  EXPECT_EQ(roam_walker_set_regions(walker, loaded), ROAM_OK);
  roam_walker_free(walker);
  roam_space_free(world);
  roam_profile_free(loaded);
  roam_profile_free(profile);
  train.progress = [](double, void*) { return 1; };
  EXPECT_EQ(roam_train(survey, &train, &training, nullptr), ROAM_CANCELLED);
  roam_survey_free(survey);
}

}  // namespace
