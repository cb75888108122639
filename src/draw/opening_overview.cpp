#include "draw/opening_overview.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <set>

#include "cli/progress.h"
#include "draw/cut.h"
#include "draw/frames.h"
#include "draw/levels.h"
#include "draw/lines.h"
#include "draw/panel.h"
#include "draw/survey.h"

namespace roam::draw {
namespace {

// Pixels.
constexpr double most_height = 760.0;
constexpr double least_height = 240.0;
constexpr double dot = 8.0;  ///< least radius of an end
constexpr double scale_bar_length = 220.0;
constexpr double least_cell = 5.0;  ///< of the reached places

/// Metres around the contents, and parts of their size.
constexpr double margin = 1.5;
constexpr double margin_part = 0.08;

constexpr Colour start_ink{0.10, 0.45, 0.25};
constexpr Colour target_ink{0.75, 0.38, 0.05};
constexpr Colour start_fill{0.10, 0.55, 0.30, 0.22};
constexpr Colour target_fill{0.90, 0.50, 0.05, 0.28};
constexpr Colour bad_ink{0.78, 0.06, 0.10};
constexpr std::size_t most_segments = 60'000;

/// The heights of the body's centre for the plan's levels.
std::vector<Station> stations_of(const Overview& o) {
  std::vector<Station> stations;
  const double up = o.mode == Mode::walk ? 0.5 * o.height : 0.0;
  const auto add = [&](const std::vector<Vec3>& places, bool jumps) {
    for (const Vec3& place : places) {
      Station s;
      s.centre = place + Vec3(0.0, 0.0, up);
      s.height = o.height;
      s.jump = jumps || stations.empty();
      if (!s.jump) {
        const Vec3 run = s.centre - stations.back().centre;
        s.along = stations.back().along + std::hypot(run.x, run.y);
      }
      stations.push_back(s);
    }
  };
  add(o.way, false);
  if (o.way.empty()) {
    add({o.start, o.target}, true);
    add(o.from_start, true);
    add(o.from_target, true);
  }
  return stations;
}

Rect shown(const Overview& o, const Turn& turn) {
  Rect box;
  for (const Vec3& place : o.way) box.include(turn.plan(place));
  for (const Vec3& place : {o.start, o.target}) box.include(turn.plan(place));
  for (const Overview::Mark& mark : o.marks) box.include(turn.plan(mark.place));
  return box.grown(std::max(margin, 3.0 * o.radius) + margin_part * std::max(box.width(), box.height()));
}

class OverviewPainter {
 public:
  OverviewPainter(const Overview& o, double y, Sheet& sheet, Labels& labels)
      : o_(o), y_(y), sheet_(sheet), labels_(labels) {
    const Vec3 middle = 0.5 * o.start + 0.5 * o.target;
    turn_ = {{middle.x, middle.y, 0.0}, 1.0, 0.0};
    Rect view = shown(o, turn_);
    if (view.height() > 1.5 * view.width()) {
      // North points to the right.
      turn_ = {turn_.origin, 0.0, 1.0};
      view = shown(o, turn_);
    }
    const double scale = std::min(content_width / view.width(), most_height / view.height());
    const double height = std::max(view.height(), least_height / scale);
    map_.frame = {Rect::around(view.center(), content_width / scale, height), scale, scale};
  }

  double paint(std::span<const Mesh> meshes) {
    const std::vector<Station> stations = stations_of(o_);
    const Levels levels = find_levels(stations, o_.height);
    y_ += 86.0;
    caption(levels);
    map_.corner = {sheet_margin, y_ + 16.0};
    const double below = 0.5 * o_.height - o_.step - 0.02 * o_.height;
    const PlanView view{LevelMap(map_.frame.view, levels, stations, turn_, o_.height), levels.cuts,
                        o_.mode == Mode::walk && below > 0.0 ? std::vector<double>{below} : std::vector<double>{},
                        std::cos(glm::radians(45.0))};
    std::uint64_t all = 0;
    for (const Mesh& mesh : meshes) all += mesh.triangles.size();
    app::Progress progress("drawing the plan", "triangles");
    const Cuts cuts = cut(meshes, turn_, {&view, 1}, {}, [&](std::uint64_t done) { progress.at(done, all); });
    reached("reached from the start", o_.from_start, start_fill, 1.0);
    reached("reached from the target", o_.from_target, target_fill, 0.6);
    segments("overview below", cuts.plans[0].below, 1.2, below_ink);
    segments("overview walls", cuts.plans[0].walls, 2.0, wall_ink);
    lines({.what = "frame", .lines = {outline(map_.panel())}, .width = 1.5, .stroke = frame_ink, .closed = true});
    way();
    for (const Overview::Mark& mark : o_.marks) ring(mark);
    end("start", o_.start, start_ink);
    end("target", o_.target, target_ink);
    for (const Overview::Mark& mark : o_.marks)
      label(mark.text, mark.place, ring_radius(), mark.good ? body_ink : bad_ink);
    label("start", o_.start, end_radius(), start_ink);
    label("target", o_.target, end_radius(), target_ink);
    return legend(map_.panel().upper.y + 34.0);
  }

