#pragma once
/// \file
/// What does not fit in memory, in a file without a name.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "files/descriptor.h"

namespace roam::files {

/// TMPDIR, or /tmp. The program hands on absolute folders alone.
[[nodiscard]] inline std::string temporary_folder() {
  const char* named = std::getenv("TMPDIR");
  return named != nullptr && *named != '\0' ? named : "/tmp";
}

/// A file in the folder for temporary files. It has no name, and is gone when it is closed or the program ends.
class UnnamedFile {
 public:
  /// `what` is kept there: a noun in the plural, for messages. Where there can be no file, the first write says why.
  explicit UnnamedFile(std::string what);

  // Both throw roam::Error with the folder, the cause and what to do.
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes);
  void read_at(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  std::string what_;
  Descriptor file_;
  int why_none_ = 0;  ///< an error number
};

}  // namespace roam::files
