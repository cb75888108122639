// Pages of the manual: the program writes them from its help.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>

#include "helps.h"
#include "messages.h"
#include "process/find_program.h"
#include "program.h"

namespace {

struct Written {
  TestFolder folder;
  std::vector<std::string> pages;  ///< files

  Written() {
    const ProgramResult result = run_program(ROAM_PROGRAM, {"reference", folder.file("share")});
    EXPECT_EQ(result.status, 0) << result.err;
    for (const auto& entry : std::filesystem::directory_iterator(folder.file("share/man/man1"))) {
      pages.push_back(entry.path().string());
    }
  }
  [[nodiscard]] std::string page(std::string verb) const {
    std::replace(verb.begin(), verb.end(), ' ', '-');
    return folder.read("share/man/man1/" + verb + ".1");
  }
};

/// Letters and digits only, in lower case.
std::string squeezed(const std::string& text) {
  std::string out;
  for (const unsigned char c : text) {
    if (std::isalnum(c) != 0) out += static_cast<char>(std::tolower(c));
  }
  return out;
}

/// The text of a page without the requests and escapes of troff.
std::string text_of(const std::string& page) {
  std::string text;
  for (std::string line : lines_of(page)) {
    const bool heading = line.starts_with(".SH ") || line.starts_with(".SS ");
    if (line.starts_with('.') && !heading) continue;
    if (heading) line.erase(0, 4);
    for (const char* escape : {"\\fB", "\\fI", "\\fP", "\\(aq", "\\(ha", "\\(ti", "\\e", "\\&"}) {
      for (std::size_t at = line.find(escape); at != std::string::npos; at = line.find(escape)) {
        line.erase(at, std::string(escape).size());
      }
    }
    text += line + "\n";
  }
  return text;
}

TEST(Manual, HasAPageWithEveryLineOfHelp) {
  const Written written;
  const std::vector<Help> helps = all_helps();
  EXPECT_EQ(written.pages.size(), helps.size());
  for (const Help& help : helps) {
    const std::string text = squeezed(text_of(written.page(help.verb)));
    for (const std::string& line : lines_of(help.text)) {
      const bool usage = line.starts_with("Usage: ");
      EXPECT_TRUE(contains(text, squeezed(usage ? line.substr(7) : line))) << help.verb << ": " << line;
    }
  }
}

TEST(Manual, NamesVersionDayAndTheOtherPages) {
  ::setenv("SOURCE_DATE_EPOCH", "1767225600", 1);
  const Written written;
  ::unsetenv("SOURCE_DATE_EPOCH");
  const std::string make = written.page("roam make");
  EXPECT_TRUE(contains(make, ".TH ROAM\\-MAKE 1 2026-01-01 \"roam " ROAM_PACKAGE_VERSION "\"\n")) << make;
  EXPECT_TRUE(contains(make, "roam\\-make \\- make a demo scene")) << make;
  const std::size_t also = make.find(".SH \"SEE ALSO\"");
  ASSERT_NE(also, std::string::npos);
  EXPECT_EQ(make.substr(also),
            ".SH \"SEE ALSO\"\n\\fBroam\\fP(1),\n\\fBroam\\-make\\-gallery\\fP(1),\n"
            "\\fBroam\\-make\\-terrain\\fP(1),\n\\fBroam\\-make\\-city\\fP(1)\n");
  EXPECT_TRUE(contains(written.page("roam"), "\\fBroam\\-view\\fP(1)"));
  EXPECT_TRUE(contains(written.page("roam make city"), "\\fBroam\\-make\\fP(1)"));
}

TEST(Manual, KeepsDashesAndQuotesThatCanBeCopied) {
  const Written written;
  EXPECT_TRUE(contains(written.page("roam view"), "(aqz<2.5\\(aq"));
  EXPECT_TRUE(contains(written.page("roam walk"), "\\fB\\-\\-wander\\fP \\fIS\\fP\n"));
  EXPECT_TRUE(contains(written.page("roam walk"), "  roam walk mine.dae \\-\\-path tour.path\n"));
}

TEST(Manual, IsHiddenFromHelpAndGuesses) {
  EXPECT_FALSE(contains(help_of({}), "reference"));
  EXPECT_FALSE(contains(run_program(ROAM_PROGRAM, {"referenc"}).err, "reference"));
}

TEST(Manual, HasNothingThatMandocComplainsOf) {
  const std::string mandoc = roam::process::find_program("mandoc").string();
  if (mandoc.empty()) GTEST_SKIP() << "there is no mandoc";
  const Written written;
  std::vector<std::string> arguments = {"-Tlint", "-Wwarning"};
  arguments.insert(arguments.end(), written.pages.begin(), written.pages.end());
  const ProgramResult result = run_program(mandoc, arguments);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST(Manual, HasNothingThatManWarnsOf) {
  const std::string man = roam::process::find_program("man").string();
  if (man.empty()) GTEST_SKIP() << "there is no man";
  const Written written;
  for (const std::string& page : written.pages) {
    const ProgramResult result = run_program(man, {"--warnings", "-E", "UTF-8", "-l", "-Tutf8", page});
    if (result.status == 127 || contains(result.err, "nroff")) GTEST_SKIP() << result.err;
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "") << page;
    EXPECT_TRUE(contains(result.out, "roam " ROAM_PACKAGE_VERSION)) << result.out;
  }
}

}  // namespace