 private:
  void lines(Lines what) { sheet_.items.emplace_back(std::move(what)); }

  void caption(const Levels& levels) {
    const Rect box = labels_.write("caption", "Plan", {sheet_margin, y_}, text_size, true, ink);
    const std::string how = levels.cuts.size() == 1 ? fmt::format("cut at z = {:.2f} m", levels.cuts[0])
                                                    : fmt::format(
                                                          "cut at {} heights, as the floor rises from z = "
                                                          "{:.2f} m to {:.2f} m",
                                                          levels.cuts.size(), levels.cuts.front(), levels.cuts.back());
    labels_.write("explanation", how, {box.upper.x + 16.0, y_}, small_size, false, pale_ink);
    const double metres = round_length(scale_bar_length / map_.frame.scale_x);
    const double right = sheet_width - sheet_margin, left = right - metres * map_.frame.scale_x;
    lines({.what = "overview scale bar",
           .lines = {{{left, y_ - 12.0}, {left, y_}, {right, y_}, {right, y_ - 12.0}}},
           .width = 2.5,
           .stroke = ink});
    labels_.write("overview scale", fmt::format("{:g} m", metres), {0.5 * (left + right), y_ - 9.0}, small_size, false,
                  ink, Labels::Align::centre);
    draw_compass(turn_, {left - 90.0, y_ - 30.0}, sheet_, labels_);
  }

  void segments(const std::string& what, std::span<const Segment> all, double width, const Colour& colour) {
    std::vector<Segment> seen;
    for (Segment s : all) {
      if (clip(s, map_.frame.view)) seen.push_back(s);
    }
    auto joint = joined(seen, map_, most_segments);
    labels_.avoid(joint, 0.4);
    if (!joint.empty())
      lines({.what = what, .lines = std::move(joint), .width = width, .stroke = colour, .clip = map_.panel()});
  }

  /// The cells that hold one of the places, each once.
  void reached(const std::string& what, const std::vector<Vec3>& places, const Colour& fill, double share) {
    const double side = std::max(o_.spacing, least_cell / map_.frame.scale_x);
    std::set<std::pair<long, long>> cells;
    // Counted from one of the places, to match the lattice.
    const Point origin = places.empty() ? Point(0.0) : turn_.plan(places.front());
    for (const Vec3& place : places) {
      const Point p = turn_.plan(place);
      if (!map_.frame.view.contains(p)) continue;
      cells.emplace(std::lround((p.x - origin.x) / side), std::lround((p.y - origin.y) / side));
    }
    std::vector<Polyline> areas;
    const double half = 0.5 * share * side;
    for (const auto& [x, y] : cells) {
      const Point p = origin + side * Point(x, y);
      areas.push_back({map_(p + Point(-half, -half)), map_(p + Point(half, -half)), map_(p + Point(half, half)),
                       map_(p + Point(-half, half))});
    }
    if (!areas.empty())
      lines({.what = what, .lines = std::move(areas), .fill = fill, .closed = true, .clip = map_.panel()});
  }

  void way() {
    Polyline line;
    for (const Vec3& place : o_.way) line.push_back(map_(turn_.plan(place)));
    if (line.size() < 2) return;
    labels_.avoid({line}, 1.0);
    lines({.what = "way", .lines = {std::move(line)}, .width = 4.0, .stroke = body_ink, .clip = map_.panel()});
  }

