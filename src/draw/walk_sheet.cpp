#include "draw/walk_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "cli/progress.h"
#include "draw/frames.h"
#include "draw/page.h"
#include "draw/walk_panels.h"
#include "math/round_length.h"
#include "math/slope.h"

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
constexpr std::ptrdiff_t most_named_falls = 3;

/// Further cuts on foot, below the body's centre. One is just above its step height, for obstacles to its legs. The
/// other is below its step down, for ditches and pits.
std::vector<double> depths_below(const WalkerSettings& settings) {
  const double feet = 0.5 * settings.height, margin = 0.1 * settings.height;
  const double legs = feet - settings.step - margin;
  return legs > margin ? std::vector{legs, feet + settings.step + margin} : std::vector{feet + settings.step + margin};
}

std::vector<PlanView> plan_views(const WalkDrawing& walk, const WalkerSettings& settings) {
  const bool walks = walk.mode == Mode::walk;
  const std::vector<double> below = walks ? depths_below(settings) : std::vector<double>{};
  const double ground = walks ? least_upright(settings.slope_degrees) : 1.0;
  const Frames& f = walk.frames;
  const LevelMap map(f.plan.view, walk.levels, walk.survey.stations, f.turn, storey_heights * settings.height);
  std::vector<PlanView> views{{map, walk.levels.cuts, below, ground}};
  for (const Detail& detail : f.details) {
    views.push_back({LevelMap(detail.plan.view, 0), {walk.marks[detail.marks[0]].centre.z}, below, ground});
  }
  return views;
}

/// Cuts the scene.
WalkDrawing drawing_of(const Walked& walked) {
  const words::EndedWalk& report = walked.report;
  const auto& [way, survey] = walked.measured;
  WalkDrawing walk{report.mode, report.settings.radius, walked.record, way, survey, walked.most_segments, {}, {}, {},
                   {}};
  walk.marks = find_marks(report, walked.record, way, survey);
  walk.frames = choose_frames(way, survey, walk.marks, walked.bounds, report.settings);
  walk.levels = find_levels(survey.stations, report.settings.height);
  Rect range = walk.frames.section.view;
  std::vector<Frame> frames{walk.frames.section};
  for (const Detail& detail : walk.frames.details) {
    range.include(detail.section.view.lower);
    range.include(detail.section.view.upper);
    frames.push_back(detail.section);
  }
  const double beyond = std::max({0.0, -range.lower.x, range.upper.x - way.length});
  const auto views = plan_views(walk, report.settings);
  const auto section = stretches(way, walk.frames.turn, beyond, range.lower.y, range.upper.y);
  app::Progress progress("cutting", "triangles");
  Cutter cutter(walk.frames.turn, views, section, frames, held_for_each_shown * walked.most_segments);
  walked.triangles(cutter.box(), [&](std::span<const Mesh> meshes) {
    cutter.add(meshes, [&](std::uint64_t done) {
      if (!report.interrupted) progress.at(done, walked.triangle_count);
    });
  });
  walk.cuts = cutter.take();
  return walk;
}

/// Lays out the sheet, from the top downward.
class WalkSheet {
 public:
  explicit WalkSheet(const Walked& walked)
      : title_(walked.title), report_(walked.report), walk_(drawing_of(walked)), frames_(walk_.frames) {}

  Sheet compose() {
    title();
    plan();
    if (!frames_.details.empty()) details();
    section();
    legend();
    return page_.finish();
  }

 private:
  void title() {
    page_.title(title_);
    const bool is_reached = !report_.interrupted && report_.result.outcome == Outcome::reached;
    page_.paragraph("outcome", words::headline(report_), text_font, is_reached ? green : red);
    if (!is_reached) page_.paragraph("why", words::explain(report_), text_font, red);
    page_.down(4.0);
    page_.paragraph("facts", facts(), text_font, pale_ink);
  }

