#pragma once
/// \file
/// Named poses in a scene, kept from one session to the next.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "view/pose.h"

namespace roam::app {

struct Bookmark {
  std::string name;
  Pose pose;
};

/// The bookmarks of one scene, in a file that holds those of all scenes:
///
///     [{"scene": ["/home/me/mine.dae"], "up": "", "unit": "m",
///       "bookmarks": [{"name": "shaft", "position": [1, 2, 3], "yaw": 90, "pitch": 0}]}]
///
/// Absolute paths identify a scene, together with the axis and unit of reading, which change its coordinates. Only
/// add() writes the file, as a whole: a reader sees the old or the new one.
class Bookmarks {
 public:
  /// Reads the file; a missing file has no bookmarks. Throws roam::Error if the file cannot be read, with its name and
  /// the mistake. Such a file is never written.
  Bookmarks(std::filesystem::path file, const std::vector<std::filesystem::path>& scenes, std::string up,
            std::string unit);

  [[nodiscard]] const std::vector<Bookmark>& all() const { return bookmarks_; }
  /// The bookmark of that name, or null. It becomes the present one.
  const Bookmark* find(const std::string& name);
  /// The bookmark after the present one, or before it, in a circle; null if there are none. It becomes the present one.
  /// If there is no present one: the first, or the last.
  const Bookmark* next(bool backwards);
  /// The names for a message, separated by ", ".
  [[nodiscard]] std::string names() const;

  /// Adds a pose under the smallest unused number, and writes the file with the changes of other sessions. It becomes
  /// the present bookmark. Throws roam::Error if that fails; nothing is added then.
  const Bookmark& add(const Pose& pose);

 private:
  std::filesystem::path file_;
  std::vector<std::string> scenes_;
  std::string up_;
  std::string unit_;
  std::vector<Bookmark> bookmarks_;
  std::optional<std::size_t> present_;
};

}  // namespace roam::app
