#include "probe/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "cli/interrupt.h"
#include "draw/opening.h"
#include "probe/text.h"
#include "words/measures.h"
#include "words/probe.h"

namespace roam::app {
namespace {

using draw::OpeningView;
using draw::Overview;
using Kind = ProbeLimit::Kind;

/// Metres.
constexpr double sample = 0.01;                  ///< between rays that measure the depth of an opening, or a crack
constexpr double precise = 1e-4;                 ///< error of a crack's rims
constexpr double deepest = 1.0;                  ///< to each side; deeper openings are corridors
constexpr double as_narrow = 0.02;               ///< tolerance of an opening's width
constexpr double thinnest = 0.005;               ///< depth of a wall of zero thickness
constexpr double widest_gap = 2.5;               ///< of a crack, to each side
constexpr double before_step = 0.05;             ///< between the body and a step in front of it
constexpr std::uint64_t most_reached = 150'000;  ///< positions searched for a picture, from each end

Vec3 level(const Vec3& v) {
  const double length = std::hypot(v.x, v.y);
  return length > 0.0 ? Vec3(v.x / length, v.y / length, 0.0) : Vec3(0.0);
}

/// Moves a view to the middle of the opening's measured depth.
void centre(const Survey& survey, OpeningView& view) {
  const Vec3 across = level(view.direction), along(-across.y, across.x, 0.0);
  if (glm::length(Vec3(view.direction.x, view.direction.y, 0.0)) < 0.9) return;
  const double reach = 0.5 * view.width + as_narrow;
  const auto is_narrow = [&](double depth) {
    const Vec3 place = view.point + depth * along;
    double width = 0.0;
    for (const double side : {1.0, -1.0}) {
      const FirstImpact wall = survey.world().first_impact({0.0, 0.0}, place, side * reach * across);
      if (!wall.hit) return false;
      width += wall.time * reach;
    }
    return width <= view.width + as_narrow;
  };
  double far = 0.0, near = 0.0;
  while (far < deepest && is_narrow(far + sample)) far += sample;
  while (near > -deepest && is_narrow(near - sample)) near -= sample;
  if (far >= deepest || near <= -deepest) return;
  view.point += 0.5 * (far + near) * along;
  view.depth = std::max(far - near, thinnest);
}

OpeningView empty_view(const ProbeQuestion& question, const ProbeAnswer& answer) {
  const WalkerSettings body = probed_body(question, answer.size);
  OpeningView view;
  view.mode = question.mode;
  view.radius = body.radius;
  view.height = body.height;
  view.step = body.step;
  view.support_radius = question.mode == Mode::walk ? body.support_radius : 0.0;
  return view;
}

/// The deciding opening, with the body in it.
OpeningView view_of(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer) {
  const ProbeLimit& limit = *answer.limit;
  OpeningView view = empty_view(question, answer);
  view.heading = words::text_of(limit) + ", at " + words::at(limit.point);
  view.heading.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(view.heading.front())));
  view.point = limit.point;
  view.direction = limit.direction;
  view.width = limit.size;
  view.heading_to = limit.heading;
  view.fits = answer.wide_enough;
  view.floor = question.mode == Mode::fly ? limit.point.z - view.radius : limit.feet.z;
  if (((limit.kind == Kind::start || limit.kind == Kind::target) && !limit.too_low) || limit.kind == Kind::edge) {
    view.kind = OpeningView::Kind::beside;
    view.body = limit.feet;
  } else if (limit.kind == Kind::step) {
    view.kind = OpeningView::Kind::step;
    view.body = limit.point - (view.radius + before_step) * limit.heading;
  } else if (limit.kind == Kind::apart) {
    view.kind = OpeningView::Kind::apart;
    view.width = 0.0;
    view.heading_to = level(limit.direction);
    view.body = limit.point - (view.radius + 0.75 * question.spacing) * view.heading_to;
  } else {
    centre(survey, view);
  }
  return view;
}

/// The narrowest part of the crack into which the walker fell. None if the floor ends there.
std::optional<OpeningView> gap_view(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer) {
  const Vec3 place(answer.walk->at.x, answer.walk->at.y, answer.walk->on_way.z);
  const double step = question.step;
  const auto floor_at = [&](const Vec3& p) {
    return survey.floor().first_impact({0.0, 0.0}, p + Vec3(0.0, 0.0, step), {0.0, 0.0, -2.0 * step}).hit;
  };
  const auto rim = [&](const Vec3& way) {
    double away = 0.0;
    while (away < widest_gap && !floor_at(place + away * way)) away += sample;
    double open = std::max(0.0, away - sample);
    while (away - open > precise) (floor_at(place + 0.5 * (open + away) * way) ? away : open) = 0.5 * (open + away);
    return away;
  };
  OpeningView view = empty_view(question, answer);
  view.kind = OpeningView::Kind::crack;
  view.width = 2.0 * widest_gap;
  constexpr int directions = 36;
  for (int k = 0; k < directions; ++k) {
    const double angle = std::numbers::pi * k / directions;
    const Vec3 way(std::cos(angle), std::sin(angle), 0.0);
    const double ahead = rim(way), back = rim(-way);
    if (ahead >= widest_gap || back >= widest_gap || ahead + back >= view.width) continue;
    view.width = ahead + back;
    view.direction = way;
    view.point = place + 0.5 * (ahead - back) * way;
  }
  if (view.direction == Vec3(0.0) || view.width <= 0.0) return std::nullopt;
  view.floor = place.z;
  view.heading = fmt::format("Gap of the floor {:.3f} m wide, at {}", view.width, words::at(view.point));
  return view;
}

Overview overview_of(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer) {
  Overview overview;
  overview.mode = question.mode;
  overview.radius = answer.size.radius;
  overview.height = answer.size.height;
  overview.step = climbed(question, answer.size);
  overview.start = answer.start;
  overview.target = answer.target;
  overview.spacing = question.spacing;
  overview.way = answer.passage.way;
  for (const words::ProbeMark& mark : words::marks_of(answer))
    overview.marks.push_back({mark.place, mark.text, mark.good});
  if (overview.way.empty()) {
    ProbeQuestion asked = question;
    asked.progress = [](std::uint64_t) { return !interrupted(); };
    ProbeReach reach = probed_reach(survey, asked, answer, most_reached);
    overview.from_start = std::move(reach.from_start);
    overview.from_target = std::move(reach.from_target);
  }
  return overview;
}

}  // namespace

draw::Sheet sheet_of(const std::string& title, const Survey& survey, const ProbeQuestion& question,
                     const ProbeAnswer& answer) {
  std::vector<OpeningView> views;
  if (answer.walk && answer.walk->outcome == Outcome::fell) {
    if (auto gap = gap_view(survey, question, answer)) views.push_back(std::move(*gap));
  }
  if (answer.limit) views.push_back(view_of(survey, question, answer));
  return draw::opening_sheet(title, views, survey.meshes(), words::report(question, answer).sentences(),
                             overview_of(survey, question, answer));
}

}  // namespace roam::app
