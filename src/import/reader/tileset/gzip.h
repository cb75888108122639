#pragma once
/// \file
/// Files of tilesets that are compressed by gzip, as web servers keep them.

#include <string>
#include <string_view>

namespace roam::reader {

[[nodiscard]] bool is_gzip(std::string_view bytes);

/// The same bytes, decompressed if they are compressed. Throws roam::Error at `place` if they are damaged, and
/// std::bad_alloc if the content does not fit into memory.
[[nodiscard]] std::string without_gzip(std::string bytes, const std::string& place);

}  // namespace roam::reader
