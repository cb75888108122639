#pragma once
/// \file
/// Decompression of EXT_meshopt_compression.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace roam::reader {

/// A compressed stretch, as the extension describes it.
struct MeshoptStretch {
  std::span<const std::byte> bytes;
  std::uint64_t count = 0;   ///< elements
  std::uint64_t stride = 0;  ///< bytes of an element
  std::string mode;          ///< "ATTRIBUTES", "TRIANGLES" or "INDICES"
  std::string filter;        ///< "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"; any other text: none
};

/// The count * stride bytes; unset if the stretch is damaged, or of a version that the library does not decode.
[[nodiscard]] std::optional<std::vector<std::byte>> decode_meshopt(const MeshoptStretch& from);

}  // namespace roam::reader
