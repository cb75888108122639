#pragma once
/// \file
/// Parser of the header of a PLY file: its elements and their properties.

#include <cstdint>
#include <string>
#include <vector>

#include "import/reader/file_bytes.h"

namespace roam::reader {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a value in a binary file.
[[nodiscard]] std::size_t bytes_of(PlyType type);
[[nodiscard]] inline bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  ///< of the value, or of a list's items
  bool list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Bytes of one element; if it has a list, the least number.
  [[nodiscard]] std::size_t least_bytes() const;
  [[nodiscard]] bool has_list() const;
  /// The index of the property with this name, or -1.
  [[nodiscard]] int find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> texture_files;  ///< from comments that MeshLab and others write
};

/// Reads the header up to and including the end of its last line. Throws roam::Error with the line at fault.
[[nodiscard]] PlyHeader read_ply_header(FileBytes& bytes, Lines& lines);

}  // namespace roam::reader
