#include "draw/labels.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "draw/picture_file.h"
#include "text/printable.h"

namespace roam::draw {
namespace {

constexpr double padding = 5.0;           ///< pixels around the lines of a label
constexpr double avoided_step = 8.0;      ///< pixels between the points of a line to avoid
constexpr double farthest_beside = 18.0;  ///< pixels between a label and its anchor without a line between them

}  // namespace

std::vector<std::string> wrapped(const std::string& text, double width, const Font& font) {
  const auto fits = [&](const std::string& line) { return measure_text(line, font).width() <= width; };
  const std::string shown = printable(text, text.size());
  std::vector<std::string> lines{""};
  for (std::size_t i = 0; i < shown.size();) {
    std::size_t end = std::min(shown.find(' ', i), shown.size());
    const std::string longer = lines.back() + (lines.back().empty() ? "" : " ") + shown.substr(i, end - i);
    if (fits(longer)) {
      lines.back() = longer;
      i = end + 1;
      continue;
    }
    if (!lines.back().empty()) {
      lines.emplace_back();
      continue;
    }
    // A word longer than a line: as many of its characters as fit.
    std::size_t part = i;
    while (part < end) {
      const std::size_t next = part + first_character(std::string_view(shown).substr(part)).bytes;
      if (part > i && !fits(shown.substr(i, next - i))) break;
      part = next;
    }
    lines.back() = shown.substr(i, part - i);
    lines.emplace_back();
    i = part;
  }
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

Rect Labels::write(const std::string& what, const std::string& text, const Point& at, const Font& font,
                   const Colour& colour, Align align) {
  const std::string shown = printable(text, text.size());
  const Rect extent = measure_text(shown, font);
  const double shift = align == Align::left ? 0.0 : align == Align::centre ? 0.5 * extent.width() : extent.width();
  const Point from = at - Point(shift, 0.0);
  const Rect box{from + extent.lower, from + extent.upper};
  sheet_.items.emplace_back(Text{what, shown, from, font, colour, box});
  taken_.push_back(box);
  return box;
}

void Labels::avoid(const std::vector<Polyline>& lines, double weight) {
  for (const Polyline& line : lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const double length = glm::distance(line[i], line[i + 1]);
      for (double t = 0.0; t < length; t += avoided_step) {
        avoided_.emplace_back(line[i] + (t / length) * (line[i + 1] - line[i]), weight);
      }
    }
  }
}

bool Labels::is_free(const Rect& r) const {
  return std::none_of(taken_.begin(), taken_.end(), [&](const Rect& other) { return other.overlaps(r); });
}

double Labels::covered(const Rect& r) const {
  double sum = 0.0;
  for (const auto& [p, weight] : avoided_) sum += r.contains(p) ? weight : 0.0;
  return sum;
}

bool Labels::place(const std::string& what, const std::vector<std::string>& lines, const Colour& colour, double letters,
                   const Point& anchor, const Rect& panel) {
  const auto font = [&](std::size_t i) { return Font{letters, i == 0}; };
  double width = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    width = std::max(width, measure_text(printable(lines[i]), font(i)).width());
  }
  const Rect line = measure_text("x", font(0));
  const double step = line.height();
  const double height = step * static_cast<double>(lines.size());
  const Point size(width + 2.0 * padding, height + 2.0 * padding);

  constexpr std::array<Point, 8> directions{{{0, -1}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}, {1, 0}, {-1, 0}}};
  double best = std::numeric_limits<double>::infinity();
  Rect box;
  const auto consider = [&](const Point& centre, double cost) {
    const Rect candidate = Rect::around(centre, size.x, size.y);
    if (!panel.contains(candidate) || cost >= best || !is_free(candidate)) return;
    cost += covered(candidate);
    if (cost < best) {
      best = cost;
      box = candidate;
    }
  };
  for (const double away : {14.0, 30.0, 55.0, 90.0, 140.0, 200.0}) {
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const Point way = directions[k], centre = anchor + way * (0.5 * size + away);
      const double cost = 0.15 * away + 0.1 * static_cast<double>(k);
      consider(centre, cost);
      if (way.x != 0.0) continue;
      // Above and below, it may also begin or end at the anchor.
      const Point aside(0.5 * size.x - 20.0, 0.0);
      consider(centre + aside, cost);
      consider(centre - aside, cost);
    }
  }
  if (box.empty()) {
    for (double y = panel.lower.y + 0.5 * size.y; y < panel.upper.y; y += 10.0) {
      for (double x = panel.lower.x + 0.5 * size.x; x < panel.upper.x; x += 20.0) {
        consider({x, y}, glm::distance(Point(x, y), anchor));
      }
    }
  }
  if (box.empty()) return false;

  const Point edge = glm::clamp(anchor, box.lower, box.upper);
  if (glm::distance(edge, anchor) > farthest_beside) {
    sheet_.items.emplace_back(Lines{"leader", {{anchor, edge}}, {.width = 1.2, .stroke = colour}});
  }
  sheet_.items.emplace_back(Lines{"label ground", {box.outline()}, ground_style, true});
  Point at(box.lower.x + padding, box.lower.y + padding - line.lower.y);
  taken_.push_back(box);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    write(what, lines[i], at, font(i), i == 0 ? colour : ink);
    at.y += step;
  }
  return true;
}

}  // namespace roam::draw
