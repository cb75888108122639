// The mark by which roam knows what it made.
#include "files/mark.h"

#include <gtest/gtest.h>

#include "program.h"

namespace {

using roam::files::is_marked;

TEST(Mark, IsFoundAtBothEndsOfAFile) {
  const TestFolder folder;
  const std::string words(roam::files::mark), much(5 << 20, ' '), some(1 << 20, ' ');
  EXPECT_TRUE(is_marked(folder.write("start", words + much)));
  EXPECT_TRUE(is_marked(folder.write("behind an index", some + words + much)));
  EXPECT_TRUE(is_marked(folder.write("end", much + words + " ")));
  EXPECT_TRUE(is_marked(folder.write("empty", "")));
  EXPECT_FALSE(is_marked(folder.write("none", much)));
  EXPECT_FALSE(is_marked(folder.write("short", "made")));
  EXPECT_FALSE(is_marked(folder.file("absent")));
}

TEST(Mark, LeavesBytesThatAreNoPictureAsTheyAre) {
  using namespace std::string_literals;
  for (const std::string& bytes : {""s, "words"s, "\xff\xd8\xff\xe0\xff\xff"s, "\xff\xd8\xff\xe0\xff\xff_"s, "<?xml "s,
                                   "\x89PNG\r\n\x1a\n"s, "0\nSECTION\n"s}) {
    std::string after = bytes;
    roam::files::add_mark(after);
    EXPECT_EQ(after, bytes);
  }
}

TEST(Mark, IsAddedToFilmsThatAreWholeAlone) {
  const TestFolder folder;
  for (const std::string& bytes : {std::string(), std::string("GIF89a, cut off"), std::string("RIFF")}) {
    roam::files::WholeFile film(folder.file("film"));
    film.write(std::as_bytes(std::span(bytes)));
    roam::files::add_mark(film);
    film.commit();
    EXPECT_EQ(folder.read("film"), bytes);
  }
}

}  // namespace
