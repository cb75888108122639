#include "draw/opening.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "draw/marks.h"
#include "draw/opening_drawing.h"
#include "draw/page.h"

namespace roam::draw {
namespace {

// Pixels.
constexpr double panel_gap = 40.0;
constexpr double panel_width = 0.5 * (content_width - panel_gap);
constexpr double crack_measure = 34.0;  ///< below the rim
constexpr double letter_beside = 16.0;

/// How far a body carried by the rims of a crack sinks into it, metres; 0 if it falls through.
double sunk(const OpeningView& o) {
  const double half = 0.5 * o.width;
  if (o.kind != OpeningView::Kind::crack || o.support_radius > half || o.radius <= half) return 0.0;
  return o.radius - std::sqrt(o.radius * o.radius - half * half);
}

/// Paints the plan and the section of one opening.
class OpeningPainter {
 public:
  OpeningPainter(const OpeningView& o, const OpeningDrawing& d)
      : o_(o), d_(d), style_(o.fits ? body_style : misfit_style) {}

  void plan(Panel& panel, const std::string& section_name) const {
    panel.areas("floor", d_.floor, floor_style);
    panel.segments("below", d_.plan_cut.below, below_style);
    panel.segments("above", d_.above, above_style);
    panel.segments("walls", d_.plan_cut.walls, wall_style);
    panel.border();
    section_line(panel, section_name);
    panel.disc("body", d_.body, o_.radius, style_);
    if (o_.support_radius > 0.0) panel.disc("disc", d_.body, o_.support_radius, disc_style);
    if (d_.is_level) {
      // An oblique width is longer than in the plan, so its number stands in the section.
      const Point half(d_.half_width.x, 0.0);
      measure(panel, -half, half, std::abs(o_.direction.z) < 0.1);
    }
    const double size = 1.6 * o_.radius * panel.scale();
    panel.block(d_.body, size, size);
    label_body(panel, d_.body - Point(0.0, o_.radius));
  }

  void section(Panel& panel) const {
    panel.areas("faces", d_.faces, face_style);
    panel.segments("walls", d_.section_cut, wall_style);
    panel.border();
    const Point feet(d_.body.x, o_.floor), middle_of_body = feet + Point(0.0, 0.5 * o_.height);
    panel.capsule("body", feet - Point(0.0, sunk(o_)), o_.radius, o_.height, style_);
    if (o_.support_radius > 0.0) {
      const Point left = feet - Point(o_.support_radius, 0.0), right = feet + Point(o_.support_radius, 0.0);
      panel.lines("disc", {{left, right}}, disc_line_style);
      panel.label("label", right, {"support disc", length_text(o_.support_radius) + " around"}, disc_style.stroke);
    }
    const bool crack = o_.kind == OpeningView::Kind::crack;
    if (crack && !o_.fits) {
      // Where the ground is missing.
      panel.sign("fall", {0.0, o_.floor}, {{{0.0, 50.0}, {0.0, 102.0}}, {{-11.0, 88.0}, {0.0, 102.0}, {11.0, 88.0}}},
                 {4.0, red});
      panel.block({0.0, o_.floor - 76.0 / panel.scale()}, 30.0, 56.0);
    }
    Point middle(0.0, o_.point.z - (crack ? crack_measure / panel.scale() : 0.0));
    // The number of a height stands beside the body, beyond the drawn lintel.
    if (!d_.is_level && o_.kind == OpeningView::Kind::passage) {
      const Point aside(d_.body.x + 1.2 * o_.radius, 0.0);
      std::vector<Polyline> drawn_out;
      for (const Point& end : {middle - d_.half_width, middle + d_.half_width}) {
        drawn_out.push_back({end, end + 1.15 * aside});
      }
      panel.lines("drawn out", std::move(drawn_out), drawn_out_style);
      middle += aside;
    }
    measure(panel, middle - d_.half_width, middle + d_.half_width, true);
    panel.block(middle_of_body, 2.0 * o_.radius * panel.scale(), o_.height * panel.scale());
    label_body(panel, middle_of_body + Point(o_.radius, 0.0));
  }

