// roam reference: writes the help of all verbs for other programs: pages of the manual, completion for shells. Hidden:
// the build runs it.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "cli/help_page.h"
#include "files/whole_file.h"
#include "import/reader/format_table.h"
#include "reference/completion.h"
#include "reference/man_page.h"
#include "roam/error.h"
#include "roam/version.h"
#include "verbs.h"

namespace roam::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* reference_help = R"(The folder gets the names of share/ in an installation.

Examples:
  roam reference share
)";

/// Today, or the day that SOURCE_DATE_EPOCH names, for builds that can be repeated: "2026-11-26".
std::string date() {
  const char* set = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t seconds = set != nullptr ? std::strtoll(set, nullptr, 10) : std::time(nullptr);
  std::tm day{};
  char text[sizeof "2026-11-26"];
  if (gmtime_r(&seconds, &day) == nullptr || std::strftime(text, sizeof text, "%Y-%m-%d", &day) == 0)
    throw Error::at("SOURCE_DATE_EPOCH", std::string("SOURCE_DATE_EPOCH is no number of seconds: ") + set);
  return text;
}

void write(const fs::path& file, const std::string& text) {
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);
  files::write_whole(file, text);
}

void write_man_pages(const HelpPage& page, const HelpPage& program, const fs::path& folder) {
  write(folder / (man_page_name(page) + ".1"), man_page(page, program, ROAM_VERSION_STRING, date()));
  for (const HelpPage& below : page.below) write_man_pages(below, program, folder);
}

void write_completion(const HelpPage& program, const fs::path& folder) {
  std::vector<std::string> scenes;
  for (const reader::Format& format : reader::formats) scenes.emplace_back(format.extension);
  write(folder / "bash-completion" / "completions" / program.name, bash_completion(program, scenes));
  write(folder / "zsh" / "site-functions" / ("_" + program.name), zsh_completion(program, scenes));
  write(folder / "fish" / "vendor_completions.d" / (program.name + ".fish"), fish_completion(program, scenes));
}

}  // namespace

void add_reference(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("reference", "Write pages of the manual, and completion for shells");
  verb->group("");
  verb->footer(reference_help);
  const auto folder = std::make_shared<fs::path>();
  verb->add_option("FOLDER", *folder, "Folder to write to")->required()->type_name("");
  verb->callback([folder, &program, &run] {
    run = [folder, &program] {
      const HelpPage page = help_page(program);
      write_man_pages(page, page, *folder / "man" / "man1");
      write_completion(page, *folder);
      return done;
    };
  });
}

}  // namespace roam::app
