#include "draw/marks.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace roam::draw {
namespace {

/// A long name keeps its end, because many names share their beginning.
std::string shortened(const std::string& name) {
  constexpr std::size_t longest = 36;
  if (name.size() <= longest) return name;
  std::size_t from = name.size() - longest;
  while (from < name.size() && (static_cast<unsigned char>(name[from]) & 0xc0U) == 0x80U) ++from;  // inside a character
  return "…" + name.substr(from);
}

std::string blocked_note(const words::EndedWalk& report) {
  const Blockage& blockage = *report.result.blocked_at;
  std::string note = report.object.empty() ? "by an object without a name" : "by \"" + shortened(report.object) + "\"";
  if (blockage.opening) note += "\nopening " + length_text(*blockage.opening);
  return note;
}

/// Index of the point of the way that is nearest to a place.
std::size_t nearest_point(const Way& way, const Vec3& place) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < way.points.size(); ++i) {
    if (glm::distance(way.points[i].position, place) < glm::distance(way.points[best].position, place)) best = i;
  }
  return best;
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
  marks.push_back({MarkKind::start, first.position, first.position, first.height, 0.0, "start", ""});
  if (survey.narrowest) {
    const Narrowest& n = *survey.narrowest;
    marks.push_back(
        {MarkKind::narrowest, n.centre, n.centre, n.height, n.along, "narrowest", length_text(n.width) + " clear"});
  }
  if (report.mode == Mode::fly && way.nearest < record.places.size()) {
    const Place& p = record.places[way.nearest];
    marks.push_back({MarkKind::nearest, p.position, p.position, p.height, way.along[way.nearest], "nearest",
                     "gap " + length_text(p.clearance - report.settings.radius)});
  }
  for (const RouteEvent& e : result.events) {
    if (e.event.kind != EventKind::fell) continue;
    const WayPoint& p = way.points[nearest_point(way, e.event.point)];
    marks.push_back({MarkKind::fell, e.event.point, e.event.point, p.height, p.along, "fell", ""});
  }
  if (result.outcome == Outcome::blocked && result.blocked_at) {
    marks.push_back({MarkKind::blocked, result.blocked_at->point, last.position, last.height, last.along, "blocked",
                     blocked_note(report)});
  } else if (marks.back().kind != MarkKind::fell || result.outcome != Outcome::fell) {
    const bool reached = !report.interrupted && result.outcome == Outcome::reached;
    const char* how = reached ? "" : words::outcome(report);
    marks.push_back({MarkKind::end, last.position, last.position, last.height, last.along, "end", how});
  }
  std::stable_sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.along < b.along; });
  return marks;
}

}  // namespace roam::draw
