#pragma once
/// \file
/// Named poses in a scene, kept from one session to the next.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "roam/scene_frame.h"
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
/// Absolute paths identify a scene, together with its frame, which its positions are of. An empty "up" is the axis that
/// is up without --up. Only add(), rename() and remove() write the file, as a whole: a reader sees the old or the new
/// one.
class Bookmarks {
 public:
  /// Reads the file; a missing file has no bookmarks. `usual`: the frame without options. Throws roam::Error if the
  /// file cannot be read, with its name and the mistake. Such a file is never written.
  Bookmarks(std::filesystem::path file, const std::vector<std::filesystem::path>& scenes, const SceneFrame& frame,
            const SceneFrame& usual = {});

  [[nodiscard]] const std::vector<Bookmark>& all() const { return bookmarks_; }
  /// The bookmark of that name, or null. It becomes the present one.
  const Bookmark* find(const std::string& name);
  /// Another frame of the scene that has a bookmark of that name, if there is one.
  [[nodiscard]] std::optional<SceneFrame> frame_elsewhere(const std::string& name) const;
  /// The bookmark after the present one, or before it, in a circle; null if there are none. It becomes the present one.
  /// If there is no present one: the first, or the last.
  const Bookmark* next(bool backwards);
  /// The names for a message, separated by ", ".
  [[nodiscard]] std::string names() const;

  /// Adds a pose under the smallest unused number, and writes the file with the changes of other sessions. It becomes
  /// the present bookmark. Throws roam::Error if that fails; nothing is added then.
  const Bookmark& add(const Pose& pose);
  /// The present bookmark, and its number from 1; null if there is none.
  [[nodiscard]] const Bookmark* present() const { return present_ ? &bookmarks_[*present_] : nullptr; }
  [[nodiscard]] std::size_t number() const { return present_ ? *present_ + 1 : 0; }
  /// Gives the present bookmark another name, and writes the file. Throws roam::Error if another has that name and is
  /// not to be replaced, or if the file cannot be written; nothing changes then.
  void rename(const std::string& name, bool replaces = false);
  /// Whether another bookmark than the present one has that name.
  [[nodiscard]] bool is_taken(const std::string& name) const;
  /// Deletes the bookmark of that name, and writes the file. Throws roam::Error if that fails; nothing changes then.
  void remove(const std::string& name);

 private:
  void change(const std::function<void(std::vector<Bookmark>&)>& edit);

  std::filesystem::path file_;
  std::vector<std::string> scenes_;
  SceneFrame frame_, usual_;
  std::vector<Bookmark> bookmarks_;
  std::vector<std::pair<SceneFrame, std::string>> elsewhere_;  ///< names in other frames
  std::optional<std::size_t> present_;
};

}  // namespace roam::app
