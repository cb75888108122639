#include "draw/frames.h"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <numeric>

#include "draw/page.h"
#include "math/round_length.h"

namespace roam::draw {
namespace {

// Pixels.
constexpr double plan_least_height = 240.0;
constexpr double plan_most_height = 900.0;
constexpr double section_least_height = 170.0;
constexpr double section_most_height = 420.0;
constexpr double section_scale_width = 120.0;  ///< left of the section, for its heights
constexpr double least_body = 20.0;            ///< across; a smaller body needs details
constexpr double detail_most_width = 607.0;
constexpr double detail_height = 0.62;  ///< of its plan's width
constexpr std::size_t most_details = 4;

// The least share of the best turn's scale for a plan that is not turned, or turned by a right angle.
constexpr double unturned = 0.75;
constexpr double right_angled = 0.85;
constexpr double lowness = 0.4;
/// The whole scene is shown if its scale is at least this share.
constexpr double whole_scene = 0.45;
/// The section takes the plan's scale if it then fills this part of the width.
constexpr double section_part = 0.45;

Turn turn_by(double angle, const Vec3& origin) { return {origin, std::cos(angle), std::sin(angle)}; }

/// Places that a plan must show.
struct Sights {
  std::vector<Vec3> way;
  /// The ends of the room beside the way, as far as the survey measured; so they include the ends of the narrowest
  /// place.
  std::vector<Vec3> beside;
};

Sights find_sights(const Way& way, const RoomSurvey& survey, double radius) {
  Sights sights;
  for (const WayPoint& p : way.points) sights.way.push_back(p.position);
  for (const Station& s : survey.stations) {
    if (s.left < survey.reach) sights.beside.push_back(s.centre + (s.left + radius) * s.across);
    if (s.right < survey.reach) sights.beside.push_back(s.centre - (s.right + radius) * s.across);
  }
  if (survey.narrowest) {
    sights.beside.push_back(survey.narrowest->left);
    sights.beside.push_back(survey.narrowest->right);
  }
  return sights;
}

/// The visible part of the plan, with a margin.
Rect surroundings(const Sights& sights, const Turn& turn, double radius) {
  Rect r;
  for (const Vec3& p : sights.way) r.include(turn.plan(p));
  r = r.grown(std::max(8.0 * radius, 0.04 * std::max(r.width(), r.height())));
  Rect walls;
  for (const Vec3& p : sights.beside) walls.include(turn.plan(p));
  if (!walls.empty()) {
    walls = walls.grown(2.0 * radius);
    r.include(walls.lower);
    r.include(walls.upper);
  }
  return Rect::around(r.center(), std::max(r.width(), 40.0 * radius), std::max(r.height(), 16.0 * radius));
}

double fitting_scale(const Rect& r) { return std::min(content_width / r.width(), plan_most_height / r.height()); }

Turn choose_turn(const Way& way, const Sights& sights, double radius) {
  const Vec3 origin = way.points.front().position;
  const Vec3 end = way.points.back().position - origin;
  // A low plan may cost some scale. Otherwise each straight way would lie along the sheet's diagonal.
  const auto scale = [&](double angle) {
    const Rect r = surroundings(sights, turn_by(angle, origin), radius);
    const double fit = fitting_scale(r);
    return fit * (1.0 - lowness * r.height() * fit / plan_most_height);
  };
  constexpr double right_angle = 0.5 * std::numbers::pi;
  double best = std::atan2(end.y, end.x);
  for (int degrees = 0; degrees < 180; ++degrees) {
    const double angle = glm::radians(static_cast<double>(degrees));
    if (scale(angle) > scale(best)) best = angle;
  }
  if (scale(0.0) >= unturned * scale(best)) return turn_by(0.0, origin);
  if (scale(right_angle) >= right_angled * scale(best)) best = right_angle;
  const bool leads_left = turn_by(best, origin).plan(way.points.back().position).x < 0.0;
  return turn_by(best + (leads_left ? std::numbers::pi : 0.0), origin);
}

Frame plan_frame(const Sights& sights, const Turn& turn, const Box& scene, double radius) {
  Rect shown = surroundings(sights, turn, radius);
  Rect all = shown;
  for (const double x : {scene.lower.x, scene.upper.x}) {
    for (const double y : {scene.lower.y, scene.upper.y}) all.include(turn.plan({x, y, 0.0}));
  }
  all = all.grown(0.02 * all.width());
  if (fitting_scale(all) >= whole_scene * fitting_scale(shown)) shown = all;
  return Frame::fitted(shown, content_width, plan_least_height, plan_most_height);
}

void frame_section(Frames& frames, const Way& way, const RoomSurvey& survey, double body_height, double radius) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Station& s : survey.stations) {
    low = std::min({low, s.centre.z - 0.5 * s.height, s.floor.value_or(low)});
    high = std::max({high, s.centre.z + 0.5 * s.height, s.ceiling.value_or(high)});
  }
  low -= 0.4 * body_height;
  high += 0.4 * body_height;