  [[nodiscard]] std::string facts() const {
    const WalkerSettings& body = report_.settings;
    const char* mode = walk_.mode == Mode::walk  ? "on foot"
                       : walk_.mode == Mode::fly ? "flying"
                                                 : "as a ghost, through walls";
    std::string text = fmt::format("{}, radius {:g} m, height {:g} m", mode, body.radius, body.height);
    if (walk_.mode == Mode::fly && words::knows_clearance(report_)) {
      text += fmt::format("  ·  its axis at least {:.3f} m from everything, certified",
                          report_.result.least_axis_clearance);
    }
    if (falls() > 1) text += fmt::format("  ·  fell {} times", falls());
    if (walk_.survey.narrowest) text += "  ·  narrowest " + length_text(walk_.survey.narrowest->width);
    return text;
  }

  void plan() {
    page_.heading("plan", {"Plan", cut_text(walk_.levels), frames_.plan.scale_x, &frames_.turn});
    Panel panel = page_.panel("plan", frames_.plan, sheet_margin, &frames_.turn);
    paint_plan(panel, walk_, walk_.cuts.plans[0]);
    label_marks(panel, walk_, true, [&](std::size_t i) { return lettered(i); });
    page_.below(panel);
  }

  [[nodiscard]] std::ptrdiff_t falls() const {
    return std::count_if(walk_.marks.begin(), walk_.marks.end(),
                         [](const Mark& m) { return m.kind == MarkKind::fell; });
  }

  [[nodiscard]] std::vector<std::string> full_label(std::size_t i) const {
    const Mark& m = walk_.marks[i];
    // A few falls are named; many are not.
    return m.kind == MarkKind::fell && falls() > most_named_falls ? std::vector<std::string>{} : m.label;
  }

  static std::string letter(std::size_t detail) { return {static_cast<char>('A' + detail)}; }

  /// At the mark that a detail is about: the detail's letter and the names of all marks in it. Nothing at its others.
  [[nodiscard]] std::vector<std::string> lettered(std::size_t i) const {
    for (std::size_t k = 0; k < frames_.details.size(); ++k) {
      const auto& marks = frames_.details[k].marks;
      if (std::find(marks.begin(), marks.end(), i) == marks.end()) continue;
      if (marks[0] != i) return {};
      std::string text = letter(k);
      for (const std::size_t m : marks) text += (m == i ? "  " : ", ") + walk_.marks[m].label[0];
      return {text};
    }
    return full_label(i);
  }

  void details() {
    page_.down(6.0);
    const auto& details = frames_.details;
    page_.heading("detail", {"Details",
                             "plan, cut at the height of the body's centre there, and section, heights not exaggerated",
                             details[0].plan.scale_x});
    std::vector<Panel> plans;
    for (std::size_t k = 0; k < details.size(); ++k) {
      const double left = sheet_margin + static_cast<double>(k) * (details[k].plan.width() + detail_gap);
      Panel& panel =
          plans.emplace_back(page_.panel("detail " + letter(k) + " plan", details[k].plan, left, &frames_.turn));
      paint_plan(panel, walk_, walk_.cuts.plans[k + 1]);
      panel.badge(letter(k));
      label_marks(panel, walk_, true, [&](std::size_t i) { return full_label(i); });
    }
    page_.below(plans[0]);
    page_.down(-8.0);  // no headings between them
    for (std::size_t k = 0; k < details.size(); ++k) {
      Panel panel = page_.panel("detail " + letter(k) + " section", details[k].section, plans[k].area().lower.x);
      paint_section(panel, walk_, walk_.cuts.sections[k + 1], walk_.cuts.grids[k + 1]);
      if (k + 1 == details.size()) page_.below(panel);
    }
  }

