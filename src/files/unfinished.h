#pragma once
/// \file
/// Which files this process has under a temporary name, so that a program that must end at once can remove them.

#include <unistd.h>

#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace roam::files {

/// Counts one file as unfinished for its life. Whoever has renamed or removed the file is done with it.
class Unfinished {
 public:
  Unfinished() = default;
  ~Unfinished() { end(); }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  /// The file `name` in an open folder, which stays open as long. By the folder's path another one could be meant by
  /// then.
  void begin(int folder, std::string name) {
    end();
    File file{folder, std::move(name)};
    const std::lock_guard lock(all().mutex);
    all().files.insert(file);
    file_ = std::move(file);
  }
  void end() {
    if (file_.second.empty()) return;
    const std::lock_guard lock(all().mutex);
    all().files.erase(file_);
    file_ = {};
  }

  /// Removes all that are unfinished now, whatever their writers do next.
  static void remove_all() {
    const std::lock_guard lock(all().mutex);
    for (const auto& [folder, name] : all().files) ::unlinkat(folder, name.c_str(), 0);
  }

 private:
  using File = std::pair<int, std::string>;
  struct All {
    std::mutex mutex;
    std::set<File> files;
  };
  /// Never destroyed: threads may end after it would be.
  static All& all() {
    static All& them = *new All;
    return them;
  }

  File file_{-1, {}};
};

}  // namespace roam::files
