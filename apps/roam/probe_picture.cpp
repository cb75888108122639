#include "probe_picture.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "picture/opening.h"

namespace roam::app {
namespace {

using picture::OpeningView;

std::string at(const Vec3& p) { return fmt::format("({:.2f}, {:.2f}, {:.2f})", p.x, p.y, p.z); }

/// What decides, with the body in it.
OpeningView view_of(const ProbeQuestion& question, const ProbeAnswer& answer) {
  const Limit& limit = *answer.limit;
  const WalkerSettings body = settings_of(question, answer.size);
  OpeningView view;
  view.heading = text_of(limit) + " at " + at(limit.point);
  view.heading.front() = static_cast<char>(std::toupper(view.heading.front()));
  view.text = explain(question, answer);
  view.point = limit.point;
  view.direction = limit.direction;
  view.width = limit.size;
  view.mode = question.mode;
  view.radius = body.radius;
  view.height = body.height;
  view.step = body.step;
  view.support_radius = question.mode == Mode::walk ? body.support_radius : 0.0;
  view.fits = answer.passable;
  view.heading_to = limit.heading;
  view.floor = question.mode == Mode::fly ? limit.point.z - body.radius : limit.feet.z;
  return view;
}

}  // namespace

picture::Sheet sheet_of(const std::string& title, const Survey& survey, const ProbeQuestion& question,
                        const ProbeAnswer& answer) {
  std::vector<OpeningView> views;
  if (answer.limit) views.push_back(view_of(question, answer));
  return picture::opening_sheet(views.empty() ? title + ": " + explain(question, answer) : title, views,
                                survey.meshes());
}

}  // namespace roam::app
