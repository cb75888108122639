#pragma once
/// \file
/// Places in a scene that are kept from one session to the next.

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
/// A scene is known by the absolute paths of its files, and by the axis and unit with which they are read, since these
/// change its coordinates. The file is only written by add(), as a whole: whoever reads it sees the old or the new one.
class Bookmarks {
 public:
  /// Reads what is there; a file that does not exist is an empty one. Throws roam::Error, naming the file and what is
  /// wrong in it, when it cannot be read: it is then never written.
  Bookmarks(std::filesystem::path file, const std::vector<std::filesystem::path>& scenes, std::string up,
            std::string unit);

  [[nodiscard]] const std::vector<Bookmark>& all() const { return bookmarks_; }
  /// The bookmark of that name, or null. It becomes the present one.
  const Bookmark* find(const std::string& name);
  /// The one after the present bookmark, or before it, in a circle; null if there are none. It becomes the present one.
  /// If none is, the first or the last.
  const Bookmark* next(bool backwards);
  /// The names for people, separated by ", ".
  [[nodiscard]] std::string names() const;

  /// Keeps a place under the smallest number that is no name yet, and writes the file with what other sessions have
  /// written meanwhile. It becomes the present one. Throws roam::Error when that cannot be done; nothing is added then.
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
