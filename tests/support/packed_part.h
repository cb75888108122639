#pragma once
/// A part file of any content, also one that no builder writes; and all that a part file holds.

#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "store/part.h"

namespace packed_parts {

/// A number as a part's content holds it.
inline std::string number(std::uint64_t value) {
  std::string text;
  for (; value >= 128; value >>= 7) text.push_back(static_cast<char>(value | 128U));
  text.push_back(static_cast<char>(value));
  return text;
}

/// `window`: log2 of the bytes of the frame's window.
inline std::vector<std::byte> packed_part(std::uint64_t triangles, std::uint64_t objects, std::uint64_t cells,
                                          const std::string& content, int window) {
  const std::uint64_t header[6] = {0, triangles, objects, cells, 0, content.size()};
  std::vector<std::byte> bytes(sizeof header + ZSTD_compressBound(content.size()));
  std::memcpy(bytes.data(), header, sizeof header);
  std::memcpy(bytes.data(), "ROAMPART", 8);
  ZSTD_CCtx* const packer = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(packer, ZSTD_c_windowLog, window);
  bytes.resize(sizeof header + ZSTD_compress2(packer, bytes.data() + sizeof header, bytes.size() - sizeof header,
                                              content.data(), content.size()));
  ZSTD_freeCCtx(packer);
  return bytes;
}

}  // namespace packed_parts

namespace roam::store {

/// Decodes all of it at once.
inline PartFile decode_part(std::span<const std::byte> bytes, const std::string& file) {
  PartFile part;
  const std::uint64_t all = bytes.size();
  PartVisitor visitor;
  visitor.counts = [&](const PartCounts& counts) {
    part.triangles = counts.triangles;
    part.cell_bits = counts.cell_bits;
  };
  visitor.object = [&](std::uint64_t first, std::string_view name) {
    part.objects.push_back({first, std::string(name)});
  };
  visitor.cell = [&](const Cell& cell) { part.cells.push_back(cell); };
  const auto more = [&](std::span<std::byte> out) {
    const std::size_t size = std::min(out.size(), bytes.size());
    std::memcpy(out.data(), bytes.data(), size);
    bytes = bytes.subspan(size);
    return size;
  };
  visit_part(more, all, file, visitor);
  return part;
}

}  // namespace roam::store
