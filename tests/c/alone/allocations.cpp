// Where memory runs out, each function of the C interface returns ROAM_NO_MEMORY, writes no result, and works again
// when there is memory. Instrumented builds have an operator new of their own.
#include <gtest/gtest.h>

#include <cstring>

#include "c_rig.h"
#include "fallible_calls.h"
#include "profile_made.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

using roam::Vec3;

/// Throws as C++ would.
void must(roam_status status) {
  if (status == ROAM_NO_MEMORY) throw std::bad_alloc();
  const Spare spare;
  const std::string why = std::to_string(status) + ": " + roam_error();
  if (status != ROAM_OK) throw roam::Error(why);
}

/// The bits of the status and of the sentence of a refused call.
std::string status_and_text(roam_status status) {
  if (status == ROAM_NO_MEMORY) throw std::bad_alloc();
  return Bits() << status << roam_error();
}

template <class T>
T sized() {
  T it{};
  it.size = sizeof it;
  return it;
}

/// A handle that is freed in the end. A function that fails leaves it null.
template <class T, void (*Free)(T*)>
struct Handle {
  Handle() = default;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { Free(it); }
  void made(roam_status status) {
    EXPECT_EQ(it != nullptr, status == ROAM_OK);
    must(status);
  }
  T* it = nullptr;
};
using SpaceHandle = Handle<roam_space, roam_space_free>;
using WalkerHandle = Handle<roam_walker, roam_walker_free>;
using SurveyHandle = Handle<roam_survey, roam_survey_free>;
using ProfileHandle = Handle<roam_profile, roam_profile_free>;
using PathHandle = Handle<roam_path, roam_path_free>;

std::string bits_of(const roam_impact& impact) {
  return Bits() << impact.time << impact.gap << impact.triangle << impact.hit << impact.unknown;
}

std::string sweep_of(const roam_space* space) {
  auto query = sized<roam_query>();
  query.radius = 0.3;
  query.from = {1, 0, 1};
  query.motion = {9, 1, 0};
  auto impact = sized<roam_impact>();
  must(roam_sweep(space, &query, &impact));
  return bits_of(impact);
}

class CAllocations : public testing::Test {
 protected:
  CAllocations() {
    meshes_.reserve(2);
    for (const roam::Mesh& mesh : kept_) meshes_.push_back(c_rig::of(mesh));
    settings_.size = sizeof settings_;
    EXPECT_EQ(roam_walker_person(&settings_, 0.3, 1.8), ROAM_OK);
  }

  const std::vector<roam::Mesh> kept_ = c_rig::room_meshes();
  std::vector<roam_mesh> meshes_;
  roam_walker_settings settings_{};
  const c_rig::Room room_;
};

TEST_F(CAllocations, OfSpaces) {
  const std::string file = room_.file("room.obj");
  SpaceHandle filtered;
  filtered.made(roam_filtered_create(room_.handle, &filtered.it));
  const std::uint32_t wall = 1;
  fail_calls({
      {"roam_world_build",
       [&] {
         SpaceHandle world;
         world.made(roam_world_build(meshes_.data(), meshes_.size(), nullptr, &world.it));
         return sweep_of(world.it);
       }},
      {.name = "roam_world_open",
       .bits =
           [&] {
             SpaceHandle world;
             world.made(roam_world_open(file.c_str(), nullptr, &world.it));
             return sweep_of(world.it);
           },
       .dense = 16,
       .steps = 8},
      {"roam_world_open of no file",
       [&] {
         SpaceHandle world;
         return status_and_text(roam_world_open("/nowhere/there/is/a/house.obj", nullptr, &world.it));
       }},
      {"roam_filtered_create",
       [&] {
         SpaceHandle some;
         some.made(roam_filtered_create(room_.handle, &some.it));
         must(roam_filtered_ignore_only(some.it, &wall, 1));
         return sweep_of(some.it);
       }},
      {"roam_filtered_ignore_only",
       [&] {
         must(roam_filtered_ignore_only(filtered.it, &wall, 1));
         return std::string("done");
       },
       [&](bool failed) {
         auto query = sized<roam_query>();
         query.from = {1, 0, 1};
         query.motion = {9, 1, 0};
         auto impact = sized<roam_impact>();
         must(roam_sweep(filtered.it, &query, &impact));
         EXPECT_EQ(impact.hit, failed ? 1 : 0);
         must(roam_filtered_ignore_only(filtered.it, nullptr, 0));
       }},
      {"roam_sweep of no query",
       [&] {
         auto impact = sized<roam_impact>();
         return status_and_text(roam_sweep(room_.handle, nullptr, &impact));
       }},
      {"roam_contacts",
       [&] {
         auto query = sized<roam_query>();
         query.radius = 0.3;
         query.from = {4, 0, 1};
         roam_contact contacts[5]{};
         contacts[0].size = sizeof contacts[0];
         std::size_t count = 0;
         must(roam_contacts(room_.handle, &query, 9.0, contacts, 5, &count));
         return std::string(Bits() << count << contacts[0].gap << contacts[1].gap);
       }},
  });
}

