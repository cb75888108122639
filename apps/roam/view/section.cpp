#include "view/section.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cli/exit_status.h"
#include "roam/space.h"

namespace roam::app {
namespace {

/// Metres behind a clicked surface, so that it is hidden too.
constexpr double behind = 0.02;

}  // namespace

graphics::SectionPlane parse_section(const std::string& text) {
  const std::size_t axis = text.empty() ? std::string::npos : std::string("xyz").find(text[0]);
  const bool below = text.size() > 1 && text[1] == '<', above = text.size() > 1 && text[1] == '>';
  double value = 0.0;
  if (axis == std::string::npos || !(below || above) || !CLI::detail::lexical_cast(text.substr(2), value) ||
      !(std::abs(value) <= coordinate_limit)) {
    throw UsageError("--section " + text, "a section is x, y or z, then < or >, then metres, e.g. 'z<2.5'");
  }
  graphics::SectionPlane plane{Vec3(0.0), below ? value : -value};
  plane.normal[static_cast<int>(axis)] = below ? 1.0 : -1.0;
  return plane;
}

void Section::cut(const Pick& pick) {
  const graphics::SectionPlane plane{pick.normal, glm::dot(pick.normal, pick.point) - behind};
  if (planes_.size() == graphics::most_section_planes) planes_.pop_back();
  planes_.push_back(plane);
}

void Section::move(double notches, const Vec3& eye) {
  constexpr double least = 0.05, share = 0.04;  // metres; of the distance
  if (planes_.empty()) return;
  graphics::SectionPlane& plane = planes_.back();
  const double distance = std::abs(glm::dot(plane.normal, eye) - plane.distance);
  plane.distance -= notches * std::max(least, share * distance);
}

void Section::clear() { planes_.clear(); }

void Section::show(osg::Group& scene, const Vec3& origin) {
  std::vector<graphics::SectionPlane> wanted = planes_;
  for (graphics::SectionPlane& plane : wanted) plane.distance -= glm::dot(plane.normal, origin);
  if (wanted == shown_) return;
  graphics::set_section(scene, wanted);
  shown_ = std::move(wanted);
}

}  // namespace roam::app
