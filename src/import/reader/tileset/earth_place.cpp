#include "import/reader/tileset/earth_place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "import/reader/tileset/earth.h"
#include "import/reader/tileset/tile_json.h"
#include "roam/error.h"
#include "text/reference_system.h"

namespace roam::reader {
namespace {

/// Heights of a scene's centre that the surface of the Earth has, in metres.
constexpr double lowest = -1000.0, highest = 10000.0;
constexpr double earth_radius = 6.37e6;

/// Radians. The middle of a wider volume says little about where its tiles are: some tilesets have a root of the whole
/// Earth.
constexpr double widest = 10.0 * std::numbers::pi / 180.0;

struct Extent {
  Geodetic middle;
  double width = 0.0;  ///< radians
};

/// Where a bounding volume lies on the Earth; unset if it does not seem to.
std::optional<Extent> extent_of(const Json& volume, const glm::dmat4& transform) {
  if (const auto region = numbers(member(volume, "region"), 6)) {
    const auto& r = *region;
    // A region may cross the meridian of 180 degrees.
    const double east = r[2] < r[0] ? r[2] + 2.0 * std::numbers::pi : r[2];
    const Geodetic middle{0.5 * (r[1] + r[3]), std::remainder(0.5 * (r[0] + east), 2.0 * std::numbers::pi),
                          0.5 * (r[4] + r[5])};
    return Extent{middle, std::max(east - r[0], r[3] - r[1])};
  }
  Vec3 center{0.0};
  double radius = 0.0;
  if (const auto box = numbers(member(volume, "box"), 12)) {
    const auto& b = *box;
    center = {b[0], b[1], b[2]};
    for (std::size_t axis = 3; axis < 12; axis += 3) radius += std::hypot(b[axis], b[axis + 1], b[axis + 2]);
  } else if (const auto sphere = numbers(member(volume, "sphere"), 4)) {
    center = {(*sphere)[0], (*sphere)[1], (*sphere)[2]};
    radius = (*sphere)[3];
  } else {
    return std::nullopt;
  }
  center = Vec3(transform * glm::dvec4(center, 1.0));
  if (!(glm::length(center) > 0.9 * earth_radius && glm::length(center) < 1.1 * earth_radius)) return std::nullopt;
  const Geodetic place = geodetic(center);
  // The centre of a wide volume lies below the surface, which is curved.
  const double sagitta = 0.5 * radius * radius / earth_radius;
  const bool near = place.height > lowest - sagitta && place.height < highest;
  return near ? std::optional(Extent{place, 2.0 * radius / earth_radius}) : std::nullopt;
}

/// The place of the first tile below `root` that is narrow enough; unset if there is none.
std::optional<Extent> narrow_extent_below(const Json& root, const glm::dmat4& transform, const std::string& tileset) {
  std::vector<std::pair<const Json*, glm::dmat4>> open{{&root, transform}};
  while (!open.empty()) {
    const auto [tile, matrix] = open.back();
    open.pop_back();
    const std::optional<Extent> place = extent_of(member(*tile, "boundingVolume"), matrix);
    if (place && place->width <= widest) return place;
    const Json& children = member(*tile, "children");
    for (std::size_t i = children.is_array() ? children.size() : 0; i > 0; --i) {
      open.emplace_back(&children[i - 1], matrix * transform_of(children[i - 1], tileset));
    }
  }
  return std::nullopt;
}

}  // namespace

EarthPlace place_on_earth(const Json& root, const glm::dmat4& transform, const std::string& tileset,
                          const ReadingSettings& settings) {
  EarthPlace result;
  if (settings.up) return result;
  std::optional<Extent> extent = extent_of(member(root, "boundingVolume"), transform);
  const bool is_wide = extent && extent->width > widest;
  if (is_wide) extent = narrow_extent_below(root, transform, tileset).value_or(*extent);
  if (!extent) {
    if (settings.frame) {
      result.notes.push_back(fmt::format(
          "{}: its place relative to the folders before is not known; its coordinates are taken as they are.",
          tileset));
    }
    return result;
  }
  std::optional<LocalFrame> frame = LocalFrame::near(extent->middle);
  if (settings.frame) {
    frame = LocalFrame::of(settings.frame->srs);
    if (!frame) {
      throw Error(tileset,
                  fmt::format("its tiles have Earth-centred coordinates, and the scene before is in '{}'; bring "
                              "them into one system first.",
                              reference_name(settings.frame->srs)));
    }
    result.to_scene = frame->local(glm::dmat4(1.0));
    result.to_scene[3] -= glm::dvec4(settings.frame->origin, 0.0);
    result.notes.push_back(
        fmt::format("{}: its Earth-centred coordinates are moved to the local frame '{}' of the scene.", tileset,
                    settings.frame->srs));
    return result;
  }
  result.to_scene = frame->local(glm::dmat4(1.0));
  result.georeference = Georeference{frame->srs(), Vec3(0.0)};
  result.notes.push_back(fmt::format(
      "{}: its Earth-centred coordinates are moved to the local frame '{}': x to the east, y to the north, z "
      "is the height above the ellipsoid WGS 84. --up=z leaves them as they are.",
      tileset, frame->srs()));
  if (is_wide) {
    result.notes.push_back(fmt::format(
        "{}: its tiles may be all over the Earth; the ground is level only near the place of the frame.", tileset));
  }
  return result;
}

}  // namespace roam::reader