TEST_F(CAllocations, OfBatches) {
  std::vector<double> from, motion, radius;
  for (int i = 0; i < 500; ++i) {
    from.insert(from.end(), {1.0 + 0.005 * i, 0.0, 1.0});
    motion.insert(motion.end(), {9.0, 0.01 * i, 0.0});
    radius.push_back(i == 300 ? 5000.0 : 0.3);
  }
  std::size_t most = 4;
  std::vector<double> times(500);
  std::vector<std::uint64_t> found(500);
  const auto batch = [&](bool wrong) {
    auto it = sized<roam_batch>();
    it.count = 500;
    it.from = {from.data(), 24};
    it.motion = {motion.data(), 24};
    it.radius = {wrong ? radius.data() : &radius[0], wrong ? 8 : 0};
    it.reach = 5.0;
    it.most = ++most;  // each thread keeps room for as many as ever
    it.time = {times.data(), 8};
    return it;
  };
  fail_calls({
      {"roam_contacts_batch",
       [&] {
         auto it = batch(false);
         it.time = {};
         it.found = {found.data(), 8};
         must(roam_contacts_batch(room_.handle, &it));
         return std::string(Bits() << found[0] << found[499]);
       }},
      {"roam_sweep_batch with a wrong query",
       [&] {
         const auto it = batch(true);
         return status_and_text(roam_sweep_batch(room_.handle, &it));
       }},
  });
}

TEST_F(CAllocations, OfWalkers) {
  WalkerHandle walker;
  walker.made(roam_walker_create(room_.handle, &settings_, ROAM_WALK, {1, 0, 1}, &walker.it));
  const roam_vec3 path[] = {{1, 0, 0.9}, {3, 2, 0.9}, {8, 0, 0.9}};
  const auto place_of = [](const roam_walker* of) {
    auto state = sized<roam_walker_state>();
    must(roam_walker_get_state(of, &state));
    return std::string(Bits() << state.position.x << state.position.y << state.position.z << state.held);
  };
  fail_calls({
      {"roam_walker_create and _copy",
       [&] {
         WalkerHandle some, copy;
         some.made(roam_walker_create(room_.handle, &settings_, ROAM_WALK, {2, 0, 1}, &some.it));
         copy.made(roam_walker_copy(some.it, &copy.it));
         return place_of(copy.it);
       }},
      {"roam_walker_step with a wrong time",
       [&] {
         const auto input = sized<roam_walker_input>();
         return status_and_text(roam_walker_step(walker.it, &input, -1.0, nullptr));
       }},
      {"roam_route_follow",
       [&] {
         auto result = sized<roam_route_result>();
         must(roam_route_follow(walker.it, path, 3, nullptr, &result));
         return std::string(Bits() << result.outcome << result.steps << result.length << result.least_gap);
       },
       [&](bool) { must(roam_walker_place(walker.it, path[0], nullptr)); }},
  });
}

