// Errors and the place that they name.

#include "roam/error.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <type_traits>

namespace {

using roam::Error;

TEST(Error, BeginsWithItsPlace) {
  const Error error("house.obj:3", "'oops' is no number");
  EXPECT_STREQ(error.what(), "house.obj:3: 'oops' is no number");
  EXPECT_EQ(error.where(), "house.obj:3");
  EXPECT_EQ(error.reason(), "'oops' is no number");
}

TEST(Error, MayNameItsPlaceWithinTheSentence) {
  const std::string sentence = "cannot read house.obj: No such file or directory";
  const Error error = Error::at("house.obj", sentence);
  EXPECT_EQ(error.what(), sentence);
  EXPECT_EQ(error.where(), "house.obj");
  EXPECT_EQ(error.reason(), sentence);
  EXPECT_EQ(Error::at("house.obj", "house.obj: it is empty").reason(), "it is empty");
  EXPECT_EQ(Error::at("house.obj", "house.obj is empty").reason(), "house.obj is empty");
}

TEST(Error, NeedsNoPlace) {
  for (const Error& error : {Error("out of memory"), Error("", "out of memory"), Error::at("", "out of memory")}) {
    EXPECT_STREQ(error.what(), "out of memory");
    EXPECT_EQ(error.where(), "");
    EXPECT_EQ(error.reason(), "out of memory");
  }
}

TEST(Error, KeepsItsPlaceInACopy) {
  static_assert(std::is_nothrow_copy_constructible_v<Error> && std::is_nothrow_copy_assignable_v<Error>);
  std::optional<Error> first(std::in_place, "--radius", "'abc' is not a number");
  const Error copy = *first;
  first.reset();
  EXPECT_EQ(copy.where(), "--radius");
  EXPECT_EQ(copy.reason(), "'abc' is not a number");
}

}  // namespace
