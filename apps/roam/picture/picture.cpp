#include "picture.h"

#include "compose.h"
#include "progress.h"

namespace roam::app::picture {
namespace {

/// Metres by which the way may be straightened, in radii: far less than a line is wide.
constexpr double straightening = 0.04;
/// Storeys that are shown one over the other are at least so many body heights apart.
constexpr double storey_heights = 1.2;
constexpr double detail_storey = 0.5;  ///< of a body's height: what is lower than feet is another story

std::vector<PlanView> plan_views(const Walked& walked, const Frames& frames, const Survey& survey, const Levels& levels,
                                 const std::vector<Mark>& marks) {
  const WalkerSettings& settings = walked.report.settings;
  std::optional<double> below;
  if (walked.report.mode == Mode::walk)
    below = detail_storey * settings.height + std::max(settings.step, 0.25 * settings.height);
  std::vector<PlanView> views;
  views.push_back({LevelMap(frames.plan.view, levels, survey.stations, frames.turn, storey_heights * settings.height),
                   levels.cuts, below});
  for (const Detail& detail : frames.details) {
    views.push_back({LevelMap(detail.plan.view, 0), {marks[detail.marks[0]].centre.z}, below});
  }
  return views;
}

/// Everything that one of the sections shows.
Rect section_range(const Frames& frames) {
  Rect range = frames.section.view;
  for (const Detail& detail : frames.details) {
    range.include(detail.section.view.lower);
    range.include(detail.section.view.upper);
  }
  return range;
}

}  // namespace

Sheet make_sheet(const Walked& walked) {
  const WalkReport& report = walked.report;
  const Way way = simplified(walked.record, straightening * report.settings.radius);
  const Survey measured = survey(walked.space, way, report.settings, report.mode);
  const std::vector<Mark> marks = find_marks(report, walked.record, way, measured);
  const Frames frames = choose_frames(way, measured, marks, walked.space.bounds(), report.settings);
  const Levels levels = find_levels(measured.stations, report.settings.height);

  const Rect range = section_range(frames);
  const double beyond = std::max({0.0, -range.lower.x, range.upper.x - way.length});
  const auto views = plan_views(walked, frames, measured, levels, marks);
  const auto section = stretches(way, frames.turn, beyond, range.lower.y, range.upper.y);
  Progress progress("cutting", "triangles");
  const Cuts cuts =
      cut(walked.meshes, frames.turn, views, section, [&](std::uint64_t done) { progress.at(done, report.triangles); });
  return compose({walked.title, report, walked.record, way, measured, marks, levels, frames, cuts}, measure_text);
}

}  // namespace roam::app::picture
