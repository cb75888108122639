#include "import/find_reader.h"

#include <atomic>
#include <cstdlib>
#include <string>
#include <vector>

#include "process/find_program.h"
#include "roam/error.h"
#include "roam/import.h"
#include "text/stream_of.h"

namespace roam {
namespace {

std::atomic<const char*> package_reader{nullptr};

}  // namespace

bool know_package_reader(const char* program) noexcept {
  package_reader = program;
  return true;
}

}  // namespace roam

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

constexpr const char* reader_name = "roam-reader";

using process::can_run;

[[noreturn]] void refuse(const std::string& named_by, const fs::path& program) {
  throw Error::at(program.string(), "the scene reader " + program.string() + ", named by " + named_by +
                                        ", is not a program that can be run. Name the program " + reader_name +
                                        " of this installation.");
}

}  // namespace

fs::path find_reader(const fs::path& wanted) {
  if (!wanted.empty()) {
    if (!can_run(wanted)) refuse("ImportOptions::reader", wanted);
    return wanted;
  }
  if (const char* named = std::getenv("ROAM_READER"); named != nullptr && *named != '\0') {
    if (!can_run(named)) refuse("the environment variable ROAM_READER", named);
    return named;
  }
  std::vector<fs::path> places;
  if (const fs::path folder = process::own_folder(); !folder.empty()) {
    places.push_back(folder / reader_name);
    places.push_back(folder.parent_path() / "libexec" / "roam" / reader_name);
  }
  // Beside libroam.so of a build; from lib or lib/<architecture> of an installation.
  if (const fs::path folder = process::library_folder(); !folder.empty()) {
    places.push_back(folder / reader_name);
    places.push_back(folder.parent_path() / "libexec" / "roam" / reader_name);
    places.push_back(folder.parent_path().parent_path() / "libexec" / "roam" / reader_name);
  }
  if (const char* of_package = package_reader) places.emplace_back(of_package);
  places.emplace_back(ROAM_READER_INSTALLED);
  // An installation elsewhere, whose program is in PATH.
  const char* const path = std::getenv("PATH");
  std::vector<fs::path> installations;
  for (const std::string& folder : parts_of(path != nullptr ? path : "", ':')) {
    const fs::path bin(folder);
    if (bin.is_absolute()) installations.push_back(bin.parent_path() / "libexec" / "roam" / reader_name);
  }
  std::string tried;
  for (const fs::path& place : places) {
    if (can_run(place)) return place;
    tried += (tried.empty() ? "" : ", ") + place.string();
  }
  for (const fs::path& place : installations) {
    if (can_run(place)) return place;
  }
  throw Error(
      std::string("the program ") + reader_name + ", which opens scene files, was not found (looked at " + tried +
      ", and beside the folders of PATH). Install roam, or name the program by the environment variable ROAM_READER.");
}

}  // namespace roam::reader
