#include "import/report_notes.h"

#include <fmt/format.h>

#include <utility>

#include "text/printable.h"

namespace roam::reader {
namespace {

/// Number of names in a sentence before "and others".
constexpr std::size_t listed_names = 3;

const char* by_number(std::uint64_t count, const char* one, const char* many) { return count == 1 ? one : many; }

std::string listed(const std::vector<LeftOutObject>& objects) {
  std::string text;
  for (std::size_t i = 0; i < objects.size() && i < listed_names; ++i) {
    text += fmt::format("{}'{}' ({} vertices, {} triangles)", i == 0 ? "" : ", ", printable(objects[i].name),
                        objects[i].vertices, objects[i].triangles);
  }
  return objects.size() > listed_names ? text + " and others" : text;
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < listed_names; ++i) text += (i == 0 ? "" : ", ") + printable(names[i]);
  return names.size() > listed_names ? text + " and others" : text;
}

void add_count_notes(ImportReport& report, const ImportOptions& options, const std::vector<bool>& matched) {
  std::vector<std::string> notes;
  if (report.bad_vertices > 0 || report.bad_triangles > 0) {
    notes.push_back(fmt::format(
        "{} triangles were left out: they have one of {} vertices that are not finite or lie beyond 1e9 m, or refer to "
        "a vertex that is not there; in {}. The scene has holes there.",
        report.bad_triangles, report.bad_vertices, listed(report.bad_objects)));
  }
  if (report.missing_pages > 0) {
    const std::uint64_t count = report.missing_pages;
    notes.push_back(fmt::format(
        "{} {} that the scene refers to {} absent or unreadable; coarser geometry stands in where there is "
        "one: {}.",
        count, by_number(count, "file", "files"), by_number(count, "is", "are"), listed(report.missing_page_files)));
  }
  if (report.outside_references > 0) {
    const std::uint64_t count = report.outside_references;
    notes.push_back(fmt::format(
        "{} {} out of the scene's folder and {} left out: {}. Allow the folder (--allow) if you trust the scene.",
        count, by_number(count, "reference leads", "references lead"), by_number(count, "was", "were"),
        listed(report.outside_files)));
  }
  if (auto note = note_of_confinement(report)) notes.push_back(std::move(*note));
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (!matched[i])
      notes.push_back(fmt::format("No object's name matches '{}'; nothing was ignored.", printable(options.ignore[i])));
  }
  report.notes.insert(report.notes.begin(), notes.begin(), notes.end());
}

std::optional<std::string> note_of_confinement(const ImportReport& report) {
  const auto& walls = report.confinement;
  if (!walls || (walls->landlock > 0 && walls->system_calls)) return std::nullopt;
  return fmt::format(
      "The scene was read without {}, which this system does not offer; open no scene of a stranger here. "
      "SECURITY.md says more.",
      walls->system_calls   ? "Landlock"
      : walls->landlock > 0 ? "seccomp"
                            : "Landlock and seccomp");
}

std::optional<std::string> note_of_missing_images(std::uint64_t count, const std::vector<std::string>& files) {
  if (count == 0) return std::nullopt;
  return fmt::format("{} {} that the scene refers to {} absent or unreadable; what they cover is shown without: {}.",
                     count, by_number(count, "image", "images"), by_number(count, "is", "are"), listed(files));
}

}  // namespace roam::reader
