#pragma once
/// \file
/// The folder of a store, which a stranger may have made. Everything in it is reached from the folder's own descriptor,
/// name by name, and no link is followed: nothing outside of it is read, written or removed. The folder itself may be
/// reached by links, where its user named it.
///
/// A name is relative to the store, e.g. "packs/<64 digits>.pack", and holds no "..".

#include <fcntl.h>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/descriptor.h"
#include "files/file_error.h"

namespace roam::store {

using files::Descriptor;
using files::FileError;

/// Flag of open(2) for what is only passed through or looked at: it need not be readable.
#ifdef O_PATH
inline constexpr int not_to_read = O_PATH;
#else
inline constexpr int not_to_read = O_RDONLY | O_NONBLOCK;
#endif

// What is in the place of a file or a folder of a store, as errno.
inline constexpr int is_a_link = 40;          // ELOOP
inline constexpr int is_a_folder = 21;        // EISDIR
inline constexpr int is_something_else = 29;  // ESPIPE: a pipe, a socket, a device
[[nodiscard]] constexpr bool is_foreign(int error) {
  return error == is_a_link || error == is_a_folder || error == is_something_else;
}

/// A folder that was made, and the one that it was made in.
struct MadeFolder {
  Descriptor above;
  std::string name;
};

/// The folder of a store. By its path it is opened anew each time, as readers do. A builder holds it open: whatever
/// takes its place meanwhile is not touched.
class Folder {
 public:
  template <std::convertible_to<std::filesystem::path> Path>
  Folder(const Path& path) : path_(path) {}  // NOLINT(google-explicit-constructor): a path says which folder is meant
  /// Opens it for the life of this and of all copies. Throws roam::Error, also where the last name of the path is a
  /// link and `through_link` is false.
  [[nodiscard]] static Folder held(const std::filesystem::path& path, bool through_link);
  /// The same; makes it where it is not there, and those above it, and syncs the one above each. Adds what it makes to
  /// `made`, also where it throws.
  [[nodiscard]] static Folder held_or_made(const std::filesystem::path& path, bool through_link,
                                           std::vector<MadeFolder>& made);

  /// As it was passed, for people; and for what only looks.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::string string() const { return path_.string(); }
  [[nodiscard]] std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
  /// A descriptor of its own of the folder. Not open, and errno set, where that cannot be. Never allocates.
  [[nodiscard]] Descriptor open() const noexcept;
  /// Whether the path still leads to the folder that is held.
  [[nodiscard]] bool is_in_place() const noexcept;

 private:
  std::filesystem::path path_;
  std::shared_ptr<const Descriptor> held_;  ///< null: by its path
};

/// Throws FileError: "cannot <what> <file>: <why>; <what to do>". Where a link is in the way it is named.
[[noreturn]] void fail(const char* what, const Folder& store, const std::string& name, int error);

/// Opens a file of a store; `flags` as of open(2). Not open, and errno set, where that cannot be or it is no regular
/// file. Never waits for the other end of a pipe; never allocates.
[[nodiscard]] Descriptor open_file(const Folder& store, std::string_view name, int flags) noexcept;
/// The same of a folder; "" for the store itself.
[[nodiscard]] Descriptor open_folder(const Folder& store, std::string_view name) noexcept;

/// "packs" of "packs/a.pack", and "a.pack"; "" and "CURRENT" of "CURRENT".
[[nodiscard]] std::pair<std::string_view, std::string_view> split(std::string_view name) noexcept;

/// The type of what has this name, as S_IFMT; 0 where nothing has it. No link is followed.
[[nodiscard]] unsigned type_of(const Folder& store, std::string_view name) noexcept;

// All throw FileError where a link is in the way, or something else that no store has there.

/// Whether there is a file of this name, and nothing else. Throws nothing.
[[nodiscard]] bool is_file(const Folder& store, std::string_view name) noexcept;
/// Bytes of a file; nothing where it is not there.
[[nodiscard]] std::optional<std::uint64_t> size_of(const Folder& store, const std::string& name);
/// The names of all that is in a folder, e.g. "packs/a.pack"; none where there is no such folder.
[[nodiscard]] std::vector<std::string> names_in(const Folder& store, const std::string& folder);
/// Those of regular files.
[[nodiscard]] std::vector<std::string> files_in(const Folder& store, const std::string& folder);
/// Makes a folder in a store, and those above it there, and syncs the one above each that was made.
void make_folder_in(const Folder& store, const std::string& name);
/// Removes a file. False where it is not there or cannot be removed. Throws nothing.
bool remove_file(const Folder& store, const std::string& name) noexcept;
/// The same of an empty folder.
bool remove_folder(const Folder& store, const std::string& name) noexcept;
/// Removes a file, or a folder with all that is in it, as far as that can be done. What lies deeper than anything of a
/// store stays.
void remove_all(const Folder& store, const std::string& name);

}  // namespace roam::store
