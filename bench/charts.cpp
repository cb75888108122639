#include "charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/page.h"
#include "draw/picture_file.h"
#include "words/measures.h"

namespace roam::bench {
namespace {

using draw::Panel;
using draw::Point;
using Align = draw::Labels::Align;

// Pixels.
constexpr double chart_width = 1400.0;
constexpr double row = 34.0, gap = 56.0;
constexpr double beside = 12.0;  ///< between a bar or a curve and its text
constexpr double least_bars = 300.0;

constexpr double shortest = 1e-3;  ///< microseconds: shorter times are drawn here

/// Powers of ten that an axis spans: all of `least` to `greatest`, at least one.
struct Axis {
  double from, to;
  Axis(double least, double greatest)
      : from(std::floor(std::log10(std::max(least, shortest)))),
        to(std::max(from + 1.0, std::ceil(std::log10(std::max(greatest, shortest))))) {}
  [[nodiscard]] double at(double value) const { return std::clamp(std::log10(std::max(value, shortest)), from, to); }
};

/// Lines at the powers of ten, from the bottom to the top, or from the left to the right.
void grid(Panel& panel, const Axis& axis, bool upright) {
  const draw::Rect& view = panel.frame().view;
  for (double power = axis.from; power <= axis.to; ++power) {
    const Point begin = upright ? Point(power, view.lower.y) : Point(view.lower.x, power);
    const Point end = upright ? Point(power, view.upper.y) : Point(view.upper.x, power);
    panel.lines("grid", {{begin, end}}, draw::frame_style);
    const double value = std::pow(10.0, power);
    panel.text(
        "power", begin, upright ? Point(0.0, 34.0) : Point(-beside, 7.0),
        value < 1.0 ? fmt::format("{:g}", value) : words::grouped(static_cast<std::uint64_t>(std::lround(value))),
        draw::small_font, draw::pale_ink, upright ? Align::centre : Align::right);
  }
}

/// Three digits, more only before the decimal point.
std::string figure(double value) { return fmt::format(fmt::runtime(value < 1000.0 ? "{:.3g}" : "{:.0f}"), value); }

std::string figures(const Bar& bar) {
  const std::string times = bar.p99 > 0.0 ? figure(bar.p50) + " / " + figure(bar.p99) : "";
  return bar.note.empty() ? times : times + "  " + bar.note;
}

}  // namespace

draw::Sheet bar_chart(const std::string& title, const std::vector<BarGroup>& groups) {
  double height = 0.0, names = 0.0, notes = 0.0, least = 1e9, greatest = shortest;
  for (const BarGroup& group : groups) {
    height += gap;
    for (const Bar& bar : group.bars) {
      height += row;
      names = std::max(names, draw::measure_text(bar.name, draw::small_bold_font).width());
      notes = std::max(notes, draw::measure_text(figures(bar), draw::small_font).width());
      if (bar.p50 > 0.0) least = std::min(least, bar.p50);
      greatest = std::max(greatest, bar.p99);
    }
  }
  // Half of the least value, so that the shortest bar is visible.
  const Axis axis(0.5 * std::min(least, greatest), greatest);
  const double left = draw::sheet_margin + names + beside;
  const double width = std::max(least_bars, chart_width - draw::sheet_margin - notes - beside - left);

  draw::Page page(chart_width);
  page.paragraph("title", title, draw::heading_font, draw::ink);
  page.paragraph("text", "microseconds: dark to the median, light to p99; figures are p50 / p99", draw::text_font,
                 draw::pale_ink);
  Panel panel = page.panel("bars", {{{axis.from, 0.0}, {axis.to, height}}, width / (axis.to - axis.from), 1.0}, left);
  grid(panel, axis, true);
  double y = height;
  for (const BarGroup& group : groups) {
    y -= gap;
    panel.text("group", {axis.from, y}, {draw::sheet_margin - left, -10.0}, group.title, draw::caption_font, draw::ink,
               Align::left);
    for (const Bar& bar : group.bars) {
      y -= row;
      const draw::Colour colour = bar.stressed ? draw::orange : draw::blue;
      const auto bar_to = [&](const char* what, double us, const draw::Colour& fill) {
        const draw::Rect covered{{axis.from, y + 4.0}, {axis.at(us), y + row - 4.0}};
        if (us > 0.0) panel.areas(what, {covered.outline()}, draw::area_style(fill));
      };
      bar_to("p99", bar.p99, colour.at(0.35));
      bar_to("p50", bar.p50, colour);
      panel.text("name", {axis.from, y}, {-beside, -10.0}, bar.name,
                 bar.stressed ? draw::small_bold_font : draw::small_font, draw::ink, Align::right);
      panel.text("figures", {axis.at(bar.p99), y}, {beside, -10.0}, figures(bar), draw::small_font, draw::ink,
                 Align::left);
    }
  }
  page.below(panel);
  page.down(40.0);
  return page.finish();
}

draw::Sheet step_chart(const std::vector<StepTimes>& times) {
  constexpr double left = 170.0, width = 1060.0, height = 660.0;  // pixels
  double fewest = 1e18, most = 1.0, least = 1e18, greatest = shortest;
  for (const StepTimes& t : times) {
    fewest = std::min(fewest, static_cast<double>(t.triangles));
    most = std::max(most, static_cast<double>(t.triangles));
    least = std::min(least, t.median_us);
    greatest = std::max(greatest, t.p99_us);
  }
  const Axis size(fewest, most), time(least, greatest);

  draw::Page page(chart_width);
  page.paragraph("title", "Microseconds a step, by triangles in the scene", draw::heading_font, draw::ink);
  page.down(12.0);
  Panel panel = page.panel(
      "steps",
      {{{size.from, time.from}, {size.to, time.to}}, width / (size.to - size.from), height / (time.to - time.from)},
      left);
  grid(panel, size, true);
  grid(panel, time, false);
  panel.border();
  const auto curve = [&](const char* name, double StepTimes::*which, const draw::Colour& colour) {
    draw::Polyline line;
    for (const StepTimes& t : times) line.emplace_back(size.at(static_cast<double>(t.triangles)), time.at(t.*which));
    for (const Point& p : line) panel.dot(name, p, 6.0, draw::area_style(colour));
    panel.text(name, line.back(), {beside, 7.0}, name, draw::small_bold_font, colour, Align::left);
    panel.lines(name, {std::move(line)}, {4.0, colour});
  };
  curve("median", &StepTimes::median_us, draw::blue);
  curve("p99", &StepTimes::p99_us, draw::orange);
  page.below(panel);
  page.down(40.0);
  return page.finish();
}

}  // namespace roam::bench
