#include "view/measuring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "measure/room.h"
#include "text/number.h"
#include "text/printable.h"

namespace roam::app {
namespace {

/// "12.345, 5.600, 1.200, Door_12, wall facing 135° (SE)"
std::string point_text(const Pick& pick) {
  const Vec3& p = pick.point;
  const std::string object = pick.object.empty() ? std::string() : printable(pick.object) + ", ";
  return fmt::format("{}, {}, {}, {}{}", fixed_text(p.x, 3), fixed_text(p.y, 3), fixed_text(p.z, 3), object,
                     surface_text(pick.normal));
}

std::string span_text(const Span& span) {
  return fmt::format("{:.3f} m: {:.3f} m level, {:.3f} m {}, slope {:.1f}\u00b0", span.distance, span.level,
                     std::abs(span.height), span.height < 0.0 ? "down" : "up", std::abs(span.slope_degrees));
}

}  // namespace

std::string surface_text(const Vec3& normal) {
  constexpr double level_cosine = 0.7071;  // 45 degrees
  const double slope = glm::degrees(std::acos(std::min(std::abs(normal.z), 1.0)));
  if (std::abs(normal.z) > level_cosine)
    return fmt::format("{}, slope {:.0f}\u00b0", normal.z > 0.0 ? "floor" : "ceiling", slope);
  const auto [bearing, wind] = bearing_of(glm::degrees(std::atan2(normal.y, normal.x)));
  std::string text = fmt::format("wall facing {}\u00b0 ({})", bearing, wind);
  constexpr double upright = 89.5;  // degrees
  if (slope < upright) text += fmt::format(", {}slope {:.0f}\u00b0", normal.z < 0.0 ? "overhanging, " : "", slope);
  return text;
}

Span span_of(const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double level = std::hypot(way.x, way.y);
  return {glm::length(way), level, way.z, glm::degrees(std::atan2(way.z, level))};
}

void Measuring::take(const Pick& pick) {
  if (shown_ && !all_.empty() && !all_.back().b) {
    all_.back().b = pick;
  } else {
    all_.push_back({pick, std::nullopt});
  }
  shown_ = true;
  from_body_ = false;
  space_ = roamer_.space();
}

/// A pager's names are known some time after the click.
void Measuring::name(Pick& pick) const {
  const std::shared_ptr<const Space> space = roamer_.space();
  if (pick.object.empty() && space != nullptr && space == space_.lock())
    pick.object = space->object_name(pick.triangle);
}

void Measuring::fill(Status& status) {
  if (roamer_.walker() != nullptr && roamer_.mode() != Mode::ghost) {
    status.tool.push_back({"clear", room_text(roamer_)});
  }
  if (!shown_) return;
  Measurement& last = all_.back();
  name(last.a);
  if (from_body_) status.tool.push_back({"A", "the body's place"});
  const auto add = [&](const char* label, const Pick& pick) {
    status.tool.push_back({label, point_text(pick)});
    if (status.georeference) status.tool.push_back({"site", site_text(status, pick.point)});
  };
  add(from_body_ ? "B" : "A", last.a);
  if (!last.b) return;
  name(*last.b);
  add("B", *last.b);
  status.tool.push_back({"A to B", span_text(span_of(last.a.point, last.b->point))});
}

void Measuring::add_to(graphics::Marks& marks, const Vec3& origin) const {
  if (!shown_) return;
  const Measurement& last = all_.back();
  const Vec3 a = last.a.point - origin;
  marks.points.push_back(a);
  marks.labels.push_back({a, from_body_ ? "B" : "A"});
  if (!last.b) return;
  const Vec3 b = last.b->point - origin;
  marks.points.push_back(b);
  marks.lines.push_back({a, b});
  marks.labels.push_back({b, "B"});
  marks.labels.push_back({0.5 * (a + b), fmt::format("{:.3f} m", glm::distance(a, b))});
}

std::string text_of(const Measurement& measurement) {
  const auto& [a, b] = measurement;
  if (!b) return "A " + point_text(a);
  return fmt::format("A {}; B {}; {}", point_text(a), point_text(*b), span_text(span_of(a.point, b->point)));
}

std::string room_text(const osgRoam::Manipulator& roamer) {
  const Walker& walker = *roamer.walker();
  const WalkerSettings settings = walker.settings();
  const measure::Room room(walker.space(), settings, walker.mode());
  const Body body = walker.body();
  const Vec3 right(std::sin(roamer.yaw()), -std::cos(roamer.yaw()), 0.0);
  const measure::Free beside[] = {room.beside(body, walker.position(), right),
                                  room.beside(body, walker.position(), -right)};
  const measure::Free above = room.headroom(body, walker.position());
  const double width = 2.0 * body.radius + beside[0].distance + beside[1].distance;
  const auto at_least = [](bool bounded) { return bounded ? "" : "over "; };
  return fmt::format("{}{:.2f} m wide, {}{:.2f} m high", at_least(beside[0].bounded && beside[1].bounded), width,
                     at_least(above.bounded), above.distance);
}

}  // namespace roam::app
