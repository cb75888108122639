#include "import/reader/gltf/gltf_file.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "import/reader/gltf/meshopt.h"
#include "import/reader/little_endian.h"
#include "import/reader/named_file.h"
#include "roam/error.h"
#include "text/printable.h"

namespace roam::reader {
namespace {

constexpr int gltf_depth = 64;
constexpr std::string_view magic = "glTF";
constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;

}  // namespace

bool is_gltf_1(std::string_view bytes) {
  return bytes.size() >= header_bytes && bytes.starts_with(magic) && u32_at(bytes, 4) == 1;
}

GltfFile::GltfFile(std::string_view bytes, std::filesystem::path file, SceneFiles& files)
    : path_(std::move(file)), files_(files) {
  std::string_view text = bytes;
  if (bytes.starts_with(magic)) {
    if (bytes.size() < header_bytes + chunk_header_bytes) throw damaged("it ends in its header");
    if (u32_at(bytes, 4) != 2) throw damaged(fmt::format("it is binary glTF of version {}", u32_at(bytes, 4)));
    const std::size_t length = u32_at(bytes, 8);
    if (length > bytes.size()) throw damaged(fmt::format("it has {} bytes and states {}", bytes.size(), length));
    bytes = bytes.substr(0, length);
    std::size_t at = header_bytes;
    text = {};
    for (int chunk = 0; bytes.size() >= at && bytes.size() - at >= chunk_header_bytes; ++chunk) {
      const std::size_t size = u32_at(bytes, at);
      const std::string_view kind = bytes.substr(at + 4, 4);
      at += chunk_header_bytes;
      if (size > bytes.size() - at) throw damaged("a chunk is longer than the file");
      if (chunk == 0) {
        if (kind != "JSON") throw damaged("its first chunk is no JSON");
        text = bytes.substr(at, size);
      } else if (kind == std::string_view("BIN\0", 4) && !has_chunk_) {
        chunk_ = bytes.substr(at, size);
        has_chunk_ = true;
      }
      at += size;
    }
  } else if (const auto first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
             first == bytes.npos || bytes[first] != '{') {
    throw damaged("it begins neither as binary glTF nor as JSON");
  }
  json_ = parse_json(text, path_.string(), gltf_depth);
  if (!json_.is_object()) throw damaged("its JSON is no object");
}

Error GltfFile::damaged(const std::string& what) const {
  return {path_.string(), fmt::format("this is no glTF 2.0 that can be read: {}. The file is damaged.", what)};
}

const Json& GltfFile::item(const char* list, const Json& index) const {
  const Json& found =
      element(member(json_, list), whole_number(index).value_or(std::numeric_limits<std::uint64_t>::max()));
  if (!found.is_object()) throw damaged(fmt::format("it refers to one of its '{}' that is not there", list));
  return found;
}

std::span<const std::byte> GltfFile::buffer(const Json& index) {
  const Json& buffer = item("buffers", index);
  const std::uint64_t number = *whole_number(index);
  const std::string uri = text(member(buffer, "uri"));
  if (uri.empty()) {
    if (number != 0 || !has_chunk_) throw damaged(fmt::format("its buffer {} has no bytes", number));
    return std::as_bytes(std::span(chunk_));
  }
  const auto [at, is_new] = buffers_.try_emplace(number);
  if (is_new) {
    std::optional<std::string> bytes = named_bytes(files_, path_.parent_path(), uri);
    if (!bytes) {
      throw Error(path_.string(), fmt::format("its buffer '{}' is absent or cannot be read.", printable(uri, 100)));
    }
    at->second = std::move(*bytes);
  }
  return std::as_bytes(std::span(at->second));
}

std::span<const std::byte> GltfFile::stretch(const Json& of) {
  const std::span<const std::byte> bytes = buffer(member(of, "buffer"));
  const Json& begin = member(of, "byteOffset");
  const auto offset = begin.is_null() ? std::optional<std::uint64_t>(0) : whole_number(begin);
  const auto length = whole_number(member(of, "byteLength"));
  if (!offset || !length || *offset > bytes.size() || *length > bytes.size() - *offset) {
    throw damaged("a buffer view reaches beyond its buffer");
  }
  return bytes.subspan(*offset, *length);
}

std::span<const std::byte> GltfFile::view(std::uint64_t index) {
  const Json& view = item("bufferViews", index);
  const Json& compressed = member(view, "extensions", "EXT_meshopt_compression");
  return compressed.is_object() ? decompressed(compressed, index) : stretch(view);
}

std::span<const std::byte> GltfFile::decompressed(const Json& compressed, std::uint64_t index) {
  const auto [at, is_new] = decompressed_.try_emplace(index);
  if (is_new) {
    MeshoptStretch what;
    what.bytes = stretch(compressed);
    what.count = whole_number(member(compressed, "count")).value_or(0);
    what.stride = whole_number(member(compressed, "byteStride")).value_or(0);
    what.mode = text(member(compressed, "mode"));
    what.filter = text(member(compressed, "filter"));
    std::optional<std::vector<std::byte>> bytes = decode_meshopt(what);
    if (!bytes)
      throw damaged(fmt::format("its buffer view {} cannot be decompressed (EXT_meshopt_compression)", index));
    at->second = std::move(*bytes);
  }
  return at->second;
}

}  // namespace roam::reader
