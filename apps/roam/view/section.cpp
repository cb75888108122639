#include "view/section.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "cli/exit_status.h"
#include "roam/space.h"
#include "text/number.h"
#include "text/stream_of.h"

namespace roam::app {
namespace {

/// Metres behind a clicked surface, so that it is hidden too.
constexpr double behind = 0.02;

HalfSpace beyond(int axis, double sign, double value) {
  HalfSpace half{Vec3(0.0), sign * value};
  half.normal[axis] = sign;
  return half;
}

bool to_metres(const std::string& text, double& value) {
  return CLI::detail::lexical_cast(text, value) && std::abs(value) <= coordinate_limit;
}

/// The box of "0 0 0, 10 10 3", which follows the word "box".
Box parse_box(const std::string& text, const std::string& where) {
  std::string numbers = text;
  std::replace(numbers.begin(), numbers.end(), ',', ' ');
  std::istringstream words = stream_of(numbers);
  std::array<double, 6> value{};
  std::size_t count = 0;
  for (std::string word; words >> word; ++count) {
    if (count == value.size() || !to_metres(word, value[count])) count = value.size() + 1;
    if (count > value.size()) break;
  }
  if (count != value.size()) {
    throw UsageError(where, "a box is two opposite corners in metres, e.g. 'box 0 0 0, 10 10 3'");
  }
  Box box;
  box.include(Vec3(value[0], value[1], value[2]));
  box.include(Vec3(value[3], value[4], value[5]));
  const Vec3 size = box.size();
  if (!(std::min({size.x, size.y, size.z}) >= Section::least_side)) {
    throw UsageError(where,
                     fmt::format("the corners of a box differ by {} m at least, in x, y and z", Section::least_side));
  }
  return box;
}

}  // namespace

std::vector<HalfSpace> SectionShape::hidden() const {
  std::vector<HalfSpace> all = planes;
  for (int axis = 0; box && axis < 3; ++axis) {
    all.push_back(beyond(axis, 1.0, box->upper[axis]));
    all.push_back(beyond(axis, -1.0, box->lower[axis]));
  }
  return all;
}

std::string place_text(const HalfSpace& plane) {
  constexpr double straight = 0.9999;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(plane.normal[axis]) < straight) continue;
    return fmt::format("{} = {} m", "xyz"[axis], fixed_text(plane.distance / plane.normal[axis], 2));
  }
  const Vec3& n = plane.normal;
  return fmt::format("{:.2f} m along ({:.2f}, {:.2f}, {:.2f})", plane.distance, n.x, n.y, n.z);
}

std::string size_text(const Box& box) {
  const Vec3 size = box.size();
  return fmt::format("{:.2f} x {:.2f} x {:.2f} m", size.x, size.y, size.z);
}

void add_section(const std::string& text, SectionShape& shape) {
  const std::string where = "--section " + text;
  const std::string box = "box ";
  if (text.starts_with(box)) {
    if (shape.box) throw UsageError(where, "there is one box at most");
    shape.box = parse_box(text.substr(box.size()), where);
    return;
  }
  const std::size_t axis = text.empty() ? std::string::npos : std::string("xyz").find(text[0]);
  const bool below = text.size() > 1 && text[1] == '<', above = text.size() > 1 && text[1] == '>';
  double value = 0.0;
  if (axis == std::string::npos || !(below || above) || !to_metres(text.substr(2), value)) {
    throw UsageError(where,
                     "a section is x, y or z, then < or >, then metres, e.g. 'z<2.5'; or 'box' and two corners, "
                     "e.g. 'box 0 0 0, 10 10 3'");
  }
  if (shape.planes.size() == SectionShape::most_planes) {
    throw UsageError("--section", fmt::format("there are at most {} planes", SectionShape::most_planes));
  }
  shape.planes.push_back(beyond(static_cast<int>(axis), below ? 1.0 : -1.0, value));
}

void Section::cut(const Pick& pick) {
  const HalfSpace plane{pick.normal, glm::dot(pick.normal, pick.point) - behind};
  if (shape_.planes.size() == SectionShape::most_planes) shape_.planes.pop_back();
  shape_.planes.push_back(plane);
}

void Section::move(double notches, const Vec3& eye) {
  constexpr double least = 0.05, share = 0.04;  // metres; of the distance
  if (shape_.planes.empty()) return;
  HalfSpace& plane = shape_.planes.back();
  const double distance = std::abs(glm::dot(plane.normal, eye) - plane.distance);
  plane.distance -= notches * std::max(least, share * distance);
}

void Section::show(osg::Group& scene, const Vec3& origin) {
  std::vector<HalfSpace> wanted = shape_.hidden();
  for (HalfSpace& half : wanted) half.distance -= glm::dot(half.normal, origin);
  if (wanted == shown_) return;
  graphics::set_section(scene, wanted);
  shown_ = std::move(wanted);
}

}  // namespace roam::app