 private:
  void measure(Panel& panel, const Point& from, const Point& to, bool with_number) const {
    if (glm::distance(from, to) * panel.scale() < 1.0) return;
    panel.measure("measure", from, to);
    if (with_number) {
      panel.label("width", 0.5 * (from + to), {fmt::format("{:.3f} m", o_.width)}, purple, measure_size);
    }
  }

  void label_body(Panel& panel, const Point& at) const {
    // To the millimetre, like the width that it is compared with.
    std::vector<std::string> text{"body", fmt::format("{:.3f} m across", 2.0 * o_.radius)};
    if (o_.height > 2.0 * o_.radius) text.push_back(fmt::format("{:.3f} m high", o_.height));
    panel.label("label", at, text, style_.stroke);
  }

  /// The position of the section, outside the measured width.
  void section_line(Panel& panel, const std::string& name) const {
    const double beyond = std::max({0.5 * o_.width, o_.radius, o_.support_radius}) + 0.2 * o_.radius;
    const Point left = {panel.frame().view.lower.x, 0.0}, right = -left;
    panel.text("section name", left, {-letter_beside, 8.0}, name, caption_font, pale_ink);
    panel.text("section name", right, {letter_beside, 8.0}, name, caption_font, pale_ink);
    if (beyond >= right.x) return;
    panel.lines("section line", {{left, {-beyond, 0.0}}, {{beyond, 0.0}, right}}, section_line_style);
  }

  const OpeningView& o_;
  const OpeningDrawing& d_;
  const Style& style_;
};

void add_opening(Page& page, const OpeningView& o, std::span<const Mesh> meshes, char letter) {
  const OpeningDrawing drawing = drawing_of(o, meshes, panel_width);
  page.down(38.0);
  page.paragraph("heading", o.heading, heading_font, o.fits ? ink : red);
  page.down(4.0);
  page.paragraph("text", o.text, text_font, pale_ink);
  const double left = sheet_margin, right = left + panel_width + panel_gap;
  const std::string name(1, letter);
  page.begin_headings(true);
  page.heading("plan", {"Plan", fmt::format("cut at z = {:.2f} m", drawing.cut), 0.0, &drawing.turn, caption_font},
               left, left + panel_width);
  page.heading("section",
               {"Section " + name + "–" + name,
                o.mode == Mode::fly ? std::string() : fmt::format("feet at z = {:.2f} m", o.floor),
                drawing.section.scale_x, nullptr, caption_font},
               right, right + panel_width);
  const OpeningPainter painter(o, drawing);
  Panel plan = page.panel("plan", drawing.plan, left, &drawing.turn);
  Panel section = page.panel("section", drawing.section, right);
  painter.plan(plan, name);
  painter.section(section);
  page.below(section);
}

}  // namespace

Sheet opening_sheet(const std::string& title, std::span<const OpeningView> openings, std::span<const Mesh> meshes,
                    const std::string& text, const std::optional<Overview>& overview) {
  Page page;
  page.title(title);
  page.paragraph("text", text, text_font, pale_ink);
  if (overview) add_overview(page, *overview, meshes);
  char letter = 'A';
  for (const OpeningView& o : openings) add_opening(page, o, meshes, letter == 'Z' ? letter : letter++);
  page.legend(std::array<LegendEntry, 9>{{{"cut by the plane", wall_style},
                                          {"above", above_style},
                                          {"lower", below_style},
                                          {"wall beside", face_style},
                                          {"floor", floor_style},
                                          {"body", body_style},
                                          {"body that does not fit", misfit_style},
                                          {"support disc", disc_style},
                                          {"measured", measure_style}}});
  return page.finish();
}

}  // namespace roam::draw
