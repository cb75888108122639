#include "draw/picture.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "cli/progress.h"
#include "draw/compose.h"
#include "draw/corners.h"

namespace roam::draw {
namespace {

/// How far the way may be straightened: in radii, and at most in metres. Far less than a line's width. The survey makes
/// the body slimmer, so it still fits on the straightened way.
constexpr double straightening = 0.04;
constexpr double most_straightening = 0.002;
/// Segments held for each shown one, before they are joined.
constexpr std::size_t held_for_each_shown = 4;
/// Storeys shown one over the other are at least this many body heights apart.
constexpr double storey_heights = 1.2;
/// Two further cuts on foot, below the body's centre. One is just above its step height, for obstacles to its legs. The
/// other is below its step down, for ditches and pits.
std::vector<double> depths_below(const WalkerSettings& settings) {
  const double feet = 0.5 * settings.height, margin = 0.1 * settings.height;
  const double legs = feet - settings.step - margin;
  return legs > margin ? std::vector{legs, feet + settings.step + margin} : std::vector{feet + settings.step + margin};
}

std::vector<PlanView> plan_views(const Walked& walked, const Frames& frames, const RoomSurvey& survey,
                                 const Levels& levels, const std::vector<Mark>& marks) {
  const WalkerSettings& settings = walked.report.settings;
  std::vector<double> below;
  double ground = 1.0;
  if (walked.report.mode == Mode::walk) {
    below = depths_below(settings);
    ground = std::cos(glm::radians(settings.slope_degrees));
  }
  std::vector<PlanView> views;
  views.push_back({LevelMap(frames.plan.view, levels, survey.stations, frames.turn, storey_heights * settings.height),
                   levels.cuts, below, ground});
  for (const Detail& detail : frames.details) {
    views.push_back({LevelMap(detail.plan.view, 0), {marks[detail.marks[0]].centre.z}, below, ground});
  }
  return views;
}

/// The combined range of all sections.
Rect section_range(const Frames& frames) {
  Rect range = frames.section.view;
  for (const Detail& detail : frames.details) {
    range.include(detail.section.view.lower);
    range.include(detail.section.view.upper);
  }
  return range;
}

/// The distance along the way of the position on it that is nearest to a place.
double along_at(const Way& way, const Vec3& place) {
  double least = std::numeric_limits<double>::infinity(), along = 0.0;
  for (std::size_t i = 1; i < way.points.size(); ++i) {
    const WayPoint &a = way.points[i - 1], &b = way.points[i];
    if (b.jump) continue;
    const double t = nearest_part(place, a.position, b.position);
    const double apart = glm::distance(place, a.position + t * (b.position - a.position));
    if (apart >= least) continue;
    least = apart;
    along = a.along + t * (b.along - a.along);
  }
  return along;
}

}  // namespace

Measured measure(const Space& space, const words::EndedWalk& report, const Record& record, const Arrive& arrive) {
  Measured measured;
  measured.way = simplified(record, std::min(straightening * report.settings.radius, most_straightening));
  measured.survey = survey(space, measured.way, report.settings, report.mode, arrive);
  if (const auto& narrow = report.narrowest) {
    measured.survey.narrowest = {narrow->centre, narrow->body.height(), along_at(measured.way, narrow->centre),
                                 narrow->width,  narrow->left,          narrow->right};
  }
  return measured;
}

Sheet make_sheet(const Walked& walked) {
  const words::EndedWalk& report = walked.report;
  const auto& [way, measured] = walked.measured;
  const std::vector<Mark> marks = find_marks(report, walked.record, way, measured);
  const Frames frames = choose_frames(way, measured, marks, walked.bounds, report.settings);
  const Levels levels = find_levels(measured.stations, report.settings.height);

  const Rect range = section_range(frames);
  const double beyond = std::max({0.0, -range.lower.x, range.upper.x - way.length});
  const auto views = plan_views(walked, frames, measured, levels, marks);
  const auto section = stretches(way, frames.turn, beyond, range.lower.y, range.upper.y);
  app::Progress progress("cutting", "triangles");
  Cutter cutter(frames.turn, views, section, held_for_each_shown * walked.most_segments);
  walked.triangles(cutter.box(), [&](std::span<const Mesh> meshes) {
    cutter.add(meshes, [&](std::uint64_t done) {
      if (!walked.report.interrupted) progress.at(done, walked.triangle_count);
    });
  });
  const Cuts cuts = cutter.take();
  return compose(
      {walked.title, report, walked.record, way, measured, marks, levels, frames, cuts, walked.most_segments},
      measure_text);
}

}  // namespace roam::draw