  const double width = content_width - section_scale_width;
  const double beyond = std::max(4.0 * radius, 0.02 * way.length);
  const double length = way.length + 2.0 * beyond;
  double scale = width / length;
  const double plan = frames.plan.scale_x;
  if (length * plan <= width && length * plan >= section_part * width) scale = plan;
  scale = std::min({scale, std::max(plan, section_most_height / (4.0 * body_height))});
  if ((high - low) * scale > section_most_height) scale = section_most_height / (high - low);
  while ((high - low) * scale * frames.exaggeration < 0.8 * section_least_height) {
    frames.exaggeration = frames.exaggeration == 1.0 ? 2.0 : round_length(frames.exaggeration * 2.6);
  }
  frames.section_has_plan_scale = scale == plan;
  const double scale_y = scale * frames.exaggeration;
  const double missing = section_least_height / scale_y - (high - low);
  if (missing > 0.0) {
    low -= 0.5 * missing;
    high += 0.5 * missing;
  }
  // Below its part of the plan if possible, so that both can be compared.
  double left = -beyond;
  if (frames.section_has_plan_scale) {
    const double start = frames.turn.plan(way.points.front().position).x - frames.plan.view.lower.x;
    const double aligned = section_scale_width / scale - start;
    if (aligned <= -beyond && aligned + width / scale >= way.length + beyond) left = aligned;
  }
  frames.section = {{{left, low}, {left + width / scale, high}}, scale, scale_y};
}

void frame_details(Frames& frames, const RoomSurvey& survey, const std::vector<Mark>& marks,
                   const WalkerSettings& settings) {
  double size = std::max(28.0 * settings.radius, 4.0 * settings.height);  // metres across
  // The measure of the narrowest place should be visible whole, unless it is nearly open.
  if (survey.narrowest) size = std::clamp(survey.narrowest->width / detail_height * 1.2, size, 1.6 * size);
  if (2.0 * settings.radius * frames.plan.scale_x >= least_body) return;
  std::vector<std::size_t> order(marks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) { return i + 1 == marks.size() ? MarkKind::end : marks[i].kind; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  std::vector<Detail> details;
  for (const std::size_t i : order) {
    const auto near = std::find_if(details.begin(), details.end(), [&](const Detail& detail) {
      const Vec3 d = marks[detail.marks[0]].centre - marks[i].centre;
      return std::hypot(d.x, d.y) < 0.35 * size && std::abs(d.z) < settings.height;
    });
    if (near != details.end()) {
      near->marks.push_back(i);
    } else if (details.size() < most_details) {
      details.push_back({{i}, {}, {}});
    }
  }
  const auto count = static_cast<double>(details.size());
  const double width = std::min(detail_most_width, (content_width - (count - 1.0) * detail_gap) / count);
  const double scale = width / size;
  if (scale < 2.0 * frames.plan.scale_x) return;
  const double tall = std::clamp(2.2 * settings.height, 0.25 * size, 0.5 * size);
  for (Detail& detail : details) {
    const Mark& mark = marks[detail.marks[0]];
    detail.plan = {Rect::around(frames.turn.plan(mark.centre), size, detail_height * size), scale, scale};
    detail.section = {Rect::around({mark.along, mark.centre.z}, size, tall), scale, scale};
  }
  frames.details = std::move(details);
  std::sort(frames.details.begin(), frames.details.end(),
            [&](const Detail& a, const Detail& b) { return marks[a.marks[0]].along < marks[b.marks[0]].along; });
}

}  // namespace

Frames choose_frames(const Way& way, const RoomSurvey& survey, const std::vector<Mark>& marks, const Box& scene,
                     const WalkerSettings& settings) {
  Frames frames;
  const Sights sights = find_sights(way, survey, settings.radius);
  frames.turn = choose_turn(way, sights, settings.radius);
  frames.plan = plan_frame(sights, frames.turn, scene, settings.radius);
  frame_section(frames, way, survey, settings.height, settings.radius);
  frame_details(frames, survey, marks, settings);
  return frames;
}

}  // namespace roam::draw
