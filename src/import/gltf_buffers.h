#pragma once
/// \file
/// The files beside a glTF file that hold its numbers.

#include <filesystem>
#include <vector>

namespace roam::reader {

/// Those that a .gltf file names as its buffers, absolute, sorted, as far as they are there; none for other files, and
/// where the file cannot be understood: reading it says so.
[[nodiscard]] std::vector<std::filesystem::path> gltf_buffers(const std::filesystem::path& file);

}  // namespace roam::reader
