#pragma once
/// \file
/// A program that runs as a child of this process and is never left behind.

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/descriptor.h"
#include "process/spawn.h"

namespace roam::process {

/// How a child ended.
struct Ending {
  bool known = false;  ///< false when it was killed here, or collected by a host program that ignores SIGCHLD
  int exit_code = 0;   ///< when signal is 0
  int signal = 0;      ///< that ended it, or 0

  [[nodiscard]] bool is_success() const { return known && signal == 0 && exit_code == 0; }
};

/// The fate of a child when this process ends, also by a crash. On Linux; elsewhere all live on.
enum class Orphan { dies, lives_on };

struct ChildSettings {
  /// Without one of them the standard input is empty, and the standard output and error are kept for last_words().
  std::vector<Inheritance> descriptors{};
  /// "NAME=value"; nothing: that of this process.
  std::optional<std::vector<std::string>> environment{};
  std::string folder{};  ///< its current folder; empty: that of this process
  Orphan orphan = Orphan::dies;
  /// Whether an interrupt typed at the terminal reaches only this process, which then ends the child in order.
  bool own_session = true;
};

/// Owns one child. Destruction ends and collects it. The members are called by one thread at a time.
class Child {
 public:
  /// For a child to end in order, when nothing else is said.
  static constexpr std::chrono::milliseconds usual_grace{3000};

  /// Starts `program` with `arguments` (without its own name). Throws roam::Error that says why it cannot be started.
  Child(const std::filesystem::path& program, const std::vector<std::string>& arguments, const ChildSettings& settings);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Its number; -1 once it has been collected.
  [[nodiscard]] pid_t id() const { return pid_; }
  /// Waits at most so long for the child to end by itself, and collects it; true when it has ended.
  bool wait(std::chrono::milliseconds longest);
  /// Ends it: by SIGTERM, and after `grace` by SIGKILL; by SIGKILL at once when that is 0. Collects it.
  void end(std::chrono::milliseconds grace = usual_grace);
  /// How it ended by itself; once wait() was true.
  [[nodiscard]] const Ending& ending() const { return ending_; }
  /// The last line that it wrote to its standard output or error; may be empty.
  [[nodiscard]] std::string last_words() const;

 private:
  bool collect();
  void signal(int number) const;

  pid_t pid_ = -1;
  Ending ending_;
  files::Descriptor words_;
};

/// Ends all children of this process that a Child owns, as Child::end does, and leaves them to be collected by their
/// owners. From any thread, also while their owners wait for them.
void end_children(std::chrono::milliseconds grace);

}  // namespace roam::process
