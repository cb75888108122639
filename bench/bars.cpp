#include "bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "roam/error.h"

namespace roam::bench {
namespace {

// Sizes of the picture, in its own units.
constexpr double width = 810.0, left = 200.0, right = 240.0, top = 56.0, row = 20.0, gap = 34.0, bottom = 24.0;

/// Three digits, more only before the decimal point.
std::string figure(double value) { return fmt::format(fmt::runtime(value < 1000.0 ? "{:.3g}" : "{:.0f}"), value); }

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

std::string text(double x, double y, const char* anchor, const std::string& words, const char* more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" {}>{}</text>\n", x, y, anchor, more,
                     escaped(words));
}

/// Powers of ten that the axis spans.
struct Axis {
  int least = 0, greatest = 1;
  [[nodiscard]] double x(double us) const {
    const double part = (std::log10(std::max(us, 1e-9)) - least) / (greatest - least);
    return left + (width - left - right) * std::clamp(part, 0.0, 1.0);
  }
};

Axis axis_of(const std::vector<BarGroup>& groups) {
  double least = 1e9, greatest = 1e-9;
  for (const BarGroup& group : groups) {
    for (const Bar& bar : group.bars) {
      if (bar.p50 > 0) least = std::min(least, bar.p50);
      greatest = std::max(greatest, bar.p99);
    }
  }
  if (least > greatest) return {};
  // Half of the least value, so that the shortest bar is visible.
  const int from = static_cast<int>(std::floor(std::log10(0.5 * least)));
  return {from, std::max(from + 1, static_cast<int>(std::ceil(std::log10(greatest))))};
}

std::string drawn(const Bar& bar, const Axis& axis, double y) {
  std::string out = text(left - 8, y + 14, "end", bar.name, bar.stressed ? "font-weight=\"bold\"" : "");
  const char* dark = bar.stressed ? "#c1440e" : "#1f6fb4";
  const char* light = bar.stressed ? "#efb9a0" : "#a9cbe8";
  const auto bar_to = [&](double us, const char* colour) {
    return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n", left,
                       y + 3, axis.x(us) - left, row - 6, colour);
  };
  if (bar.p99 > 0) out += bar_to(bar.p99, light);
  if (bar.p50 > 0) out += bar_to(bar.p50, dark);
  const std::string figures = bar.p99 > 0 ? figure(bar.p50) + " / " + figure(bar.p99) : "";
  return out + text(axis.x(bar.p99) + 6, y + 14, "start", figures + (bar.note.empty() ? "" : "  " + bar.note));
}

}  // namespace

void write_bars(const std::string& file, const std::string& title, const std::vector<BarGroup>& groups) {
  double height = top + bottom;
  for (const BarGroup& group : groups) height += gap + row * static_cast<double>(group.bars.size());
  const Axis axis = axis_of(groups);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
      width, height);
  out += text(12, 20, "start", title, "font-size=\"14\"");
  out += text(12, 38, "start", "microseconds: dark to the median, light to p99; figures are p50 / p99");
  for (int power = axis.least; power <= axis.greatest; ++power) {
    const double x = axis.x(std::pow(10.0, power));
    out += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}\" stroke=\"#ddd\"/>\n", x, top, height - bottom);
    out += text(x, height - bottom + 16, "middle", fmt::format("{:g}", std::pow(10.0, power)));
  }
  double y = top;
  for (const BarGroup& group : groups) {
    out += text(12, y + 22, "start", group.title, "font-weight=\"bold\"");
    y += gap;
    for (const Bar& bar : group.bars) {
      out += drawn(bar, axis, y);
      y += row;
    }
  }
  std::ofstream stream(file);
  stream << out << "</svg>\n";
  stream.close();
  if (!stream) throw Error("cannot write " + file + "; check the folder's permissions and the free space");
}

}  // namespace roam::bench
