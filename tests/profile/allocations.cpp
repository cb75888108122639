// Where memory runs out, work with profiles throws and changes nothing. Loading and saving may end the program then:
// see docs/guarantees.md. Instrumented builds have an operator new of their own.
#include <gtest/gtest.h>

#include <optional>

#include "fallible_calls.h"
#include "profile_made.h"
#include "roam/size_learner.h"
#include "roam/store.h"
#include "roam/world.h"
#include "train_scenes.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

TEST(ProfileAllocations, CallsThrowWhereverOneFails) {
  const roam::Profile profile = made::full_profile();
  roam::Profile wrong = profile;
  wrong.regions[1].radius = -1.0;
  const std::array<std::filesystem::path, 2> scenes{"a folder with a long name/a.ply", "another folder/b.ply"};
  fail_calls({
      {"identity_of", [&] { return std::string(Bits() << roam::identity_of(made::scene()).hash); }},
      {"profile_path", [&] { return roam::profile_path(scenes).string(); }},
      {"check", [&] { return refusal_of([&] { roam::check(wrong); }); }},
      {"save_profile of a wrong one", [&] { return refusal_of([&] { save_profile(wrong, scenes[0]); }); }},
      {"load_profile of no file",
       [&] { return refusal_of([&] { static_cast<void>(roam::load_profile(scenes[0])); }); }},
      {"find_profile and find_frame of no file",
       [&] {
         return std::string(Bits() << roam::find_profile(scenes).has_value() << roam::find_frame(scenes).has_value());
       }},
  });
}

TEST(ProfileAllocations, ALessonIsLearnedWhereverOneFailsOrNot) {
  const roam::Mesh mesh = corridor_mesh({.door = 0.6});
  const roam::World world = roam::World::build({&mesh, 1});
  const roam::WalkerSettings person{.radius = 0.4, .height = 1.8};
  const roam::Vec3 wish(1.4, 0.0, 0.0);
  roam::Profile known;
  known.radius = person.radius;
  known.height = person.height;
  roam::Walker walker(world, person, roam::Mode::walk, {1.0, 0.0, 0.91});
  roam::SizeLearner learner(known), before = learner;
  for (std::optional<roam::Lesson> lesson; !lesson;) {
    ASSERT_LT(walker.position().x, 9.0);
    walker.step({.velocity = wish}, 1.0 / 60.0);
    before = learner;
    lesson = learner.watch(walker, wish, 1.0 / 60.0);
  }
  fail_calls({{"watch and take", [&] {
                 roam::Walker body(walker);
                 roam::SizeLearner learned(before);
                 if (const auto lesson = learned.watch(body, wish, 1.0 / 60.0)) learned.take(body, *lesson);
                 return std::string(Bits() << body.position() << learned.profile().regions.size()
                                           << learned.profile().regions.at(0).radius);
               }}});
}

}  // namespace
#endif
