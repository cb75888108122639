#pragma once
/// \file
/// The system calls between this process and the child's program.

#include <sys/types.h>

#include <span>

namespace roam::process {

/// A file descriptor of this process, and its number in the child.
struct Inheritance {
  int ours = -1;
  int theirs = -1;
};

/// The steps of a child before it runs its program. Everything is made ready beforehand: the child shares this
/// process's memory until then and must not allocate.
struct Plan {
  const char* program = nullptr;
  char* const* arguments = nullptr;            ///< the program's name first, a null pointer last
  char* const* environment = nullptr;          ///< a null pointer last
  const char* folder = nullptr;                ///< its current folder; null: this process's
  std::span<const Inheritance> descriptors{};  ///< `ours` are close-on-exec and above each `theirs`
  bool own_session = false;
  bool dies_with_parent = false;  ///< by SIGTERM
};

/// Starts a child, with all signals unblocked and none caught or ignored. Returns its number, or the negative errno.
///
/// All children are started by one thread, which ends with the process: on Linux a child that dies with its parent dies
/// with the thread that started it. A child is as nice as the caller's thread.
[[nodiscard]] pid_t spawn(const Plan& plan);

}  // namespace roam::process
