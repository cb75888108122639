#pragma once
/// \file
/// The manifest of a store: the root from which all its files are found.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "roam/math.h"
#include "store/bytes.h"
#include "store/folder.h"

namespace roam::store {

/// Version of the format that is written. Newer ones are refused.
inline constexpr std::uint32_t format_version = 1;

/// Bytes of a manifest's `options`, at most.
inline constexpr std::size_t longest_options = 64 << 10;

/// A page of a shard's pack.
struct PageRef {
  Box box;  ///< the box of its tiles' boxes
  std::uint64_t offset = 0;
  std::uint32_t bytes = 0;
  std::uint64_t hash = 0;  ///< XXH3
  std::uint32_t tiles = 0;
};

/// A shard: one pack. A build in progress keeps each in a file shards/<key>.json; the manifest lists them all.
struct ShardInfo {
  std::string key;   ///< 64 digits that identify its inputs: see build/plan.h
  std::string pack;  ///< SHA-256 of the pack, 64 digits: packs/<pack>.pack
  std::uint64_t bytes = 0;
  std::uint64_t triangles = 0, tiles = 0;
  std::uint64_t geometry_bytes = 0, number_bytes = 0, resident_bytes = 0;
  Box bounds;  ///< of the source triangles
  double largest_error = 0.0;
  std::uint64_t geometry_hash = 0;
  std::vector<PageRef> pages;
};

/// A part of the scene. part.h describes its file.
struct PartInfo {
  std::string name;         ///< e.g. "Data/Tile_+000_+001", unique in a store
  std::string fingerprint;  ///< changes when the part's files or the import's options change
  std::string file;         ///< SHA-256 of the part file, 64 digits
  std::uint64_t bytes = 0;  ///< size of the part file
  std::uint64_t triangles = 0, objects = 0;
  std::vector<std::string> references{};  ///< see build/references.h
};

struct Manifest {
  std::uint32_t format = format_version;
  bool lossless = false;
  std::string options;  ///< how the scene was read, for people and for comparison: see build/plan.h
  Box bounds;
  std::uint64_t geometry_hash = 0;
  std::vector<PartInfo> parts;    ///< in the order of the scene, which determines a triangle's number in the scene
  std::vector<ShardInfo> shards;  ///< in the order of the curve, which also numbers the pages
  std::vector<std::string> notes;
};

/// Thrown for a format newer than format_version.
class NewerFormat : public Error {
 public:
  using Error::Error;
};

/// Thrown when CURRENT or the manifest that it names is missing or altered: then no other file of the store can be
/// found.
class RootDamage : public Error {
 public:
  RootDamage(const std::string& store, std::string damaged, std::string reason);
  std::string what_is_damaged;  ///< "CURRENT", "the manifest"
  std::string why;
};

/// Thrown for a folder whose first build has not ended.
class NotComplete : public Error {
 public:
  using Error::Error;
};

// As JSON text; equal manifests give equal texts.
[[nodiscard]] std::string to_text(const Manifest& manifest);
[[nodiscard]] std::string to_text(const ShardInfo& shard);
/// Both check everything; roam::Error says what is wrong, with `name` for the file. They take at most `memory` bytes
/// for any text; those of a manifest include the text. `kept`: about how many of them an open store keeps, without the
/// text, or a little less.
[[nodiscard]] Manifest parse_manifest(std::string_view text, const std::string& name,
                                      std::uint64_t memory = Store::usual_memory, std::uint64_t* kept = nullptr);
[[nodiscard]] ShardInfo parse_shard(std::string_view text, const std::string& name,
                                    std::uint64_t memory = Store::usual_memory);
/// Throws NewerFormat.
void check_format(std::uint32_t version, const std::string& name);

/// Whether a folder contains parts of a store, even if CURRENT is missing.
[[nodiscard]] bool holds_store(const Folder& store);
/// Explains why a folder is not a store. Call it only if Store::is_store is false. Throws RootDamage if it was a store,
/// NotComplete if it is being built, and roam::Error otherwise.
[[noreturn]] void refuse_to_open(const Folder& store);

/// Reads CURRENT and its manifest, and checks the manifest against its name. Throws RootDamage, NewerFormat, and
/// roam::Error if a file cannot be read or takes more than `memory` bytes.
[[nodiscard]] Manifest read_manifest(StoreBytes& bytes, const std::string& store, std::string* hash = nullptr,
                                     std::uint64_t* text_bytes = nullptr, std::uint64_t memory = Store::usual_memory,
                                     std::uint64_t* kept = nullptr);
/// Writes manifests/<SHA-256>.json and replaces CURRENT, each by rename and with the folder synced. Returns the hash.
std::string publish(const Folder& store, const Manifest& manifest);
/// The same of a manifest's text.
std::string publish(const Folder& store, std::string_view text, std::uint32_t format);

/// A store's TriangleId: the page (numbered across all shards), the tile in the page, and the triangle in the tile.
inline constexpr int triangle_bits = 14, tile_bits = 10;
[[nodiscard]] constexpr TriangleId stored_id(std::uint64_t page, std::uint32_t tile, std::uint32_t triangle) {
  return page << (triangle_bits + tile_bits) | TriangleId{tile} << triangle_bits | triangle;
}

}  // namespace roam::store
