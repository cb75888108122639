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

/// What a child does before it runs its program. The parent prepares everything, because the child shares the parent's
/// memory until then and must not allocate.
struct Plan {
  const char* program = nullptr;
  char* const* arguments = nullptr;            ///< the program's name first, a null pointer last
  char* const* environment = nullptr;          ///< a null pointer last
  const char* folder = nullptr;                ///< its current folder; null: this process's folder
  std::span<const Inheritance> descriptors{};  ///< each `ours` is close-on-exec and greater than every `theirs`
  bool own_session = false;
  bool dies_with_parent = false;  ///< by SIGTERM
};

/// Starts a child with all signals unblocked and none caught or ignored. Returns its process number, or the negative
/// errno.
///
/// One thread, which lives as long as the process, starts all children. On Linux a child that dies with its parent dies
/// with the thread that started it. The child has the niceness of the caller's thread.
[[nodiscard]] pid_t spawn(const Plan& plan);

}  // namespace roam::process
