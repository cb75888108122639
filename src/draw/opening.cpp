#include "draw/opening.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "cli/progress.h"
#include "draw/cut.h"
#include "draw/labels.h"
#include "draw/lines.h"
#include "draw/marks.h"
#include "draw/opening_layout.h"

namespace roam::draw {
namespace {

// Pixels.
constexpr double title_size = 40.0;
constexpr double heading_size = 30.0;
constexpr double panel_gap = 40.0;
constexpr double panel_width = 0.5 * (content_width - panel_gap);
constexpr double caption_height = 92.0;  ///< space for the compass
constexpr double crack_measure = 34.0;   ///< below the rim
constexpr double tick = 12.0;
constexpr double letter_beside = 16.0;
constexpr double scale_bar_length = 220.0;

constexpr Colour floor_fill{0.93, 0.92, 0.86};
constexpr Colour face_fill{0.85, 0.87, 0.90};
constexpr Colour measure_ink{0.55, 0.10, 0.50};
constexpr Colour misfit_ink{0.78, 0.06, 0.10};
constexpr Colour misfit_fill{0.78, 0.06, 0.10, 0.16};
constexpr Colour foot_ink{0.10, 0.45, 0.25};

constexpr std::size_t most_segments = 60'000;  ///< of each kind in one panel

/// Draws from the top downward.
class OpeningPainter {
 public:
  OpeningPainter(std::span<const Mesh> meshes, const MeasureText& measure) : meshes_(meshes), labels_(sheet_, measure) {
    sheet_.width = sheet_width;
  }

  Sheet paint(const std::string& title, const std::string& about, const std::optional<Overview>& overview,
              std::span<const OpeningView> openings) {
    y_ = 0.5 * sheet_margin;
    text("title", title, title_size, true, ink);
    if (!about.empty()) text("text", about, text_size, false, pale_ink);
    if (overview) y_ = draw_overview(*overview, meshes_, y_, sheet_, labels_);
    char letter = 'A';
    for (const OpeningView& o : openings) opening(o, letter == 'Z' ? letter : letter++);
    if (!openings.empty()) legend(openings);
    sheet_.height = std::ceil(y_ + 0.6 * sheet_margin);
    return std::move(sheet_);
  }

 private:
  void text(const std::string& what, const std::string& content, double size, bool bold, const Colour& colour) {
    for (const std::string& line : wrapped(content, content_width, size, bold, labels_.measure())) {
      y_ += 1.25 * size;
      labels_.write(what, line, {sheet_margin, y_}, size, bold, colour);
    }
  }

  void opening(const OpeningView& o, char letter) {
    y_ += 26.0;
    text("heading", o.heading, heading_size, true, o.fits ? ink : misfit_ink);
    y_ += 4.0;
    if (!o.text.empty()) text("text", o.text, text_size, false, pale_ink);
    const OpeningLayout l = lay_out(o, panel_width);
    const Cuts cuts = cut_around(o, l);
    y_ += caption_height;
    const std::string name(1, letter);
    caption("Plan", fmt::format("cut at z = {:.2f} m", l.cut), sheet_margin);
    const double right = sheet_margin + panel_width + panel_gap;
    caption("Section " + name + "\xE2\x80\x93" + name,
            o.mode == Mode::fly ? std::string() : fmt::format("feet at z = {:.2f} m", o.floor), right);
    scale_bar(l.section.scale_x);
    y_ += 16.0;
    plan(o, l, cuts, {l.plan, {sheet_margin, y_}}, name);
    section(o, l, cuts, {l.section, {right, y_}});
    y_ += l.plan.height();
  }

  [[nodiscard]] Cuts cut_around(const OpeningView& o, const OpeningLayout& l) const {
    const double ground = std::cos(glm::radians(45.0));
    std::vector<PlanView> views{{LevelMap(l.plan.view, 0), {l.cut}, {l.cut - l.below}, ground}};
    if (l.above > 0.0) views.push_back({LevelMap(l.plan.view, 0), {l.above}, {}, 1.0});
    const Rect& shown = l.section.view;
    const Stretch across{{shown.lower.x, 0.0}, {shown.upper.x, 0.0}, shown.lower.x, shown.lower.y, shown.upper.y};
    std::uint64_t all = 0;
    for (const Mesh& mesh : meshes_) all += mesh.triangles.size();
    app::Progress progress("drawing " + o.heading, "triangles");
    return cut(meshes_, l.turn, views, {&across, 1}, [&](std::uint64_t done) { progress.at(done, all); });
  }

