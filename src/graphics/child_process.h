#pragma once
/// \file
/// A program that runs as our child and is never left behind.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace roam::graphics {

/// Where a program of that name lies on the PATH, or an empty path.
[[nodiscard]] std::filesystem::path find_program(const std::string& name);

/// A file descriptor of ours, and the number under which the child has it.
struct Inheritance {
  int ours = -1;
  int theirs = -1;  ///< 0, or 3 and up: 1 and 2 are kept for last_words()
};

/// What becomes of the child when the thread that started it ends, also by a crash.
enum class Orphan { dies, lives_on };

/// Owns one child. It runs in a session of its own, so that an interrupt typed at the terminal reaches only us, and we
/// can end it in order. Destruction ends and collects it.
class ChildProcess {
 public:
  /// Starts `program` with `arguments` (without its own name). Throws roam::Error when it cannot be started.
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               const std::vector<Inheritance>& inheritance, Orphan orphan);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Waits at most `milliseconds` for the child to end; true when it has.
  bool wait(int milliseconds);
  /// Whether it ended by itself, with success. Means nothing before wait() was true.
  [[nodiscard]] bool succeeded() const { return succeeded_; }
  /// Asks it to end when it still runs, kills it when it does not, and collects it.
  void end();
  /// The last line that it wrote to its standard output or error; may be empty.
  [[nodiscard]] std::string last_words() const;

 private:
  pid_t pid_ = -1;
  bool collected_ = false;
  bool succeeded_ = false;
  int words_ = -1;
};

}  // namespace roam::graphics
