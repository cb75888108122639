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
  /// Sentences leave out the folders of these scenes, which the person knows. `before`: notes of earlier sessions.
  explicit News(std::vector<std::filesystem::path> scenes, std::vector<std::string> before = {})
      : scenes_(std::move(scenes)), before_(std::move(before)) {}

  /// Sets the present time, in s; never decreasing.
  void set_time(double seconds) { now_ = seconds; }
  [[nodiscard]] double now() const { return now_; }
  /// Shows a sentence for some seconds.
  void tell(std::string sentence, bool warning = false);
  /// The same with all paths as they are, for a person who needs their folders.
  void tell_as_is(const std::string& sentence, bool warning = false);
  /// Shows a warning, tells it on the terminal at once, and keeps it for the report. One of an earlier session is only
  /// kept.
  void note(const std::string& sentence) { note(sentence, sentence); }
  /// The same with a shorter sentence for the window; empty: the window shows none.
  void note(const std::string& sentence, const std::string& shown);
  /// The same, always shown, before all other sentences, with its remedy, which the report leaves out: "U turns it". If
  /// the sentence is shown already, it moves to this place.
  void note_first(const std::string& sentence, const std::string& remedy = {});
  /// Keeps a note for the report, and shows it no longer, nor later.
  void keep_for_report(const std::string& sentence);
  /// Shows that a file was written, with its absolute path, and keeps its name for the report.
  void written(const std::filesystem::path& file);

  /// The sentences to show now.
  [[nodiscard]] std::vector<Told> shown();
  /// All warnings, each once.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

 private:
  struct Item {
    std::string note;  ///< that it shows; empty: none
    bool warning = false;
    bool first = false;
    std::string text = {};
    double until = 0.0;  ///< s
  };
  [[nodiscard]] std::string without_folders(std::string sentence) const;
  void show(const std::string& sentence, Item item);
  [[nodiscard]] bool was_noted_before(const std::string& sentence) const;
  void tell_on_terminal(const std::string& sentence) const;

  std::vector<std::filesystem::path> scenes_;
  std::vector<std::string> before_;
  double now_ = 0.0;
  std::vector<Item> items_;
  std::vector<std::string> notes_;
  std::ptrdiff_t first_notes_ = 0;  ///< of these, from the beginning
  std::vector<std::string> files_;
};

}  // namespace roam::app
