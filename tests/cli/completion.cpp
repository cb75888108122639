// Completion of command lines in bash, zsh and fish: the program writes a script for each from its help.
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

#include "helps.h"
#include "process/find_program.h"
#include "program.h"

namespace {

using Completions = std::set<std::string>;

/// A folder with scenes, a store and other files, and the scripts.
class Stage {
 public:
  Stage() {
    const ProgramResult result = run_program(ROAM_PROGRAM, {"reference", folder_.file("share")});
    EXPECT_EQ(result.status, 0) << result.err;
    for (const char* name : {"house.obj", "mine.GLB", "two words.ply", "tour.path", "notes.txt", "plan.svg"}) {
      folder_.write(name, "");
    }
    std::filesystem::create_directory(folder_.file("dam.roam"));
  }
  [[nodiscard]] std::string script(const std::string& name) const { return folder_.file("share/" + name); }
  [[nodiscard]] std::string path() const { return folder_.file(""); }

 private:
  TestFolder folder_;
};

/// The completions that `shell` writes, one a line, without what follows a tab, and without quoting.
Completions completions(const std::string& shell, const std::vector<std::string>& arguments) {
  const ProgramResult result = run_program(shell, arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  Completions words;
  for (std::string line : lines_of(result.out)) {
    line = line.substr(0, line.find('\t'));
    std::erase(line, '\\');
    std::erase(line, '\r');
    if (line.ends_with('/')) line.pop_back();
    if (!line.empty()) words.insert(line);
  }
  return words;
}

/// A shell, how it runs a script, and the program's script for it, in the stage.
struct Shell {
  const char* name;
  const char* program;
  std::vector<std::string> options;
  const char* script;
  const char* package = "";  ///< sourced before
};

const Shell shells[] = {
    {"bash", "bash", {"--norc"}, "bash-completion/completions/roam"},
    {"bash_completion",
     "bash",
     {"--norc"},
     "bash-completion/completions/roam",
     "/usr/share/bash-completion/bash_completion"},
    {"zsh", "zsh", {"-f"}, "zsh/site-functions/_roam"},
    {"fish", "fish", {"--no-config"}, "fish/vendor_completions.d/roam.fish"},
};

class Completion : public testing::TestWithParam<Shell> {
 protected:
  void SetUp() override {
    program_ = roam::process::find_program(GetParam().program).string();
    if (program_.empty()) GTEST_SKIP() << "there is no " << GetParam().program;
    const std::string package = GetParam().package;
    if (!package.empty() && !std::filesystem::exists(package)) GTEST_SKIP() << "there is no " << package;
    ::setenv("BASH_COMPLETION", package.c_str(), 1);
  }
  /// The completions of the last word; the first is "roam".
  [[nodiscard]] Completions complete(const std::vector<std::string>& words) const {
    std::vector<std::string> arguments = GetParam().options;
    arguments.push_back(std::string(TEST_PROGRAMS "/complete.") + GetParam().program);
    arguments.push_back(stage_.path());
    arguments.push_back(stage_.script(GetParam().script));
    arguments.insert(arguments.end(), words.begin(), words.end());
    return completions(program_, arguments);
  }

  Stage stage_;
  std::string program_;
};

TEST_P(Completion, OffersVerbsAndKinds) {
  const std::vector<std::string> verbs = names_in(help_of({}));
  Completions expected(verbs.begin(), verbs.end());
  expected.insert("help");
  EXPECT_EQ(complete({"roam", ""}), expected);
  EXPECT_EQ(complete({"roam", "wa"}), Completions{"walk"});
  EXPECT_EQ(complete({"roam", "make", ""}), (Completions{"gallery", "terrain", "city"}));
  EXPECT_EQ(complete({"roam", "help", "wa"}), Completions{"walk"});
}

TEST_P(Completion, OffersEveryOptionOfTheVerb) {
  for (const Help& help : all_helps()) {
    std::istringstream parts(help.verb);
    std::vector<std::string> words{std::istream_iterator<std::string>(parts), {}};
    if (words.size() == 1) continue;
    words.emplace_back("--");
    Completions options;
    for (const std::string& line : lines_of(help.text)) {
      const std::size_t at = line.find("--");
      // "  --up AXIS" or "  -o, --output FILE"
      if (at == 2 || (at == 6 && line.starts_with("  -"))) options.insert(line.substr(at, line.find(' ', at) - at));
    }
    Completions offered = complete(words);
    std::erase_if(offered, [](const std::string& word) { return !word.starts_with("--"); });
    EXPECT_EQ(offered, options) << help.verb;
  }
}

TEST_P(Completion, OffersTheValuesOfAnOption) {
  EXPECT_EQ(complete({"roam", "walk", "house.obj", "--mode", ""}), (Completions{"fly", "walk", "ghost"}));
  EXPECT_EQ(complete({"roam", "probe", "--mode", ""}), (Completions{"fly", "walk"}));
  EXPECT_EQ(complete({"roam", "info", "--unit", "m"}), (Completions{"m", "mm"}));
  EXPECT_EQ(complete({"roam", "walk", "--radius", ""}), Completions{});
}

TEST_P(Completion, OffersFilesByTheirEndings) {
  EXPECT_EQ(complete({"roam", "view", ""}),
            (Completions{"house.obj", "mine.GLB", "two words.ply", "dam.roam", "share"}));
  EXPECT_EQ(complete({"roam", "view", "--fullscreen", "hou"}), Completions{"house.obj"});
  EXPECT_EQ(complete({"roam", "walk", "--picture", ""}), (Completions{"plan.svg", "dam.roam", "share"}));
  EXPECT_EQ(complete({"roam", "walk", "--path", "t"}), (Completions{"tour.path", "two words.ply"}));
  EXPECT_EQ(complete({"roam", "verify", ""}), (Completions{"dam.roam", "share"}));
  EXPECT_EQ(complete({"roam", "view", "--store", "d"}), Completions{"dam.roam"});
}

// Readline makes three words of --up=-y.
TEST_P(Completion, TakesValuesAfterAnEqualSign) {
  const bool bash = std::string(GetParam().program) == "bash";
  const std::vector<std::string> up =
      bash ? std::vector<std::string>{"--up", "=", "-"} : std::vector<std::string>{"--up=-"};
  std::vector<std::string> words = {"roam", "walk"};
  words.insert(words.end(), up.begin(), up.end());
  Completions plain;
  for (const std::string& word : complete(words)) plain.insert(word.substr(word.find('=') + 1));
  EXPECT_EQ(plain, (Completions{"-x", "-y", "-z"}));
}

INSTANTIATE_TEST_SUITE_P(Shells, Completion, testing::ValuesIn(shells),
                         [](const auto& shell) { return shell.param.name; });

}  // namespace
