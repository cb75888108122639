#pragma once
/// \file
/// Messages of a session to the person, and its notes and written files for the report.

#include <filesystem>
#include <string>
#include <vector>

#include "view/hold.h"

namespace roam::app {

/// Sentences, each shown long enough to be read. Not thread-safe.
class News {
 public:
  /// Sentences leave out the folders of these scenes, which the person knows.
  explicit News(std::vector<std::filesystem::path> scenes) : scenes_(std::move(scenes)) {}

  /// Sets the present time, in s; never decreasing.
  void set_time(double seconds) { now_ = seconds; }
  [[nodiscard]] double now() const { return now_; }
  /// Shows a sentence for some seconds.
  void tell(std::string sentence, bool warning = false);
  /// The same with all paths as they are, for a person who needs their folders.
  void tell_as_is(const std::string& sentence, bool warning = false);
  /// Shows a warning, and keeps it for the report.
  void note(const std::string& sentence);
  /// Shows that a file was written, with its absolute path, and keeps its name for the report.
  void written(const std::filesystem::path& file);

  /// The sentences to show now.
  [[nodiscard]] std::vector<Told> shown();
  /// All warnings, each once.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

 private:
  struct Item {
    Told told;
    double until = 0.0;  ///< s
  };
  std::vector<std::filesystem::path> scenes_;
  double now_ = 0.0;
  std::vector<Item> items_;
  std::vector<std::string> notes_;
  std::vector<std::string> files_;
};

}  // namespace roam::app