  void ring(const Overview::Mark& mark) {
    const Point centre = map_(turn_.plan(mark.place));
    const double radius = ring_radius();
    sheet_.items.emplace_back(Disc{.what = "overview mark",
                                   .centre = centre,
                                   .radius = radius,
                                   .width = 3.0,
                                   .stroke = mark.good ? body_ink : bad_ink,
                                   .clip = map_.panel()});
    labels_.block(Rect::around(centre, 2.0 * radius, 2.0 * radius));
  }

  void end(const std::string& what, const Vec3& place, const Colour& colour) {
    const Point centre = map_(turn_.plan(place));
    const double radius = end_radius();
    Colour fill = colour;
    fill.alpha = 0.55;
    sheet_.items.emplace_back(Disc{.what = what,
                                   .centre = centre,
                                   .radius = radius,
                                   .width = 2.5,
                                   .stroke = colour,
                                   .fill = fill,
                                   .clip = map_.panel()});
    labels_.block(Rect::around(centre, 2.0 * radius, 2.0 * radius));
  }

  [[nodiscard]] double end_radius() const { return std::max(dot, o_.radius * map_.frame.scale_x); }
  [[nodiscard]] double ring_radius() const { return std::max(2.0 * dot, 1.3 * o_.radius * map_.frame.scale_x); }

  /// Writes a label beside a circle around the place.
  void label(const std::string& text, const Vec3& place, double radius, const Colour& colour) {
    labels_.place({"overview label", {text}, label_size, colour}, map_(turn_.plan(place)) - Point(0.0, radius),
                  map_.panel().grown(-6.0));
  }

  double legend(double y) {
    double x = sheet_margin;
    const auto entry = [&](const std::string& name, Lines how) {
      const Point middle(x, y - 0.32 * small_size);
      how.what = "legend";
      how.lines = how.closed ? std::vector<Polyline>{outline({middle - Point(0.0, 9.0), middle + Point(40.0, 9.0)})}
                             : std::vector<Polyline>{{middle, middle + Point(40.0, 0.0)}};
      sheet_.items.emplace_back(std::move(how));
      x = labels_.write("legend", name, {x + 52.0, y}, small_size, false, ink).upper.x + 34.0;
    };
    entry("cut at the body's middle", {.what = {}, .lines = {}, .width = 2.0, .stroke = wall_ink});
    if (o_.mode == Mode::walk)
      entry("lower, and still a wall", {.what = {}, .lines = {}, .width = 1.2, .stroke = below_ink});
    if (!o_.way.empty()) entry("way", {.what = {}, .lines = {}, .width = 4.0, .stroke = body_ink});
    if (!o_.from_start.empty())
      entry("reached from the start", {.what = {}, .lines = {}, .fill = start_fill, .closed = true});
    if (!o_.from_target.empty())
      entry("reached from the target", {.what = {}, .lines = {}, .fill = target_fill, .closed = true});
    return y + 12.0;
  }

  const Overview& o_;
  double y_;
  Sheet& sheet_;
  Labels& labels_;
  Turn turn_;
  Map map_;
};

}  // namespace

void draw_compass(const Turn& turn, const Point& centre, Sheet& sheet, Labels& labels) {
  const auto arrow = [&](const char* name, const Point& way, double reach, double width) {
    const Point tip = centre + reach * way, side(-way.y, way.x);
    sheet.items.emplace_back(
        Lines{.what = "compass",
              .lines = {{centre, tip}, {tip - 9.0 * way + 5.0 * side, tip, tip - 9.0 * way - 5.0 * side}},
              .width = width,
              .stroke = ink});
    labels.write("compass", name, tip + 12.0 * way + Point(0.0, 7.0), small_size, false, ink, Labels::Align::centre);
  };
  // y first, turned as the plan is; the sheet's own y points down.
  arrow("N", {turn.sine, -turn.cosine}, 26.0, 2.6);
  arrow("x", {turn.cosine, turn.sine}, 20.0, 1.4);
}

double draw_overview(const Overview& overview, std::span<const Mesh> meshes, double y, Sheet& sheet, Labels& labels) {
  return OverviewPainter(overview, y, sheet, labels).paint(meshes);
}

}  // namespace roam::draw
