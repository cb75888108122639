#pragma once
/// \file
/// Files that are whole or as they were: written under a temporary name, synced, renamed, the folder synced.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "files/descriptor.h"
#include "files/place.h"
#include "files/unfinished.h"

namespace roam::files {

enum class Naming {
  exact,      ///< a file that has the name is replaced; if a link has it, the file that place_behind_links() finds
  beside,     ///< the file or link of the name is replaced: a stranger may have put a link there
  unclaimed,  ///< a file or link that has the name stays, and commit() drops the new one: of several writers one wins,
              ///< if the file system has hard links or RENAME_NOREPLACE
  numbered,   ///< "a.png" becomes the first of a-1.png, a-2.png, ... that nothing has; nothing is replaced
};

/// A file in the making, beside its final place. It has the rights of any new file, or less. Unless commit() succeeds
/// it is removed with this object, and when the program is interrupted; after a crash or a power cut, when the file of
/// this name is written again. All functions throw FileError, and go on with interrupted and short writes.
class WholeFile {
 public:
  /// Throws also when the final place holds anything but a file of this kind, such as a folder or a device. So does
  /// commit(), if that came while the file was written.
  explicit WholeFile(const std::filesystem::path& file, Naming naming = Naming::exact, FileKind kind = {});
  /// The file `name` in an open folder, whose path is for messages. `rights`: as of open(2), from which those of umask
  /// are taken.
  WholeFile(Descriptor folder, std::filesystem::path folder_path, std::string name, unsigned rights = usual_rights,
            Naming naming = Naming::exact);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// The path until commit(). It may lead elsewhere by then: to write, take the descriptor.
  [[nodiscard]] std::filesystem::path temporary() const { return place_.folder_path / temporary_; }
  /// The open file, for a child to write to; -1 after commit().
  [[nodiscard]] int descriptor() const { return file_.number(); }
  /// Appends.
  void write(std::span<const std::byte> bytes);
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes);
  /// Syncs the file, gives it its name and syncs the folder. Returns its path.
  std::filesystem::path commit();
  /// The same under another name in the same folder.
  void commit_as(const std::string& name);

 private:
  WholeFile(Place place, Naming naming, FileKind kind, unsigned rights);
  /// A name of its own: `name`, the process, a number. Its lock says that it is being written.
  bool begin(std::uint64_t number);
  void remove_abandoned() const;
  void demand_replaceable() const;
  [[nodiscard]] int folder() const { return place_.folder.number(); }
  void finish_writing();
  void rename_to(const std::string& name);
  /// Gives the file this name unless something has it.
  bool take(const std::string& name);
  void settle();
  [[noreturn]] void fail_to_write(int error) const;

  static constexpr unsigned usual_rights = 0666;

  Place place_;
  FileKind kind_;  ///< that commit() may replace
  unsigned rights_;
  Naming naming_;
  std::string temporary_;  ///< in the same folder
  Descriptor file_;
  Unfinished listed_;
};

/// The names of temporary files end with this.
inline constexpr std::string_view temporary_suffix = ".unfinished";
/// Whether a WholeFile may have left a temporary file of this name for a file whose name `is_final` accepts.
[[nodiscard]] bool is_temporary(std::string_view name, const std::function<bool(std::string_view)>& is_final);

/// Writes a WholeFile. Returns its path.
std::filesystem::path write_whole(const std::filesystem::path& file, std::string_view text,
                                  Naming naming = Naming::exact, FileKind kind = {});
/// Reads a small file. Throws FileError, also for one of more than `limit` bytes, and roam::Error for one that is a
/// link, a pipe or a device: its folder may come from a stranger.
[[nodiscard]] std::string read_whole(const std::filesystem::path& file, std::uint64_t limit);
/// A file that the user named, for reading: a link is followed, and it may be a pipe. Throws FileError.
[[nodiscard]] Descriptor open_named(const std::filesystem::path& file);
/// Reads it to its end, as read_whole.
[[nodiscard]] std::string read_named(const std::filesystem::path& file, std::uint64_t limit);
/// The file `name` in an open folder, for reading. Throws the errors of read_whole.
[[nodiscard]] Descriptor open_regular(int folder, const std::string& name, const std::filesystem::path& path);
/// The rest of an open file. The path is for messages. Throws FileError, also for more than `limit` bytes.
[[nodiscard]] std::string read_to_end(const Descriptor& opened, const std::filesystem::path& path, std::uint64_t limit);

/// fsync of an open folder, whose path is for messages. Throws FileError.
void sync_folder(int folder, const std::filesystem::path& path);

}  // namespace roam::files
