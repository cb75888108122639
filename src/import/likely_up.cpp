#include "import/likely_up.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>
#include <system_error>

#include "files/extension.h"
#include "math/boxes.h"
#include "math/floating_point.h"

namespace roam {
namespace {

constexpr double more = 1.3;        ///< mean squares of the likely axis over those of the others
constexpr double alike = 0.5;       ///< of those of the two other axes, at least
constexpr double curved = 0.02;     ///< of the area beside the likely axis: a plane says nothing
constexpr double one_sided = 0.3;   ///< mean of the normals along the axis, of a surface seen from one side
constexpr double level = 0.985;     ///< cosine of 10 degrees: steepest level face
constexpr double end = 0.06;        ///< of the height, at either end: lowest floor and highest ceiling
constexpr double things = 0.02;     ///< level area between the ends, of all area, at least
constexpr double off_centre = 0.1;  ///< of the height, from its middle to the mean of that level area

/// Sums over triangles, weighted by area. The arrays are along x, y and z.
struct Sums {
  double area = 0.0;
  std::array<double, 3> square{};  ///< of the unit normals
  std::array<double, 3> normal{};
  std::array<double, 3> between{};  ///< area of level faces between the ends
  std::array<double, 3> height{};   ///< of these faces, as a part of the box
};

void add(Sums& sums, const Triangle& t, const Box& box) {
  const Vec3 cross = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double length = glm::length(cross);
  if (!(length > 0.0)) return;
  const double area = 0.5 * length;
  sums.area += area;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double along = cross[k] / length;
    sums.square[i] += area * along * along;
    sums.normal[i] += area * along;
    if (std::abs(along) < level) continue;
    const double height = (t[0][k] - box.lower[k]) / (box.upper[k] - box.lower[k]);
    if (!(height > end && height < 1.0 - end)) continue;
    sums.between[i] += area;
    sums.height[i] += area * height;
  }
}

Sums sums_of(std::span<const Mesh> meshes) {
  Box box;
  for (const Mesh& mesh : meshes) box.include(box_around(mesh.vertices));
  Sums sums;
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) add(sums, mesh.triangle(i), box);
  }
  return sums;
}

/// 1 if plus the axis is up, -1 if minus, 0 if unclear.
int sign_along(const Sums& sums, std::size_t axis) {
  const double facing = sums.normal[axis] / sums.area;
  if (std::abs(facing) >= one_sided) return facing > 0.0 ? 1 : -1;
  if (sums.between[axis] < things * sums.area) return 0;
  const double height = sums.height[axis] / sums.between[axis] - 0.5;
  return std::abs(height) < off_centre ? 0 : height < 0.0 ? 1 : -1;
}

}  // namespace

bool states_up(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 7> extensions{".glb", ".gltf", ".dae", ".fbx", ".ifc", ".3mf", ".blend"};
  std::error_code none;
  const bool is_tileset = std::filesystem::exists(path / "tileset.json", none);
  return (std::filesystem::is_directory(path, none) && !is_tileset) ||
         std::find(extensions.begin(), extensions.end(), files::lower_extension(path)) != extensions.end();
}

std::optional<UpAxis> likely_up(std::span<const Mesh> meshes) {
  const DefaultFloatingPoint guard;
  const Sums sums = sums_of(meshes);
  const std::size_t axis = sums.square[1] > sums.square[0] ? 1 : 0;
  const double likely = sums.square[axis], other = sums.square[1 - axis], present = sums.square[2];
  const bool clear = likely >= more * std::max(other, present) &&
                     std::min(other, present) >= alike * std::max(other, present) &&
                     other + present >= curved * sums.area && sums.area > 0.0;
  const int sign = clear ? sign_along(sums, axis) : 0;
  if (sign == 0) return std::nullopt;
  if (axis == 0) return sign > 0 ? UpAxis::x : UpAxis::minus_x;
  return sign > 0 ? UpAxis::y : UpAxis::minus_y;
}

bool stands_upright(std::span<const Mesh> meshes) {
  const DefaultFloatingPoint guard;
  const Sums sums = sums_of(meshes);
  const auto [x, y, z] = sums.square;
  return z >= more * std::max(x, y) && std::min(x, y) >= alike * std::max(x, y) && x + y >= curved * sums.area &&
         sums.area > 0.0 && sign_along(sums, 2) >= 0;
}

}  // namespace roam
