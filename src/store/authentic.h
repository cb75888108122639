#pragma once
/// \file
/// Authentication codes: HMAC-SHA256 of files that the holder of a key has written, so that they can be recognized.
///
/// The codes of a manifest are lines of codes/<SHA-256 of the manifest>.hmac, one for each key holder who built or
/// adopted it. A file that only builders read ends with a line that holds its own code.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "store/bytes.h"
#include "store/folder.h"

namespace roam::store {

/// codes/<hash>.hmac: the codes of the manifest with this SHA-256.
[[nodiscard]] std::string codes_file(const std::string& manifest);
/// Whether the file has a code of this key. False if it cannot be read.
[[nodiscard]] bool has_code(StoreBytes& bytes, const std::string& manifest, const StoreKey& key);
/// Adds the code of the key if it is missing. Throws roam::Error.
void add_code(const Folder& store, const std::string& manifest, const StoreKey& key);

/// Writes a file that only builders read, like write_file; with its code if there is a key.
void write_coded(const Folder& store, const std::string& name, std::string text, const std::optional<StoreKey>& key);
/// The text of such a file. Nothing if the file is missing, or if there is a key and the file's code does not match.
/// Throws like read_file.
[[nodiscard]] std::optional<std::string> read_coded(const Folder& store, const std::string& name, std::uint64_t limit,
                                                    const std::optional<StoreKey>& key);

}  // namespace roam::store
