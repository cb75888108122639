#include "import/reader/tileset/subtree.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <utility>

#include "import/reader/named_file.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

constexpr int subtree_depth = 32;
/// Numbers of tiles fit into 64 bits.
constexpr std::uint64_t most_subtree_bits = 60, most_levels = 60;

/// The number of tiles in the first `levels` levels of a subtree.
std::uint64_t tiles_in(std::uint64_t levels, unsigned dimensions) {
  return ((std::uint64_t{1} << levels * dimensions) - 1) / ((1u << dimensions) - 1);
}

}  // namespace

std::optional<ImplicitTiling> ImplicitTiling::of(const Json& tile, const std::string& place) {
  const Json& own = member(tile, "implicitTiling");
  const Json& tiling = own.is_object() ? own : member(tile, "extensions", "3DTILES_implicit_tiling");
  if (!tiling.is_object()) return std::nullopt;
  ImplicitTiling read;
  const std::string scheme = text(member(tiling, "subdivisionScheme"));
  read.dimensions = scheme == "OCTREE" ? 3 : 2;
  read.subtree_levels = whole_number(member(tiling, "subtreeLevels")).value_or(0);
  const auto last = whole_number(member(tiling, "maximumLevel"));
  read.levels = last ? std::min(*last, most_levels) + 1 : whole_number(member(tiling, "availableLevels")).value_or(0);
  read.subtrees = text(member(member(tiling, "subtrees"), "uri"));
  if ((scheme != "QUADTREE" && scheme != "OCTREE") || read.subtree_levels == 0 || read.levels == 0 ||
      read.subtrees.empty() || read.subtree_levels > most_subtree_bits / read.dimensions || read.levels > most_levels) {
    throw Error(place,
                "its implicit tiling has no scheme, levels or subtrees that can be read; the tileset is damaged.");
  }
  return read;
}

ImplicitTile ImplicitTiling::child(const ImplicitTile& tile, unsigned which) const {
  ImplicitTile child;
  child.level = tile.level + 1;
  child.x = 2 * tile.x + (which & 1);
  child.y = 2 * tile.y + (which >> 1 & 1);
  child.z = dimensions == 3 ? 2 * tile.z + (which >> 2 & 1) : 0;
  child.level_in_subtree = tile.level_in_subtree + 1;
  child.number = (tile.number << dimensions) + which;
  return child;
}

std::string ImplicitTiling::uri(const std::string& from, const ImplicitTile& tile) {
  std::string uri = from;
  const std::pair<std::string_view, std::uint64_t> names[] = {
      {"{level}", tile.level}, {"{x}", tile.x}, {"{y}", tile.y}, {"{z}", tile.z}};
  for (const auto& [name, value] : names) {
    for (std::size_t at = 0; (at = uri.find(name, at)) != std::string::npos;) {
      uri.replace(at, name.size(), std::to_string(value));
    }
  }
  return uri;
}

Subtree::Subtree(std::string bytes, const std::filesystem::path& file, const ImplicitTiling& tiling, SceneFiles& files)
    : tiling_(tiling), file_(file), files_(files), bytes_(std::move(bytes)) {
  std::string_view text = bytes_;
  if (text.starts_with("subt")) {
    constexpr std::size_t header = 24;
    std::uint64_t sizes[2] = {};
    if (text.size() < header) throw Error(file_.string(), "this subtree ends in its header; the file is damaged.");
    std::memcpy(sizes, text.data() + 8, sizeof(sizes));
    if (sizes[0] > text.size() - header || sizes[1] > text.size() - header - sizes[0]) {
      throw Error(file_.string(), "this subtree is longer than its file; the file is damaged.");
    }
    chunk_ = text.substr(header + sizes[0], sizes[1]);
    text = text.substr(header, sizes[0]);
  }
  json_ = parse_json(text, file_.string(), subtree_depth);
  const Json& buffers = member(json_, "buffers");
  buffers_.resize(buffers.is_array() ? buffers.size() : 0);
  tiles_ = bits(member(json_, "tileAvailability"), tiles_in(tiling.subtree_levels, tiling.dimensions));
  subtrees_ =
      bits(member(json_, "childSubtreeAvailability"), std::uint64_t{1} << tiling.subtree_levels * tiling.dimensions);
  const Json& several = member(member(json_, "extensions", "3DTILES_multiple_contents"), "contentAvailability");
  const Json& contents = several.is_null() ? member(json_, "contentAvailability") : several;
  for (const Json& one : contents.is_object() ? Json::array({contents}) : contents) {
    contents_.push_back(bits(one, tiles_in(tiling.subtree_levels, tiling.dimensions)));
  }
}

Error Subtree::damaged(const char* what) const {
  return {file_.string(), fmt::format("{} of this subtree; the file is damaged.", what)};
}

bool Subtree::Bits::operator[](std::uint64_t i) const {
  if (bytes.empty()) return constant;
  return i / 8 < bytes.size() && (static_cast<unsigned char>(bytes[i / 8]) >> i % 8 & 1) != 0;
}

Subtree::Bits Subtree::bits(const Json& availability, std::uint64_t count) {
  if (const Json& constant = member(availability, "constant"); !constant.is_null()) {
    return {whole_number(constant).value_or(0) != 0, {}};
  }
  const Json& stream = member(availability, "bitstream");
  const auto index = whole_number(stream.is_null() ? member(availability, "bufferView") : stream);
  if (!index) {
    if (availability.is_null()) return {};
    throw damaged("an availability is no number");
  }
  const Json& view = element(member(json_, "bufferViews"), *index);
  const std::string_view from = buffer(whole_number(member(view, "buffer")).value_or(buffers_.size()));
  const auto offset = whole_number(member(view, "byteOffset")), length = whole_number(member(view, "byteLength"));
  if (!offset || !length || *offset > from.size() || *length > from.size() - *offset) {
    throw damaged("a buffer view reaches beyond a buffer");
  }
  if ((count + 7) / 8 > *length) throw damaged("there are fewer bits than tiles");
  return {false, from.substr(*offset, *length)};
}

std::string_view Subtree::buffer(std::uint64_t index) {
  if (index >= buffers_.size()) throw damaged("a buffer is missing");
  const std::string uri = text(member(member(json_, "buffers")[index], "uri"));
  if (uri.empty()) return chunk_;
  if (!buffers_[index]) {
    std::optional<std::string> bytes = named_bytes(files_, file_.parent_path(), uri);
    if (!bytes) throw damaged("a buffer is absent");
    buffers_[index] = std::move(*bytes);
  }
  return *buffers_[index];
}

std::uint64_t Subtree::index_of(const ImplicitTile& tile) const {
  return tiles_in(tile.level_in_subtree, tiling_.dimensions) + tile.number;
}

bool Subtree::has_tile(const ImplicitTile& tile) const { return tiles_[index_of(tile)]; }

bool Subtree::has_content(const ImplicitTile& tile, std::size_t which) const {
  return which < contents_.size() && contents_[which][index_of(tile)];
}

bool Subtree::has_subtree(const ImplicitTile& tile) const { return subtrees_[tile.number]; }

}  // namespace roam::reader