  void caption(const std::string& name, const std::string& explanation, double x) {
    const Rect box = labels_.write("caption", name, {x, y_}, text_size, true, ink);
    labels_.write("explanation", explanation, {box.upper.x + 16.0, y_}, small_size, false, pale_ink);
  }

  /// For both panels, which have the same scale.
  void scale_bar(double pixels_per_metre) {
    const double metres = round_length(scale_bar_length / pixels_per_metre);
    const double right = sheet_width - sheet_margin, left = right - metres * pixels_per_metre;
    lines("scale bar", {{{left, y_ - 12.0}, {left, y_}, {right, y_}, {right, y_ - 12.0}}}, 2.5, ink);
    labels_.write("scale", length(metres), {0.5 * (left + right), y_ - 9.0}, small_size, false, ink,
                  Labels::Align::centre);
  }

  static std::string length(double metres) {
    return metres >= 0.1 ? fmt::format("{:g} m", metres) : fmt::format("{:g} mm", metres * 1e3);
  }

  void lines(const std::string& what, std::vector<Polyline> drawn, double width, const Colour& colour,
             const Rect& clip = {}, std::vector<double> dash = {}) {
    sheet_.items.emplace_back(Lines{.what = what,
                                    .lines = std::move(drawn),
                                    .width = width,
                                    .stroke = colour,
                                    .dash = std::move(dash),
                                    .clip = clip});
  }

  void segments(const std::string& what, const Map& map, std::span<const Segment> all, double width,
                const Colour& colour, std::vector<double> dash = {}) {
    std::vector<Segment> seen;
    for (Segment s : all) {
      if (clip(s, map.frame.view)) seen.push_back(s);
    }
    auto joint = joined(seen, map, most_segments);
    labels_.avoid(joint, 0.5);
    if (!joint.empty()) lines(what, std::move(joint), width, colour, map.panel(), std::move(dash));
  }

  void frame(const Map& map) {
    sheet_.items.emplace_back(
        Lines{.what = "frame", .lines = {outline(map.panel())}, .width = 1.5, .stroke = frame_ink, .closed = true});
  }

  void area(const std::string& what, std::vector<Polyline> areas, const Colour& fill, const Map& map) {
    if (areas.empty()) return;
    sheet_.items.emplace_back(Lines{.what = what,
                                    .lines = std::move(areas),
                                    .width = 0.8,
                                    .stroke = fill,
                                    .fill = fill,
                                    .closed = true,
                                    .clip = map.panel()});
  }

  void plan(const OpeningView& o, const OpeningLayout& l, const Cuts& cuts, const Map& map, const std::string& name) {
    area("floor", floor_around(meshes_, o, l, map), floor_fill, map);
    segments("plan below", map, cuts.plans[0].below, 1.4, below_ink);
    if (cuts.plans.size() > 1) segments("plan above", map, cuts.plans[1].walls, 1.6, pale_ink, {10.0, 7.0});
    segments("plan walls", map, cuts.plans[0].walls, 2.4, wall_ink);
    frame(map);
    draw_compass(l.turn, Point(map.panel().upper.x - 44.0, map.panel().lower.y - 46.0), sheet_, labels_);
    section_line(o, map, name);
    const Point centre = map(l.body);
    const Colour& stroke = o.fits ? body_ink : misfit_ink;
    const double radius = o.radius * map.frame.scale_x;
    sheet_.items.emplace_back(Disc{.what = "plan body",
                                   .centre = centre,
                                   .radius = radius,
                                   .width = 2.0,
                                   .stroke = stroke,
                                   .fill = o.fits ? body_fill : misfit_fill,
                                   .clip = map.panel()});
    circle_avoided(centre, radius);
    if (o.support_radius > 0.0) {
      sheet_.items.emplace_back(Disc{.what = "plan foot",
                                     .centre = centre,
                                     .radius = o.support_radius * map.frame.scale_x,
                                     .width = 2.0,
                                     .stroke = foot_ink,
                                     .clip = map.panel()});
      circle_avoided(centre, o.support_radius * map.frame.scale_x);
    }
    if (l.is_level) {
      const double half = 0.5 * o.width * glm::length(glm::dvec2(o.direction.x, o.direction.y));
      // An oblique width is longer than in the plan, so its number stands in the section.
      const bool whole = std::abs(o.direction.z) < 0.1;
      measure(map, {-half, 0.0}, {half, 0.0}, whole ? o.width : 0.0);
    }
    labels_.block(Rect::around(centre, 1.6 * radius, 1.6 * radius));
    label(map, l.body - Point(0.0, o.radius), body_text(o), stroke);
  }

