#include "draw/legend.h"

#include <fmt/format.h>

#include "draw/panel.h"

namespace roam::draw {
namespace {

constexpr double size = 20.0;
constexpr double row_height = 36.0;
constexpr double sample_width = 40.0;
constexpr double gap = 34.0;

/// Samples one after the other, from the left, in rows.
class Rows {
 public:
  Rows(Sheet& sheet, Labels& labels, double top) : sheet_(sheet), labels_(labels), at_(sheet_margin, top) {}

  /// `draw` draws a sample around the middle of a box of the given width.
  template <class Draw>
  void entry(const std::string& text, double width, const Draw& draw) {
    const double needed = width + 12.0 + labels_.measured(text, size, false).width();
    if (at_.x > sheet_margin && at_.x + needed > sheet_margin + content_width) {
      at_ = {sheet_margin, at_.y + row_height};
    }
    draw(at_ + Point(0.5 * width, -0.32 * size));
    labels_.write("legend", text, at_ + Point(width + 12.0, 0.0), size, false, ink);
    at_.x += needed + gap;
  }

  void line(const std::string& text, double width, const Colour& colour) {
    entry(text, sample_width, [&](const Point& p) {
      const Point half(0.5 * sample_width, 0.0);
      sheet_.items.emplace_back(
          Lines{.what = "legend sample", .lines = {{p - half, p + half}}, .width = width, .stroke = colour});
    });
  }

  void disc(const std::string& text, double radius, double width, const Colour& stroke, const Colour& fill) {
    entry(text, 2.0 * radius + 4.0, [&](const Point& p) {
      sheet_.items.emplace_back(
          Disc{.what = "legend sample", .centre = p, .radius = radius, .width = width, .stroke = stroke, .fill = fill});
    });
  }

  [[nodiscard]] double bottom() const { return at_.y; }

 private:
  Sheet& sheet_;
  Labels& labels_;
  Point at_;
};

bool shows(const Sheet& sheet, const std::string& ending) {
  return std::any_of(sheet.items.begin(), sheet.items.end(), [&](const auto& item) {
    return std::visit([&](const auto& shape) { return shape.what.ends_with(ending); }, item);
  });
}

std::string gap_text(const GapScale& scale, std::size_t k) {
  if (k == 0) return "< " + length_text(scale.limits[0]);
  if (k < scale.limits.size()) return "< " + length_text(scale.limits[k]);
  return "more";
}

}  // namespace

double draw_legend(const Contents& contents, Sheet& sheet, Labels& labels, double top) {
  // Looks before the legend adds its own items.
  const bool below = shows(sheet, " below"), touched = shows(sheet, " touch"), body = shows(sheet, " body"),
             narrowest = shows(sheet, " narrowest");
  Rows rows(sheet, labels, top + 48.0);
  rows.line("cut by the plane", 2.5, wall_ink);
  if (below) rows.line(contents.report.mode == Mode::walk ? "lower, or gently rising" : "lower", 2.0, below_ink);
  if (contents.report.mode == Mode::ghost) {
    rows.line("way", 5.0, ghost_ink);
  } else {
    const GapScale scale(contents.report.settings.radius);
    for (std::size_t k = 0; k < GapScale::colours.size(); ++k) {
      rows.line((k == 0 ? "way, room beside the body " : "") + gap_text(scale, k), 5.0, GapScale::colours[k]);
    }
  }
  if (body) rows.disc("body, to scale", 11.0, 1.6, body_ink, body_fill);
  if (touched) rows.disc("touched", 4.5, 1.0, paper, touch_ink);
  if (narrowest) rows.line("narrowest: clear width across the way", 2.6, mark_colour(MarkKind::narrowest));
  return rows.bottom();
}

}  // namespace roam::draw