  void section() {
    const Frame& f = frames_.section;
    page_.down(10.0);
    page_.heading("section",
                  {"Section",
                   fmt::format("unrolled along the way, lengths to {}, heights {}",
                               frames_.section_has_plan_scale ? "the scale of the plan" : "a scale of its own",
                               frames_.exaggeration > 1.0 ? fmt::format("exaggerated {:g} times", frames_.exaggeration)
                                                          : "to the same scale"),
                   f.scale_x});
    Panel panel = page_.panel("section", f, sheet_width - sheet_margin - f.width());
    height_axis(panel);
    distance_axis(panel);
    paint_section(panel, walk_, walk_.cuts.sections[0], walk_.cuts.grids[0]);
    label_marks(panel, walk_, false, [&](std::size_t i) {
      auto label = lettered(i);
      if (!label.empty()) label.resize(1);
      return label;
    });
    page_.below(panel);
    page_.down(50.0);
  }

  /// Ticks at round heights, fewer if their numbers would touch.
  static void height_axis(Panel& panel) {
    const Frame& f = panel.frame();
    const double step = round_length(122.0 / f.scale_y);
    const int digits = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    for (double k = std::ceil(f.view.lower.y / step); k * step <= f.view.upper.y; ++k) {
      const Point at(f.view.lower.x, k == 0.0 ? 0.0 : k * step);  // never "-0"
      panel.sign("tick", at, {{{-7.0, 0.0}, {0.0, 0.0}}}, tick_style);
      panel.lines("grid", {{at, {f.view.upper.x, at.y}}}, grid_style);
      panel.text("height", at, {-12.0, 7.0}, fmt::format("{:.{}f} m", at.y, digits), small_font, pale_ink,
                 Labels::Align::right);
    }
  }

  void distance_axis(Panel& panel) const {
    const double step = round_length(300.0 / panel.scale());
    for (double along = 0.0; along <= walk_.way.length + 1e-9; along += step) {
      const Point at(along, panel.frame().view.lower.y);
      panel.sign("tick", at, {{{0.0, 0.0}, {0.0, 7.0}}}, tick_style);
      panel.text("distance", at, {0.0, 28.0}, scale_text(along), small_font, pale_ink);
    }
  }

  void legend() {
    std::vector<LegendEntry> entries{{"cut by the plane", wall_style, 0.0, true},
                                     {walk_.mode == Mode::walk ? "lower, or gently rising" : "lower", below_style}};
    if (walk_.mode == Mode::ghost) {
      entries.push_back({"way", ghost_style, 0.0, true});
    } else {
      const auto& limits = GapScale(walk_.radius).limits;
      for (std::size_t k = 0; k < gap_styles.size(); ++k) {
        const std::string gap = k < limits.size() ? "< " + length_text(limits[k]) : "more";
        entries.push_back({(k == 0 ? "way, room beside the body " : "") + gap, gap_styles[k], 0.0, true});
      }
    }
    entries.push_back({"body, to scale", body_style, 11.0});
    entries.push_back({"touched", touch_style, 4.5});
    entries.push_back({"narrowest: clear width across the way", measure_style});
    page_.legend(entries);
  }

  const std::string& title_;
  const words::EndedWalk& report_;
  const WalkDrawing walk_;
  const Frames& frames_;
  Page page_;
};

}  // namespace

Measured measure(const Space& space, const words::EndedWalk& report, const Record& record, const Arrive& arrive) {
  Measured measured;
  measured.way = simplified(record, std::min(straightening * report.settings.radius, most_straightening));
  measured.survey = survey(space, measured.way, report.settings, report.mode, arrive);
  measured.survey.narrowest = report.narrowest;
  if (auto& narrowest = measured.survey.narrowest) {
    narrowest->along = nearest_on(measured.way, narrowest->centre).along;
  }
  return measured;
}

Sheet make_sheet(const Walked& walked) {
  Sheet sheet = WalkSheet(walked).compose();
  sheet.runs_left_out = walked.record.runs_left_out;
  return sheet;
}

}  // namespace roam::draw