  void section(const OpeningView& o, const OpeningLayout& l, const Cuts& cuts, const Map& map) {
    area("faces", faces_beside(meshes_, o, l, map), face_fill, map);
    segments("section walls", map, cuts.section, 2.4, wall_ink);
    frame(map);
    Polyline body = upright_capsule(o.radius, o.floor - sunk(o), o.height);
    for (Point& p : body) p = map(p + Point(l.body.x, 0.0));
    labels_.avoid({body}, 1.0);
    const Colour& stroke = o.fits ? body_ink : misfit_ink;
    sheet_.items.emplace_back(Lines{.what = "section body",
                                    .lines = {std::move(body)},
                                    .width = 2.0,
                                    .stroke = stroke,
                                    .fill = o.fits ? body_fill : misfit_fill,
                                    .closed = true,
                                    .clip = map.panel()});
    if (o.support_radius > 0.0) {
      const Point left = map({-o.support_radius, o.floor}), right = map({o.support_radius, o.floor});
      lines("section foot", {{left, right}}, 5.0, foot_ink, map.panel());
      label(map, {o.support_radius, o.floor}, {"foot", length_text(o.support_radius) + " around"}, foot_ink);
    }
    const glm::dvec2 level(o.direction.x, o.direction.y);
    const Point half =
        0.5 * o.width *
        (l.is_level ? Point(glm::length(level), o.direction.z * sign(o, l)) : Point(0.0, std::abs(o.direction.z)));
    const bool crack = o.kind == OpeningView::Kind::crack;
    if (crack && !o.fits) fall(map, {0.0, o.floor});
    const Point middle(0.0, o.point.z - (crack ? crack_measure / map.frame.scale_y : 0.0));
    // The number of a height stands beside the body, beyond the drawn lintel.
    const bool is_height = !l.is_level && o.kind == OpeningView::Kind::passage;
    const Point aside(is_height ? l.body.x + o.radius + 0.2 * o.radius : 0.0, 0.0);
    if (is_height) {
      std::vector<Polyline> drawn_out;
      for (const Point& end : {middle - half, middle + half}) drawn_out.push_back({map(end), map(end + 1.15 * aside)});
      lines("drawn out", std::move(drawn_out), 1.4, measure_ink, map.panel());
    }
    measure(map, middle + aside - half, middle + aside + half, o.width);
    Rect taken;
    taken.include(map({l.body.x - o.radius, o.floor}));
    taken.include(map({l.body.x + o.radius, o.floor + o.height}));
    labels_.block(taken);
    label(map, {l.body.x + o.radius, o.floor + 0.5 * o.height}, body_text(o), stroke);
  }

  /// 1 if the plan was turned so that the direction points to the right, -1 if to the left.
  static double sign(const OpeningView& o, const OpeningLayout& l) {
    return o.direction.x * l.turn.cosine + o.direction.y * l.turn.sine < 0.0 ? -1.0 : 1.0;
  }

  static std::vector<std::string> body_text(const OpeningView& o) {
    // To the millimetre, like the width that it is compared with.
    const std::string across = fmt::format("{:.3f} m across", 2.0 * o.radius);
    if (o.height <= 2.0 * o.radius) return {"body", across};
    return {"body", across, fmt::format("{:.3f} m high", o.height)};
  }

  /// A line from side to side with its length beside it; 0: no number.
  void measure(const Map& map, const Point& from, const Point& to, double metres) {
    const Point a = map(from), b = map(to);
    const double apart = glm::distance(a, b);
    if (apart < 1.0) return;
    const Point along = (b - a) / apart, across(-along.y, along.x);
    lines("measure", {{a, b}, {a - tick * across, a + tick * across}, {b - tick * across, b + tick * across}}, 3.0,
          measure_ink, map.panel());
    labels_.avoid({{a, b}}, 6.0);
    labels_.avoid({{a - tick * across, a + tick * across}, {b - tick * across, b + tick * across}}, 4.0);
    if (metres > 0.0) {
      labels_.place({"width", {fmt::format("{:.3f} m", metres)}, 1.15 * label_size, measure_ink}, 0.5 * (a + b),
                    map.panel().grown(-6.0));
    }
  }

  void label(const Map& map, const Point& at, const std::vector<std::string>& text, const Colour& colour) {
    labels_.place({"label", text, label_size, colour}, map(at), map.panel().grown(-6.0));
  }

