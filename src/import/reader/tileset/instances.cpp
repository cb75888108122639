#include "import/reader/tileset/instances.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>

#include "import/reader/tileset/earth.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

using Values = std::optional<FeatureTable::Values>;

Vec3 vector_at(const FeatureTable::Values& values, std::uint64_t i) {
  return {values.at(i, 0), values.at(i, 1), values.at(i, 2)};
}

/// A unit vector from two 16-bit numbers: octahedral encoding (Cigolle et al. 2014).
Vec3 decoded_direction(const FeatureTable::Values& values, std::uint64_t i) {
  constexpr double largest = 65535.0;
  const double x = values.at(i, 0) / largest * 2.0 - 1.0, y = values.at(i, 1) / largest * 2.0 - 1.0;
  Vec3 v(x, y, 1.0 - std::abs(x) - std::abs(y));
  if (v.z < 0.0) {
    v.x = (1.0 - std::abs(y)) * (x >= 0.0 ? 1.0 : -1.0);
    v.y = (1.0 - std::abs(x)) * (y >= 0.0 ? 1.0 : -1.0);
  }
  return glm::normalize(v);
}

/// The directions of each instance, as floats or encoded.
class Directions {
 public:
  Directions(const FeatureTable& table, const char* plain, const char* encoded, std::uint64_t count)
      : plain_(table.each(plain, count, 3, true)), encoded_(table.each(encoded, count, 2, false)) {}
  [[nodiscard]] std::optional<Vec3> at(std::uint64_t i) const {
    if (plain_) return vector_at(*plain_, i);
    return encoded_ ? std::optional(decoded_direction(*encoded_, i)) : std::nullopt;
  }

 private:
  Values plain_, encoded_;
};

}  // namespace

std::vector<glm::dmat4> instances_of(const FeatureTable& table, const std::string& place) {
  const std::uint64_t count = table.global_count("INSTANCES_LENGTH");
  const Vec3 center = table.global_vector("RTC_CENTER").value_or(Vec3(0.0));
  const Values positions = table.each("POSITION", count, 3, true);
  const Values quantized = positions ? std::nullopt : table.each("POSITION_QUANTIZED", count, 3, false);
  const auto offset = table.global_vector("QUANTIZED_VOLUME_OFFSET"),
             scale = table.global_vector("QUANTIZED_VOLUME_SCALE");
  if (!positions && !(quantized && offset && scale)) {
    if (count == 0) return {};
    throw Error(place, "its instances have no positions; the tile is damaged.");
  }
  const Directions ups(table, "NORMAL_UP", "NORMAL_UP_OCT32P", count);
  const Directions rights(table, "NORMAL_RIGHT", "NORMAL_RIGHT_OCT32P", count);
  const Values scales = table.each("SCALE", count, 1, true),
               along_axes = table.each("SCALE_NON_UNIFORM", count, 3, true);
  const bool east_north_up = table.global_flag("EAST_NORTH_UP");

  std::vector<glm::dmat4> places;
  for (std::uint64_t i = 0; i < count; ++i) {
    constexpr double largest = 65535.0;
    const Vec3 position = positions ? vector_at(*positions, i) : vector_at(*quantized, i) / largest * *scale + *offset;
    glm::dmat4 matrix(1.0);
    const auto up = ups.at(i), right = rights.at(i);
    if (up && right) {
      // As the standard defines it: x to the right, y up, z forward.
      matrix = {glm::dvec4(*right, 0.0), glm::dvec4(*up, 0.0), glm::dvec4(glm::cross(*right, *up), 0.0), matrix[3]};
    } else if (east_north_up) {
      matrix = axes_at(geodetic(center + position));
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (scales) matrix[axis] *= scales->at(i, 0);
      if (along_axes) matrix[axis] *= along_axes->at(i, static_cast<unsigned>(axis));
    }
    matrix[3] = glm::dvec4(center + position, 1.0);
    places.push_back(matrix);
  }
  return places;
}

}  // namespace roam::reader
