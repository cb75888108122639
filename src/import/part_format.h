#pragma once
/// \file
/// The bytes of a DisplayPart in a reader's stream.
///
/// In the byte order of the machine, without padding. A list is a u64 number of elements, followed by the elements:
///
///     part       u32 groups; list of texture; list of look; list of geometry; list of pages
///     texture    u32 width, height, levels; u8 texels, across, up; list of u8
///     look       u32 texture; u8 cover; f32 cutoff
///     geometry   u32 group, look; f64 cell x, y, z; lists of positions (3 f32), colours (4 u8), normals (3 f32),
///                coordinates (2 f32), indices (u16)
///     pages      u32 group; f64 center x, y, z; f32 radius; u8 measure; f32 error; 3 f32 half; list of level
///     level      f32 from, to; u32 group; list of the bytes of its page
///
/// The frame that begins the part (PartHeader) has origin, bounds and triangles.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "import/display_part.h"

namespace roam::reader {

[[nodiscard]] std::vector<std::byte> encode(const DisplayPart& part);

/// Decodes into `part`, whose origin is set. Checks every count against the bytes present, every index against the
/// number of its elements, and every number against its range. Throws StreamReceiver::StreamDamaged; ContentTooLarge,
/// before it allocates, if DisplayPart::node_bytes() would be more than `most_node_bytes`.
void decode(std::span<const std::byte> bytes, DisplayPart& part, std::uint64_t most_node_bytes);

}  // namespace roam::reader
