#include "draw/marks.h"

#include <fmt/format.h>

#include <cmath>

#include "text/printable.h"

namespace roam::draw {
namespace {

constexpr std::size_t longest_label = 36;  ///< characters of a name

std::vector<std::string> blocked_label(const words::EndedWalk& report) {
  std::vector<std::string> label{"blocked", report.object.empty()
                                                ? "by an object without a name"
                                                : "by \"" + printable(report.object, longest_label) + "\""};
  if (const auto& opening = report.result.blocked_at->opening) label.push_back("opening " + length_text(*opening));
  return label;
}

}  // namespace

std::string length_text(double metres) {
  const double size = std::abs(metres);
  if (size >= 1000.0) return fmt::format("{:.2f} km", metres * 1e-3);
  if (size >= 10.0) return fmt::format("{:.1f} m", metres);
  if (size >= 0.01 || size == 0.0) return fmt::format("{:.2f} m", metres);
  return fmt::format("{:.1f} mm", metres * 1e3);
}

std::vector<Mark> find_marks(const words::EndedWalk& report, const Record& record, const Way& way,
                             const RoomSurvey& survey) {
  std::vector<Mark> marks;
  const WayPoint &first = way.points.front(), &last = way.points.back();
  const RouteResult& result = report.result;
  marks.push_back({MarkKind::start, first.position, first.position, first.height, 0.0, {"start"}});
  if (survey.narrowest) {
    const measure::NarrowPlace& n = *survey.narrowest;
    marks.push_back({MarkKind::narrowest,
                     n.centre,
                     n.centre,
                     n.body.height(),
                     n.along,
                     {"narrowest", length_text(n.width) + " clear"}});
  }
  if (report.mode == Mode::fly && way.nearest < record.places.size()) {
    const Place& p = record.places[way.nearest];
    marks.push_back({MarkKind::nearest,
                     p.position,
                     p.position,
                     p.height,
                     way.along[way.nearest],
                     {"nearest", "gap " + length_text(p.clearance - report.settings.radius)}});
  }
  for (const RouteEvent& e : result.events) {
    if (e.event.kind != EventKind::fell) continue;
    const WayPoint p = nearest_on(way, e.event.point);
    marks.push_back({MarkKind::fell, e.event.point, e.event.point, p.height, p.along, {"fell"}});
  }
  const bool ends_by_falling = marks.back().kind == MarkKind::fell && result.outcome == Outcome::fell;
  if (result.outcome == Outcome::blocked && result.blocked_at) {
    marks.push_back(
        {MarkKind::blocked, result.blocked_at->point, last.position, last.height, last.along, blocked_label(report)});
  } else if (!ends_by_falling) {
    marks.push_back({MarkKind::end, last.position, last.position, last.height, last.along, {"end"}});
    if (report.interrupted || result.outcome != Outcome::reached)
      marks.back().label.emplace_back(words::outcome(report));
  }
  std::stable_sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.along < b.along; });
  return marks;
}

}  // namespace roam::draw
