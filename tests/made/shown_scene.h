#pragma once
/// \file
/// The output of read_display, split into triangles, and compared with the result of import_scene.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "import/display.h"
#include "import/page_reader.h"
#include "import_files.h"

namespace roam::test {

using Colour = std::array<std::uint8_t, 4>;

/// A triangle with its display data.
struct ShownTriangle {
  Triangle corners;
  std::array<Colour, 3> colours;
  std::array<glm::vec3, 3> normals{};      ///< zero if there are none
  std::array<glm::vec2, 3> coordinates{};  ///< zero if there are none
  const DisplayTexture* image = nullptr;   ///< null if there is none
  DisplayLook look;
};

struct Shown {
  std::vector<ShownTriangle> triangles;
  std::vector<std::shared_ptr<DisplayPart>> parts;
  DisplayReport report;

  [[nodiscard]] std::vector<const DisplayGeometry*> geometries() const {
    std::vector<const DisplayGeometry*> all;
    for (const auto& part : parts) {
      for (const DisplayGeometry& geometry : part->geometries) all.push_back(&geometry);
    }
    return all;
  }
  [[nodiscard]] std::vector<const DisplayPages*> pages() const {
    std::vector<const DisplayPages*> all;
    for (const auto& part : parts) {
      for (const DisplayPages& pages : part->pages) all.push_back(&pages);
    }
    return all;
  }
};

/// The triangles of a part.
inline std::vector<ShownTriangle> triangles_of(const DisplayPart& part) {
  std::vector<ShownTriangle> all;
  for (const DisplayGeometry& geometry : part.geometries) {
    const DisplayLook& look = part.looks.at(geometry.look);
    for (std::size_t i = 0; i + 2 < geometry.indices.size(); i += 3) {
      ShownTriangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint16_t v = geometry.indices[i + k];
        triangle.corners[k] = Vec3(geometry.positions.at(v)) + geometry.cell + part.origin;
        triangle.colours[k] = geometry.colours.at(v);
        if (!geometry.normals.empty()) triangle.normals[k] = geometry.normals.at(v);
        if (!geometry.coordinates.empty()) triangle.coordinates[k] = geometry.coordinates.at(v);
      }
      if (look.texture != DisplayLook::no_texture) triangle.image = &part.textures.at(look.texture);
      triangle.look = look;
      all.push_back(triangle);
    }
  }
  return all;
}

inline Shown show(const std::vector<std::filesystem::path>& paths, const ImportOptions& options = {}) {
  Shown shown;
  shown.report = read_display(paths, options, [&](DisplayPart&& part) {
    shown.parts.push_back(std::make_shared<DisplayPart>(std::move(part)));
    const std::vector<ShownTriangle> triangles = triangles_of(*shown.parts.back());
    EXPECT_EQ(triangles.size(), shown.parts.back()->triangles);
    shown.triangles.insert(shown.triangles.end(), triangles.begin(), triangles.end());
    return true;
  });
  return shown;
}

/// The finest levels of a scene, page after page.
struct Finest : Shown {
  std::uint64_t pages_read = 0, images = 0, missing = 0;
  std::vector<std::string> notes;  ///< of the pages, and the errors of those that cannot be read
};

/// Adds what is seen of a part if every page is wanted: all that has no end, or else the level that stands in.
inline void add_finest(PageReader& reader, const DisplayPart& part, Finest& finest) {
  std::vector<bool> shown(part.groups, false);
  shown[0] = true;
  finest.missing += part.missing;
  finest.images += part.textures.size();
  finest.notes.insert(finest.notes.end(), part.notes.begin(), part.notes.end());
  for (const DisplayPages& node : part.pages) {
    if (!shown[node.group]) continue;
    const bool by_error = node.measure == DisplayMeasure::error;
    bool read = false;
    std::uint32_t last_group = 0;
    for (const DisplayLevel& level : node.levels) {
      if (level.group != 0) {
        last_group = level.group;
        if (by_error && level.to > 1.0f) shown[level.group] = read = true;
        continue;
      }
      try {
        const DisplayPart page = reader.read(part.source, part.origin, level.page);
        ++finest.pages_read;
        add_finest(reader, page, finest);
        read = true;
      } catch (const Error& error) {
        ++finest.missing;
        finest.notes.emplace_back(error.what());
      }
    }
    if (!read && last_group != 0) shown[last_group] = true;
  }
  DisplayPart kept = part;
  std::erase_if(kept.geometries, [&](const DisplayGeometry& g) { return !shown[g.group]; });
  for (ShownTriangle& triangle : triangles_of(kept)) {
    triangle.image = nullptr;
    finest.triangles.push_back(triangle);
  }
}