  void circle_avoided(const Point& centre, double radius) {
    Polyline circle;
    constexpr int parts = 48;
    for (int k = 0; k <= parts; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / parts;
      circle.push_back(centre + radius * Point(std::cos(angle), std::sin(angle)));
    }
    labels_.avoid({circle}, 1.0);
  }

  /// An arrow downward, where the ground is missing.
  void fall(const Map& map, const Point& at) {
    const Point top = map(at) + Point(0.0, crack_measure + 16.0), tip = top + Point(0.0, 52.0);
    lines("fall", {{top, tip}, {tip - Point(11.0, 14.0), tip, tip - Point(-11.0, 14.0)}}, 4.0, misfit_ink, map.panel());
    labels_.block(Rect::around(0.5 * (top + tip), 30.0, 56.0));
  }

  /// The position of the section, outside the measured width.
  void section_line(const OpeningView& o, const Map& map, const std::string& name) {
    const double beyond = std::max({0.5 * o.width, o.radius, o.support_radius}) + 0.2 * o.radius;
    const Rect panel = map.panel();
    const Point left = map({-beyond, 0.0}), right = map({beyond, 0.0});
    std::vector<Polyline> drawn;
    if (left.x > panel.lower.x) drawn = {{{panel.lower.x, left.y}, left}, {right, {panel.upper.x, right.y}}};
    for (const double x : {panel.lower.x - letter_beside, panel.upper.x + letter_beside})
      labels_.write("section name", name, {x, left.y + 8.0}, text_size, true, pale_ink, Labels::Align::centre);
    labels_.avoid(drawn, 1.0);
    lines("section line", std::move(drawn), 1.4, pale_ink, panel, {14.0, 5.0, 3.0, 5.0});
  }

  /// The meanings of the colours that occur.
  void legend(std::span<const OpeningView> openings) {
    const auto any = [&](const auto& is) { return std::any_of(openings.begin(), openings.end(), is); };
    y_ += 50.0;
    Point at(sheet_margin, y_);
    constexpr double sample = 40.0;
    const auto entry = [&](const std::string& name, const Lines& how) {
      Lines shown = how;
      shown.what = "legend";
      const Point middle = at - Point(0.0, 0.32 * small_size);
      if (shown.closed) {
        shown.lines = {outline({middle - Point(0.0, 9.0), middle + Point(sample, 9.0)})};
      } else {
        shown.lines = {{middle, middle + Point(sample, 0.0)}};
      }
      sheet_.items.emplace_back(std::move(shown));
      at.x = labels_.write("legend", name, at + Point(sample + 12.0, 0.0), small_size, false, ink).upper.x + 34.0;
    };
    entry("cut by the plane", {.what = {}, .lines = {}, .width = 2.4, .stroke = wall_ink});
    if (any([](const OpeningView& o) { return o.depth > 0.0; }))
      entry("wall beside", {.what = {}, .lines = {}, .fill = face_fill, .closed = true});
    entry("lower", {.what = {}, .lines = {}, .width = 1.4, .stroke = below_ink});
    if (any([](const OpeningView& o) { return o.mode != Mode::fly; })) {
      entry("floor", {.what = {}, .lines = {}, .fill = floor_fill, .closed = true});
    }
    if (any([](const OpeningView& o) { return o.fits; })) {
      entry("body", {.what = {}, .lines = {}, .width = 2.0, .stroke = body_ink, .fill = body_fill, .closed = true});
    }
    if (any([](const OpeningView& o) { return !o.fits; })) {
      entry("body that does not fit",
            {.what = {}, .lines = {}, .width = 2.0, .stroke = misfit_ink, .fill = misfit_fill, .closed = true});
    }
    if (any([](const OpeningView& o) { return o.support_radius > 0.0; })) {
      entry("foot", {.what = {}, .lines = {}, .width = 3.0, .stroke = foot_ink});
    }
    entry("measured", {.what = {}, .lines = {}, .width = 3.0, .stroke = measure_ink});
  }

  std::span<const Mesh> meshes_;
  Sheet sheet_;
  Labels labels_;
  double y_ = 0.0;
};

}  // namespace

Sheet opening_sheet(const std::string& title, std::span<const OpeningView> openings, std::span<const Mesh> meshes,
                    const std::string& text, const std::optional<Overview>& overview) {
  return OpeningPainter(meshes, measure_text).paint(title, text, overview, openings);
}

}  // namespace roam::draw
