// Text of files as a terminal sees it.

#include "text/printable.h"

#include <gtest/gtest.h>

#include <string>

namespace {

using roam::printable;

const std::string bad = "\xEF\xBF\xBD", dots = "\xE2\x80\xA6";

TEST(Printable, LeavesTextAsItIs) {
  EXPECT_EQ(printable("Wand 3, Stra\xC3\x9F"
                      "e \xE5\xA2\x99 \xF0\x9F\x8F\xA0"),
            "Wand 3, Stra\xC3\x9F"
            "e \xE5\xA2\x99 \xF0\x9F\x8F\xA0");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, ShowsNoControl) {
  EXPECT_EQ(printable("a\x1B]0;title\x07z"), "a" + bad + "]0;title" + bad + "z");
  EXPECT_EQ(printable(std::string("a\0z", 3)), "a" + bad + "z");
  EXPECT_EQ(printable("a\x7Fz"), "a" + bad + "z");
  EXPECT_EQ(printable("one\ntwo\r\tthree"), "one two  three");
  for (int c = 0; c < 256; ++c) {
    for (const char shown : printable(std::string(1, static_cast<char>(c)))) {
      EXPECT_TRUE(static_cast<unsigned char>(shown) >= 0x20 && shown != 0x7F) << c;
    }
  }
}

TEST(Printable, ShowsNoControlOfUnicode) {
  EXPECT_EQ(printable("a\xC2\x9B"
                      "2Jz"),
            "a" + bad + "2Jz");                                               // C1: CSI
  EXPECT_EQ(printable("a\xC2\x85z"), "a z");                                  // C1: next line
  EXPECT_EQ(printable("a\xE2\x80\xA8z"), "a z");                              // line separator
  EXPECT_EQ(printable("a\xE2\x80\xAEz"), "a" + bad + "z");                    // right-to-left override
  EXPECT_EQ(printable("a\xE2\x81\xA6z"), "a" + bad + "z");                    // left-to-right isolate
  EXPECT_EQ(printable("a\xD8\x9Cz"), "a" + bad + "z");                        // Arabic letter mark
  EXPECT_EQ(printable("a\xE2\x80\x8F\xE2\x80\x8Ez"), "a" + bad + bad + "z");  // marks
}

TEST(Printable, ShowsNothingInvisible) {
  for (const char* c :
       {"\xC2\xAD", "\xE2\x80\x8B", "\xE2\x81\xA0", "\xEF\xBB\xBF", "\xEF\xBF\xB9", "\xF3\xA0\x81\x81"}) {
    EXPECT_EQ(printable(std::string("a") + c + "z"), "a" + bad + "z") << c;
  }
}

TEST(Printable, ReplacesNoncharacters) {
  for (const char* c :
       {"\xEF\xBF\xBE", "\xEF\xBF\xBF", "\xEF\xB7\x90", "\xEF\xB7\xAF", "\xF0\x9F\xBF\xBE", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_EQ(printable(std::string("a") + c + "z"), "a" + bad + "z") << c;
  }
  EXPECT_EQ(printable("\xEF\xBF\xBD\xEF\xB7\xB0"), "\xEF\xBF\xBD\xEF\xB7\xB0");
}

TEST(Printable, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(printable("a\xFFz"), "a" + bad + "z");
  EXPECT_EQ(printable("a\x9Bz"), "a" + bad + "z");                                // a lone continuation
  EXPECT_EQ(printable("a\xC3"), "a" + bad);                                       // cut short
  EXPECT_EQ(printable("a\xC0\x9Bz"), "a" + bad + bad + "z");                      // a long way to write a control
  EXPECT_EQ(printable("a\xED\xA0\x80z"), "a" + bad + bad + bad + "z");            // half a pair
  EXPECT_EQ(printable("a\xF4\x90\x80\x80z"), "a" + bad + bad + bad + bad + "z");  // beyond Unicode
}

TEST(Printable, ShortensInTheMiddle) {
  EXPECT_EQ(printable("0123456789", 10), "0123456789");
  EXPECT_EQ(printable("0123456789A", 10), "01234" + dots + "789A");
  EXPECT_EQ(printable("0123456789A", 5), "01" + dots + "9A");
  const std::string umlauts = printable(std::string(70000, 'x') + "\xC3\xA4\xC3\xB6\xC3\xBC");
  EXPECT_EQ(umlauts, std::string(60, 'x') + dots + std::string(56, 'x') + "\xC3\xA4\xC3\xB6\xC3\xBC");
}

}  // namespace
