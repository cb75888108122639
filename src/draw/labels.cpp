#include "draw/labels.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace roam::draw {
namespace {

constexpr double padding = 5.0;       ///< pixels around the lines of a label
constexpr double avoided_step = 8.0;  ///< pixels between the points of a line to avoid

/// Number of bytes of the UTF-8 character at `i`; 0 if there is none.
std::size_t character(const std::string& s, std::size_t i) {
  const auto byte = [&](std::size_t k) { return k < s.size() ? static_cast<unsigned char>(s[k]) : 0U; };
  const unsigned first = byte(i);
  if (first >= 0x20U && first < 0x7fU) return 1;
  const std::size_t size = first >= 0xf0U && first < 0xf5U ? 4 : first >= 0xe0U ? 3 : first >= 0xc2U ? 2 : 0;
  if (size == 0 || first >= 0xf5U) return 0;
  for (std::size_t k = 1; k < size; ++k) {
    if ((byte(i + k) & 0xc0U) != 0x80U) return 0;
  }
  const unsigned second = byte(i + 1);
  const bool overlong = (first == 0xe0U && second < 0xa0U) || (first == 0xf0U && second < 0x90U);
  const bool beyond = (first == 0xedU && second >= 0xa0U) || (first == 0xf4U && second >= 0x90U);
  const bool control = first == 0xc2U && second < 0xa0U;
  return overlong || beyond || control ? 0 : size;
}

Point nearest_of(const Rect& r, const Point& p) {
  return {std::clamp(p.x, r.lower.x, r.upper.x), std::clamp(p.y, r.lower.y, r.upper.y)};
}

}  // namespace

std::string with_question_marks(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = character(text, i);
    result += size > 0 ? text.substr(i, size) : "?";
    i += std::max<std::size_t>(size, 1);
  }
  return result;
}

std::vector<std::string> wrapped(const std::string& text, double width, double size, bool bold,
                                 const MeasureText& measure) {
  const auto fits = [&](const std::string& line) { return measure(line, size, bold).width() <= width; };
  const std::string shown = with_question_marks(text);
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
      const std::size_t next = part + character(shown, part);
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

Rect Labels::write(const std::string& what, const std::string& text, const Point& at, double size, bool bold,
                   const Colour& colour, Align align) {
  const std::string shown = with_question_marks(text);
  const Rect extent = measure_(shown, size, bold);
  const double shift = align == Align::left ? 0.0 : align == Align::centre ? 0.5 * extent.width() : extent.width();
  const Point from = at - Point(shift, 0.0);
  const Rect box{from + extent.lower, from + extent.upper};
  sheet_.items.emplace_back(Text{what, shown, from, size, bold, colour, box});
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

bool Labels::place(const Label& label, const Point& anchor, const Rect& panel) {
  double width = 0.0;
  for (std::size_t i = 0; i < label.lines.size(); ++i) {
    width = std::max(width, measured(label.lines[i], label.size, i == 0).width());
  }
  const Rect line = measured("x", label.size, true);
  const double step = line.height();
  const double height = step * static_cast<double>(label.lines.size());
  const Point size(width + 2.0 * padding, height + 2.0 * padding);

  constexpr std::array<std::array<double, 2>, 8> directions{
      {{0, -1}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}, {1, 0}, {-1, 0}}};
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
      const auto [x, y] = directions[k];
      const Point centre = anchor + Point(x * (0.5 * size.x + away), y * (0.5 * size.y + away));
      consider(centre, 0.15 * away + 0.1 * static_cast<double>(k));
      // Above and below, it may also begin or end at the anchor.
      if (x == 0.0) {
        consider(centre + Point(0.5 * size.x - 20.0, 0.0), 0.15 * away + 0.1 * static_cast<double>(k));
        consider(centre - Point(0.5 * size.x - 20.0, 0.0), 0.15 * away + 0.1 * static_cast<double>(k));
      }
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

  const Point edge = nearest_of(box, anchor);
  if (glm::distance(edge, anchor) > 18.0) {
    sheet_.items.emplace_back(Lines{.what = "leader", .lines = {{anchor, edge}}, .width = 1.2, .stroke = label.colour});
  }
  constexpr Colour ground{1.0, 1.0, 1.0, 0.82};
  sheet_.items.emplace_back(
      Lines{.what = "label ground",
            .lines = {{box.lower, {box.upper.x, box.lower.y}, box.upper, {box.lower.x, box.upper.y}}},
            .fill = ground,
            .closed = true});
  Point at(box.lower.x + padding, box.lower.y + padding - line.lower.y);
  taken_.push_back(box);
  for (std::size_t i = 0; i < label.lines.size(); ++i) {
    write(label.what, label.lines[i], at, label.size, i == 0, i == 0 ? label.colour : ink);
    at.y += step;
  }
  return true;
}

}  // namespace roam::draw
