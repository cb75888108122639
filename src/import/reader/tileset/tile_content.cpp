#include "import/reader/tileset/tile_content.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "import/reader/gltf/gltf_file.h"
#include "import/reader/gltf/gltf_walk.h"
#include "import/reader/little_endian.h"
#include "import/reader/named_file.h"
#include "import/reader/tileset/feature_table.h"
#include "import/reader/tileset/gzip.h"
#include "import/reader/tileset/instances.h"
#include "import/reader/upright.h"
#include "roam/error.h"
#include "text/byte_order_mark.h"
#include "text/printable.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Composite tiles may be nested.
constexpr int most_nesting = 16;

class ContentReader {
 public:
  ContentReader(const fs::path& file, const TilePlace& place, SceneFiles& files, MeshSink& sink)
      : file_(file), place_(place), files_(files), sink_(sink) {}

  void read(std::string_view bytes, int nesting) {
    const std::string_view magic = bytes.substr(0, 4);
    if (magic == "b3dm") return read_batched(bytes);
    if (magic == "i3dm") return read_instanced(bytes);
    if (magic == "cmpt") return read_composite(bytes, nesting);
    switch (kind_of(bytes)) {
      case ContentKind::points:
        return sink_.report_note_once(fmt::format("{}: point clouds have no surface; they are left out.", name()));
      case ContentKind::mesh:
      case ContentKind::json:
        return add_gltf(bytes, {glm::dmat4(1.0)});
      case ContentKind::unknown:
        throw damaged(fmt::format("it begins with '{}', which no tile does", printable(magic)));
    }
  }

 private:
  [[nodiscard]] std::string name() const { return file_.string(); }
  [[nodiscard]] Error damaged(const std::string& what) const {
    return {name(), fmt::format("this is no tile that can be read: {}. The file is damaged.", what)};
  }

  /// The tables and the rest of a tile whose header has `header` bytes.
  struct Tables {
    std::string_view json, binary, rest;
  };
  [[nodiscard]] Tables tables(std::string_view bytes, std::size_t header) const {
    if (bytes.size() < header) throw damaged("it ends in its header");
    if (u32_at(bytes, 4) != 1) throw damaged(fmt::format("it is of version {}", u32_at(bytes, 4)));
    const std::uint64_t length = u32_at(bytes, 8);
    if (length > bytes.size()) throw damaged(fmt::format("it has {} bytes and states {}", bytes.size(), length));
    std::array<std::uint64_t, 4> sizes{u32_at(bytes, 12), u32_at(bytes, 16), u32_at(bytes, 20), u32_at(bytes, 24)};
    if (length < header || sizes[0] + sizes[1] + sizes[2] + sizes[3] > length - header) {
      throw damaged("its tables are longer than the tile");
    }
    bytes = bytes.substr(0, length);
    return {bytes.substr(header, sizes[0]), bytes.substr(header + sizes[0], sizes[1]),
            bytes.substr(header + sizes[0] + sizes[1] + sizes[2] + sizes[3])};
  }

  void read_batched(std::string_view bytes) {
    constexpr std::size_t header = 28;
    const Tables parts = tables(bytes, header);
    const FeatureTable features(parts.json, parts.binary, name());
    glm::dmat4 place(1.0);
    place[3] = glm::dvec4(features.global_vector("RTC_CENTER").value_or(Vec3(0.0)), 1.0);
    add_gltf(parts.rest, {place});
  }

