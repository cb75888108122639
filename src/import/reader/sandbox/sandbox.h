#pragma once
/// \file
/// The sandbox of the process that reads files.
///
/// A malicious file can take over the library that parses it. Then its author can do all that this process may do. So
/// the process gives up its rights before it opens the first file of a scene:
///
///     Landlock        reads below the scene's folders and the named files; no other file is opened, none is written
///     system calls    (seccomp) starts no program or process, maps no code, opens no socket; creates, changes and
///                     removes no file; the process is killed when it tries
///     no_new_privs    gains no rights by starting a program, and keeps none of root's
///     limits          memory, size of its unnamed file, no core dump; it dies with the program that started it, and
///                     before that where memory runs out
///
/// A wall that the kernel lacks is skipped; confine() returns which hold.

#include <cstdint>
#include <functional>

#include "import/scene_scope.h"
#include "roam/import.h"

namespace roam::reader {

/// Rights that the process keeps behind the walls.
struct Rights {
  SceneScope scope;                 ///< files that may be read
  std::uint64_t address_space = 0;  ///< bytes; 0: any
  std::uint64_t data = 0;           ///< bytes of writable memory; 0: any
  std::uint64_t file_size = 0;      ///< bytes of a file that was opened for writing before
};

inline constexpr int any_landlock = 1 << 20;

/// Puts up all walls in their order and returns which hold. Call it first. It closes every descriptor above
/// `last_descriptor`. `prepare` runs in an empty folder when memory is limited and before the other walls stand. It
/// must load all libraries and open all files for writing, which is impossible later. With `highest_landlock` a test
/// simulates an older kernel.
[[nodiscard]] Confinement confine(
    const Rights& rights, int last_descriptor, int highest_landlock = any_landlock,
    const std::function<void()>& prepare = [] {});

/// Parts of confine(). Each returns whether it holds; restrict_files returns the version of Landlock, or 0.
[[nodiscard]] int restrict_files(const Rights& rights, int highest_landlock);
[[nodiscard]] bool restrict_system_calls();

}  // namespace roam::reader
