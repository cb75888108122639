#pragma once
/// \file
/// The folder of a store, which a stranger may have made. Everything in it is reached from the folder's own descriptor,
/// name by name, and no link is followed: nothing outside of it is read, written or removed. The folder itself may be
/// reached by links, because its user named it.
///
/// A name is relative to the store, e.g. "packs/<64 digits>.pack", and holds no "..".

#include <cstdint>
#include <filesystem>
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

// What is in the place of a file or a folder of a store, as errno.
inline constexpr int is_a_link = 40;          // ELOOP
inline constexpr int is_a_folder = 21;        // EISDIR
inline constexpr int is_something_else = 29;  // ESPIPE: a pipe, a socket, a device
[[nodiscard]] constexpr bool is_foreign(int error) {
  return error == is_a_link || error == is_a_folder || error == is_something_else;
}

/// Throws FileError: "cannot <what> <file>: <why>; <what to do>". Where a link is in the way it is named.
[[noreturn]] void fail(const char* what, const std::filesystem::path& store, const std::string& name, int error);

/// Opens a file of a store; `flags` as of open(2). Not open, and errno set, where that cannot be or it is no regular
/// file. Never waits for the other end of a pipe; never allocates.
[[nodiscard]] Descriptor open_file(const std::filesystem::path& store, std::string_view name, int flags) noexcept;
/// The same of a folder; "" for the store itself.
[[nodiscard]] Descriptor open_folder(const std::filesystem::path& store, std::string_view name) noexcept;

/// "packs" of "packs/a.pack", and "a.pack"; "" and "CURRENT" of "CURRENT".
[[nodiscard]] std::pair<std::string, std::string> split(const std::string& name);

// All throw FileError where a link is in the way, or something else that no store has there.

/// Bytes of a file; nothing where it is not there.
[[nodiscard]] std::optional<std::uint64_t> size_of(const std::filesystem::path& store, const std::string& name);
/// The names of the regular files in a folder, e.g. "packs/a.pack"; none where there is no such folder.
[[nodiscard]] std::vector<std::string> files_in(const std::filesystem::path& store, const std::string& folder);
/// Makes a folder in a store, and those above it there, and syncs the one above each that was made.
void make_folder_in(const std::filesystem::path& store, const std::string& name);
/// Removes a file. False where it is not there or cannot be removed. Throws nothing.
bool remove_file(const std::filesystem::path& store, const std::string& name) noexcept;
/// The same of an empty folder.
bool remove_folder(const std::filesystem::path& store, const std::string& name) noexcept;

}  // namespace roam::store
