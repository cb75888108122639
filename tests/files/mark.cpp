// The mark by which roam knows what it made.
#include "files/mark.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include "program.h"

namespace {

bool is_marked(const std::string& file) {
  const roam::files::Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  return roam::files::marked("").has(opened.number());
}

TEST(Mark, CountsOnlyAtThePlaceOfTheFormat) {
  using namespace std::string_literals;
  const TestFolder folder;
  const std::string words(roam::files::mark), some(1 << 20, ' '), much(5 << 20, ' ');
  const std::string xml = "<?xml version=\"1.0\"?>\n", gif = "GIF89a, pictures", comment = "\x21\xfe\x0c" + words;
  EXPECT_TRUE(is_marked(folder.write("a.obj", "# " + words + "; metres\nv 0 0 0\n")));
  EXPECT_TRUE(is_marked(folder.write("a.dxf", "999\n" + words + "\n0\nSECTION\n")));
  EXPECT_TRUE(is_marked(folder.write("a.svg", xml + "<!-- " + words + " -->\n<svg/>")));
  EXPECT_TRUE(is_marked(folder.write("a.gif", gif + comment + "\0;"s)));
  EXPECT_TRUE(is_marked(folder.write("a.mp4",
                                     "\0\0\0\x20"
                                     "ftypisom"s +
                                         some + words + much)));
  EXPECT_TRUE(is_marked(folder.write("empty", "")));
  EXPECT_FALSE(is_marked(folder.write("b.obj", "# Blender\n# " + words + "; metres\nv 0 0 0\n")));
  EXPECT_FALSE(is_marked(folder.write("b.svg", xml + "<svg/><!-- " + words + " -->\n")));
  EXPECT_FALSE(is_marked(folder.write("b.gif", gif + comment + "\0,;"s)));
  EXPECT_FALSE(is_marked(folder.write("b.mp4",
                                      "\0\0\0\x20"
                                      "ftypisom"s +
                                          much + words)));
  EXPECT_FALSE(is_marked(folder.write("words", words)));
  EXPECT_FALSE(is_marked(folder.write("RIFF", "RIFF")));
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
