#pragma once
/// \file
/// Authentication codes: HMAC-SHA256 of what the holder of a key has written, so that it is known again.
///
/// The codes of a manifest are lines of codes/<SHA-256 of the manifest>.hmac, one for each who built or adopted it. A
/// file that only builders read ends with a line of its own code.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "roam/store.h"

namespace roam::store {

/// codes/<hash>.hmac: codes of the manifest of this SHA-256.
[[nodiscard]] std::string codes_file(const std::string& manifest);
/// Whether a code of the key is there. False where that cannot be read.
[[nodiscard]] bool has_code(StoreBytes& bytes, const std::string& manifest, const StoreKey& key);
/// Adds the code of the key where it is not there. Throws roam::Error.
void add_code(const std::filesystem::path& store, const std::string& manifest, const StoreKey& key);

/// Writes a file that only builders read, as write_file does; with its code where there is a key.
void write_coded(const std::filesystem::path& store, const std::string& name, std::string text,
                 const std::optional<StoreKey>& key);
/// The text of such a file. Nothing where it is not there, and where there is a key and the code is not that of the
/// key. Throws as read_file.
[[nodiscard]] std::optional<std::string> read_coded(const std::filesystem::path& store, const std::string& name,
                                                    std::uint64_t limit, const std::optional<StoreKey>& key);

}  // namespace roam::store