inline Finest show_finest(const std::vector<std::filesystem::path>& paths, const ImportOptions& options = {}) {
  Finest finest;
  const Shown roots = show(paths, options);
  finest.report = roots.report;
  PageReader reader(paths, options);
  for (const auto& part : roots.parts) add_finest(reader, *part, finest);
  return finest;
}

/// The pages of a scene with a single page at its root, read as they are named.
struct Paging {
  explicit Paging(const std::filesystem::path& file, const ImportOptions& options = {})
      : reader({file}, options), shown(show({file}, options)), report(shown.report) {
    if (shown.pages().size() != 1) throw std::runtime_error("the scene is not paged");
    first = *shown.pages()[0];
    root = page(first.levels.at(0));
  }
  DisplayPart page(const DisplayLevel& level) { return reader.read(0, report.origin, level.page); }
  std::string error(const DisplayLevel& level) {
    try {
      static_cast<void>(page(level));
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }

  PageReader reader;
  Shown shown;
  DisplayReport report;
  DisplayPages first;  ///< the node of the root
  DisplayPart root;
};

inline std::string display_error(const std::filesystem::path& path, const ImportOptions& options = {}) {
  try {
    const std::array<std::filesystem::path, 1> paths{path};
    read_display(paths, options, [](DisplayPart&&) { return true; });
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

/// The number of the scene's triangles that are not shown exactly once within `tolerance` metres, corner by corner.
inline std::size_t not_shown(const ImportedScene& scene, const Shown& shown, double tolerance) {
  using Cell = std::array<std::int64_t, 3>;
  const double size = 4.0 * tolerance;
  const auto cell_of = [&](const Vec3& v) {
    return Cell{std::llround(v.x / size), std::llround(v.y / size), std::llround(v.z / size)};
  };
  const auto near = [&](const Triangle& a, const Triangle& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(a[k][axis] - b[k][axis]) <= tolerance)) return false;
      }
    }
    return true;
  };
  std::multimap<Cell, const Triangle*> left;
  for (const ShownTriangle& triangle : shown.triangles) left.emplace(cell_of(triangle.corners[0]), &triangle.corners);
  std::size_t missing = 0;
  for (const Triangle& triangle : triangles_of(scene)) {
    const Cell cell = cell_of(triangle[0]);
    bool found = false;
    for (std::int64_t n = 0; n < 27 && !found; ++n) {
      const auto [first, last] = left.equal_range({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
      for (auto at = first; at != last && !found; ++at) {
        found = near(*at->second, triangle);
        if (found) {
          left.erase(at);
          break;
        }
      }
    }
    missing += found ? 0 : 1;
  }
  return missing + left.size();
}

/// An uncompressed image of one row, first texel left, as a BMP file.
inline std::string bmp(const std::vector<std::array<std::uint8_t, 3>>& row) {
  std::string texels;
  for (const auto& [r, g, b] : row) texels += bytes_of(b) + bytes_of(g) + bytes_of(r);
  texels.resize((texels.size() + 3) / 4 * 4);
  const auto u32 = [](std::size_t value) { return bytes_of(static_cast<std::uint32_t>(value)); };
  const auto u16 = [](unsigned value) { return bytes_of(static_cast<std::uint16_t>(value)); };
  return "BM" + u32(54 + texels.size()) + u32(0) + u32(54) + u32(40) + u32(row.size()) + u32(1) + u16(1) + u16(24) +
         u32(0) + u32(texels.size()) + u32(2835) + u32(2835) + u32(0) + u32(0) + texels;
}

using Row = std::vector<std::array<std::uint8_t, 3>>;
inline const Row two_texels{{255, 0, 0}, {0, 0, 255}};

/// The colours of the lowest row of an image.
inline Row row_of(const DisplayTexture& image) {
  EXPECT_EQ(image.texels, DisplayTexels::rgb);
  Row row;
  for (std::uint32_t s = 0; s < image.width; ++s) {
    row.push_back({image.bytes.at(3 * s), image.bytes.at(3 * s + 1), image.bytes.at(3 * s + 2)});
  }
  return row;
}

}  // namespace roam::test
