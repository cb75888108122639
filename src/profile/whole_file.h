#pragma once
/// \file
/// Small files that are whole or as they were.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace roam::training {

/// Throws roam::Error naming the file and the cause, also for a file that is larger than `limit` bytes,
/// and for one that is a link, a pipe or a device.
[[nodiscard]] std::string read_whole(const std::filesystem::path& file, std::uint64_t limit);
/// Under a temporary name beside it, synced, renamed. Throws roam::Error naming the file and the cause; what was there
/// then stays, and nothing else.
void write_whole(const std::filesystem::path& file, std::string_view text);

}  // namespace roam::training