TEST_F(CAllocations, OfStores) {
  const made::Folder folder("c_allocations");
  made::store(folder.path(), kept_);
  const std::string name = folder.path().string();
  auto options = sized<roam_store_options>();
  options.memory = 8 << 20;
  auto query = sized<roam_query>();
  query.radius = 0.3;
  query.from = {1, 0, 1};
  query.motion = {9, 1, 0};
  fail_calls({
      {.name = "roam_store_open",
       .bits =
           [&] {
             SpaceHandle store;
             store.made(roam_store_open(name.c_str(), &options, &store.it));
             failing_allocation = 0;  // a loading thread tries again, for as long as it takes
             std::int32_t complete = 0;
             must(roam_space_load(store.it, &query, 20.0, nullptr, nullptr, &complete));
             EXPECT_EQ(complete, 1);
             return sweep_of(store.it);
           }},
      {"roam_store_open of no store",
       [&] {
         SpaceHandle store;
         return status_and_text(roam_store_open("/nowhere/there/is/a/house.roam", nullptr, &store.it));
       }},
  });
}

TEST_F(CAllocations, OfProfiles) {
  // Loading and saving end the program if nothing is left to free JSON with: docs/guarantees.md.
  const made::Folder folder("c_allocations");
  const std::string file = (folder.path() / "room.obj.roam.json").string();
  save_profile(made::full_profile(), file);
  ProfileHandle profile;
  profile.made(roam_profile_load(file.c_str(), &profile.it));
  WalkerHandle walker;
  walker.made(roam_walker_create(room_.handle, &settings_, ROAM_WALK, {1, 0, 1}, &walker.it));
  fail_calls({
      {"roam_walker_set_regions",
       [&] {
         must(roam_walker_set_regions(walker.it, profile.it));
         return std::string();
       }},
      {"roam_profile_load of no file",
       [&] {
         ProfileHandle some;
         return status_and_text(roam_profile_load("/nowhere/there/is/a/profile.json", &some.it));
       }},
      {"roam_profile_beside no scene",
       [&] {
         ProfileHandle some;
         return status_and_text(roam_profile_beside("/nowhere/there/is/a/scene.obj", &some.it));
       }},
      {"roam_profile_save of none",
       [&] { return status_and_text(roam_profile_save(nullptr, "/nowhere/there/is/a/profile.json")); }},
  });
}

TEST_F(CAllocations, OfSurveys) {
  SurveyHandle survey;
  survey.made(roam_survey_build(meshes_.data(), meshes_.size(), nullptr, &survey.it));
  auto probe = sized<roam_probe_options>();
  probe.from = {1, 0, 1};
  probe.to = {3, 2, 1};
  probe.radius = 0.3;
  probe.height = 1.8;
  probe.spacing = 0.4;
  auto train = sized<roam_train_options>();
  train.height = 1.8;
  train.paths = 1;
  train.spacing = 0.5;
  fail_calls({
      {"roam_survey_build",
       [&] {
         SurveyHandle some;
         some.made(roam_survey_build(meshes_.data(), meshes_.size(), nullptr, &some.it));
         return std::string("built");
       }},
      {.name = "roam_probe",
       .bits =
           [&] {
             auto answer = sized<roam_probe_answer>();
             PathHandle way;
             way.made(roam_probe(survey.it, &probe, &answer, &way.it));
             std::size_t count = 0;
             const roam_vec3* points = roam_path_points(way.it, &count);
             Bits bits;
             bits << answer.passable << answer.widest_radius << answer.length << count;
             for (std::size_t i = 0; i < count; ++i) bits << points[i].x << points[i].y << points[i].z;
             return std::string(bits);
           },
       .later = true,
       .dense = 40,
       .steps = 8},
      {.name = "roam_train",
       .bits =
           [&] {
             auto training = sized<roam_training>();
             ProfileHandle profile;
             profile.made(roam_train(survey.it, &train, &training, &profile.it));
             return std::string(Bits() << training.radius << training.largest << training.smallest << training.paths
                                       << training.places << training.feasible << training.complete);
           },
       .later = true,
       .dense = 20,
       .steps = 4},
  });
}

}  // namespace
#endif