  void read_instanced(std::string_view bytes) {
    constexpr std::size_t header = 32;
    const Tables parts = tables(bytes, header);
    const std::uint32_t format = u32_at(bytes, 28);
    const std::vector<glm::dmat4> places = instances_of(FeatureTable(parts.json, parts.binary, name()), name());
    if (format == 1) return add_gltf(parts.rest, places);
    // The tile names a file with the shape of its instances.
    std::string uri(parts.rest.substr(0, parts.rest.find('\0')));
    while (!uri.empty() && uri.back() == ' ') uri.pop_back();
    const auto look_up = [&](const fs::path& path) { return !files_.look_up(path).empty(); };
    const fs::path named = named_file(file_.parent_path(), uri, look_up);
    std::optional<std::string> content = named.empty() ? std::nullopt : whole_file(files_, named);
    if (!content) throw Error(name(), fmt::format("its shape '{}' is absent or cannot be read.", printable(uri, 100)));
    add_gltf(without_gzip(std::move(*content), named.string()), places, named);
  }

  void read_composite(std::string_view bytes, int nesting) {
    constexpr std::size_t header = 16;
    if (bytes.size() < header || u32_at(bytes, 4) != 1) throw damaged("its header is damaged");
    if (nesting == most_nesting)
      throw damaged(fmt::format("composite tiles are nested more than {} deep", most_nesting));
    const std::uint32_t tiles = u32_at(bytes, 12);
    std::string_view rest = bytes.substr(header);
    for (std::uint32_t i = 0; i < tiles; ++i) {
      const std::uint64_t length = u32_at(rest, 8);
      if (length < content_start_bytes || length > rest.size()) {
        throw damaged(fmt::format("its tile {} of {} reaches beyond its end", i + 1, tiles));
      }
      read(rest.substr(0, length), nesting + 1);
      rest.remove_prefix(length);
    }
  }

  void add_gltf(std::string_view bytes, const std::vector<glm::dmat4>& places, const fs::path& from = {}) {
    const fs::path& path = from.empty() ? file_ : from;
    if (is_gltf_1(bytes)) {
      throw Error(path.string(),
                  "it holds glTF 1.0, which is not read inside of tiles; upgrade the tileset, for example "
                  "with 3d-tiles-tools.");
    }
    GltfFile gltf(bytes, path, files_);
    GltfWalk walk(gltf, file_.stem().string(), sink_);
    for (const glm::dmat4& place : places) walk.walk(place_.to_scene * place, upright_from(place_.gltf_up));
    walk.finish();
  }

  const fs::path& file_;
  const TilePlace& place_;
  SceneFiles& files_;
  MeshSink& sink_;
};

}  // namespace

ContentKind kind_of(std::string_view bytes) {
  const std::string_view magic = bytes.substr(0, 4);
  for (const std::string_view mesh : {"b3dm", "i3dm", "cmpt", "glTF"}) {
    if (magic == mesh) return ContentKind::mesh;
  }
  // Vector tiles and geometry tiles were never part of the standard.
  for (const std::string_view other : {"pnts", "vctr", "geom"}) {
    if (magic == other) return ContentKind::points;
  }
  bytes = without_byte_order_mark(bytes);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '{' ? ContentKind::json : ContentKind::unknown;
}

std::uint64_t stated_bytes(std::string_view bytes) {
  const ContentKind kind = kind_of(bytes);
  return kind == ContentKind::mesh || kind == ContentKind::points ? u32_at(bytes, 8) : 0;
}

void add_tile_content(std::string bytes, const fs::path& file, const TilePlace& place, SceneFiles& files,
                      MeshSink& sink) {
  const std::string content = without_gzip(std::move(bytes), file.string());
  ContentReader(file, place, files, sink).read(content, 0);
}

std::optional<Error> read_tile_content(const fs::path& file, const TilePlace& place, SceneFiles& files,
                                       MeshSink& sink) {
  std::optional<std::string> bytes = whole_file(files, file);
  if (!bytes) return Error(file.string(), "this tile is absent or cannot be read.");
  sink.count_file();
  sink.report_more_progress(bytes->size());
  try {
    add_tile_content(std::move(*bytes), file, place, files, sink);
  } catch (const Error& error) {
    sink.report_note_once(error.what());
    return error;
  }
  return std::nullopt;
}

}  // namespace roam::reader
