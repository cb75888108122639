// Help of every verb: short lines, plain words, examples, and nothing of the parser's own language.
#include "cli/help.h"

#include <gtest/gtest.h>

#include "helps.h"
#include "messages.h"

namespace {

TEST(Help, FitsInAHundredColumns) {
  for (const Help& help : all_helps()) {
    for (const std::string& line : lines_of(help.text)) EXPECT_LE(line.size(), 100u) << help.verb << ": " << line;
  }
}

TEST(Help, ShowsNamesOfValuesAndNoRulesOfTheParser) {
  for (const Help& help : all_helps()) {
    for (const char* remnant :
         {":{", "[Option Group", "Needs:", "Excludes:", " x 3", "=1024b", "REQUIRED", "SUBCOMMAND", "Positionals",
          "POSITIVE", "UINT", "FLOAT", "TEXT", "m|cm", "--no-scene-link"}) {
      EXPECT_FALSE(contains(help.text, remnant)) << help.verb << ": " << remnant;
    }
  }
}

TEST(Help, UsesPlainWords) {
  for (const Help& help : all_helps()) {
    for (const char* word : {" told", " asked", "foot ", "foot,", "foot;", " haunt"}) {
      const std::size_t at = help.text.find(word);
      const bool on_foot = at != std::string::npos && at >= 3 && help.text.substr(at - 3, 3) == "on ";
      EXPECT_TRUE(at == std::string::npos || on_foot) << help.verb << ": " << word;
    }
  }
}

TEST(Help, EndsWithExamplesOfTheVerb) {
  for (const Help& help : all_helps()) {
    const std::size_t at = help.text.find("\nExamples:\n");
    ASSERT_NE(at, std::string::npos) << help.verb;
    const std::vector<std::string> examples = lines_of(help.text.substr(at + 11));
    EXPECT_FALSE(examples.empty()) << help.verb;
    for (const std::string& line : examples) {
      EXPECT_TRUE(line.starts_with("  ") && contains(line, help.verb)) << help.verb << ": " << line;
    }
  }
}

TEST(Help, GroupsOptionsByPurpose) {
  const std::string walk = help_of({"walk"});
  std::size_t last = 0;
  for (const char* group : {"\nWay:\n", "\nBody, in metres:\n", "\nResults:\n", "\nScene:\n", "\nOther:\n"}) {
    const std::size_t at = walk.find(group);
    ASSERT_NE(at, std::string::npos) << group;
    EXPECT_GT(at, last) << group;
    last = at;
  }
  EXPECT_TRUE(contains(walk, "Usage: roam walk SCENE... [OPTIONS]\n")) << walk;
  EXPECT_TRUE(contains(walk, "  --up AXIS  ")) << walk;
  EXPECT_TRUE(contains(help_of({"probe"}), "Usage: roam probe SCENE... --from X,Y,Z --to X,Y,Z [OPTIONS]\n"));
}

TEST(Help, FillsParagraphs) {
  using roam::app::filled;
  EXPECT_EQ(filled("one two three", 7), "one two\nthree");
  EXPECT_EQ(filled("one two three", 7, 2), "one\n  two\n  three");
  EXPECT_EQ(filled("a\nb\n\nc", 20), "a b\n\nc");
  EXPECT_EQ(filled("Examples:\n  as it is\n", 8), "Examples:\n  as it is\n");
}

}  // namespace
