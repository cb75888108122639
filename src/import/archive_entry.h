#pragma once
/// \file
/// Where an entry of a zip archive lies in the archive.

#include <cstdint>

namespace roam {

/// A file in an archive, as its reader found it. All zero: no entry.
struct ArchiveEntry {
  std::uint64_t begin = 0;   ///< of its data, in bytes from the beginning of the archive
  std::uint64_t packed = 0;  ///< bytes of its data
  std::uint64_t bytes = 0;   ///< of the file, unpacked
  std::uint64_t method = 0;  ///< of its compression, as zip numbers them
  std::uint64_t record = 0;  ///< its place in the archive's directory, in bytes
  std::uint64_t number = 0;  ///< and counted from 0

  bool operator==(const ArchiveEntry&) const = default;
};

}  // namespace roam
