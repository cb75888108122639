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
  bool known = false;  ///< false if end() used SIGKILL, or a host that ignores SIGCHLD lost the status
  int exit_code = 0;   ///< when signal is 0
  int signal = 0;      ///< the signal that ended it, or 0

  [[nodiscard]] bool is_success() const { return known && signal == 0 && exit_code == 0; }
};

/// What happens to a child when this process ends, also by a crash. Only Linux ends it, by SIGTERM; elsewhere all live
/// on.
enum class Orphan { dies, lives_on };

struct ChildSettings {
  /// Without these the standard input is empty, and the standard output and error are kept for last_words().
  std::vector<Inheritance> descriptors{};
  /// Entries "NAME=value"; without a value, this process's environment.
  std::optional<std::vector<std::string>> environment{};
  std::string folder{};  ///< its current folder; if empty, this process's folder
  Orphan orphan = Orphan::dies;
  /// If true, an interrupt typed at the terminal reaches only this process, which then ends the child in order.
  bool own_session = true;
};

/// Owns one child. The destructor ends and collects it. Only one thread at a time may call a member.
class Child {
 public:
  /// The default time for a child to end in order.
  static constexpr std::chrono::milliseconds usual_grace{3000};

  /// Starts `program` with `arguments` (without its own name). Throws roam::Error that says why it cannot be started.
  Child(const std::filesystem::path& program, const std::vector<std::string>& arguments, const ChildSettings& settings);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// The process number; -1 once the child has been collected.
  [[nodiscard]] pid_t id() const { return pid_; }
  /// Waits at most `longest` for the child to end by itself, and collects it. Returns true if it has ended.
  bool wait(std::chrono::milliseconds longest);
  /// Ends and collects the child: by SIGTERM, and by SIGKILL after `grace`. If `grace` is 0, by SIGKILL at once.
  void end(std::chrono::milliseconds grace = usual_grace);
  /// How the child ended by itself. Valid once wait() has returned true.
  [[nodiscard]] const Ending& ending() const { return ending_; }
  /// The last line that is not blank of the child's standard output and error; may be empty.
  [[nodiscard]] std::string last_words() const;

 private:
  bool collect();
  void signal(int number) const;

  pid_t pid_ = -1;
  Ending ending_;
  files::Descriptor words_;
};

/// Ends all children that a Child of this process owns: by SIGTERM, and by SIGKILL after `grace`. The owners collect
/// them. Any thread may call it, also while owners wait for their children.
void end_children(std::chrono::milliseconds grace);

}  // namespace roam::process
