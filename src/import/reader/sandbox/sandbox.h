#pragma once
/// \file
/// The walls around the process that reads files.
///
/// A file can take over the library that parses it. Then all that its author can do is what this process may do. So the
/// process gives up its rights before it opens the first file of a scene:
///
///     Landlock        reads below the scene's folders and the named files; no other file is opened, none is written
///     system calls    (seccomp) starts no program or process, maps no code, opens no socket; creates, changes and
///                     removes no file; the process is killed when it tries
///     no_new_privs    gains no rights by starting a program, and keeps none of root's
///     limits          memory, size of its unnamed file, no core dump; it dies with the program that started it, and
///                     before that where memory runs out
///
/// Each wall that the kernel lacks is skipped; confine() says which hold.

#include <cstdint>
#include <functional>

#include "import/scene_scope.h"
#include "roam/import.h"

namespace roam::reader {

/// What the process still may do behind the walls.
struct Rights {
  SceneScope scope;                 ///< to read
  std::uint64_t address_space = 0;  ///< bytes; 0: any
  std::uint64_t data = 0;           ///< bytes of memory that can be written; 0: any
  std::uint64_t file_size = 0;      ///< bytes of a file that was opened for writing before
};

inline constexpr int any_landlock = 1 << 20;

/// Puts up all walls in their order; says which hold. `prepare` runs when memory is limited, in an empty folder, and
/// before the other walls stand: it loads the libraries that are needed, and opens what is written; nothing that comes
/// after can. Call it first. Every descriptor above `last_descriptor` is closed. `highest_landlock` lets a test stand
/// for an older kernel.
[[nodiscard]] Confinement confine(
    const Rights& rights, int last_descriptor, int highest_landlock = any_landlock,
    const std::function<void()>& prepare = [] {});

/// Parts of confine(). Each returns whether it holds; restrict_files the version of Landlock, or 0.
[[nodiscard]] int restrict_files(const Rights& rights, int highest_landlock);
[[nodiscard]] bool restrict_system_calls();

}  // namespace roam::reader
