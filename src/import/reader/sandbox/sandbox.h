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
///     no_new_privs    gains no rights by starting a program
///     limits          memory, size of its unnamed file, no core dump; it dies with the program that started it
///
/// Each wall that the kernel lacks is skipped; enter() says which hold.

#include <cstdint>

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

/// Limits memory and closes every descriptor above `last_descriptor`. Returns whether all of it holds. Call it first:
/// what follows loads libraries.
[[nodiscard]] bool limit_process(const Rights& rights, int last_descriptor);

/// Moves the process into a folder that is empty and that nobody can put a file into. Returns whether it did.
bool enter_empty_folder();

/// Gives the rights up; says which of Landlock, seccomp and no_new_privs hold. `highest_landlock` lets a test stand for
/// an older kernel. Nothing that comes after can load a library.
[[nodiscard]] Confinement enter(const Rights& rights, int highest_landlock = any_landlock);

/// The parts of enter(). Each returns whether it holds; restrict_files the version of Landlock, or 0.
[[nodiscard]] int restrict_files(const Rights& rights, int highest_landlock);
[[nodiscard]] bool restrict_system_calls();

}  // namespace roam::reader
