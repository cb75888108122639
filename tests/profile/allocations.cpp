// Where memory runs out, work with profiles throws and changes nothing. Loading and saving may end the program then:
// see docs/guarantees.md. Instrumented builds have an operator new of their own.
#include <gtest/gtest.h>

#include "fallible_calls.h"
#include "profile_made.h"
#include "roam/store.h"

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

}  // namespace
#endif
