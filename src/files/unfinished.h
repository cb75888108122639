#pragma once
/// \file
/// Which files this process has under a temporary name, so that a program that must end at once can remove them.

#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <system_error>

namespace roam::files {

/// Counts one file as unfinished for its life. Whoever has renamed or removed the file is done with it.
class Unfinished {
 public:
  Unfinished() = default;
  explicit Unfinished(const std::filesystem::path& file) { begin(file); }
  ~Unfinished() { end(); }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  void begin(const std::filesystem::path& file) {
    end();
    std::error_code none;
    name_ = std::filesystem::absolute(file, none).string();
    const std::lock_guard lock(all().mutex);
    all().names.insert(name_);
  }
  void end() {
    if (name_.empty()) return;
    const std::lock_guard lock(all().mutex);
    all().names.erase(name_);
    name_.clear();
  }

  /// Removes all that are unfinished now, whatever their writers do next.
  static void remove_all() {
    const std::lock_guard lock(all().mutex);
    std::error_code none;
    for (const std::string& name : all().names) std::filesystem::remove(name, none);
  }

 private:
  struct All {
    std::mutex mutex;
    std::set<std::string> names;
  };
  /// Never destroyed: threads may end after it would be.
  static All& all() {
    static All& them = *new All;
    return them;
  }

  std::string name_;
};

}  // namespace roam::files
