#include <algorithm>
#include <cmath>
#include <utility>

#include "graphics/hud_panels.h"

namespace roam::graphics {
namespace {

const osg::Vec4 panel_color(0.04f, 0.05f, 0.065f, 0.90f);
const osg::Vec4 heading_color(0.52f, 0.80f, 1.0f, 1.0f);
const osg::Vec4 key_color(1.0f, 1.0f, 1.0f, 1.0f);
const osg::Vec4 text_color(0.86f, 0.89f, 0.92f, 1.0f);
/// Below this nobody reads; a help of more keys than fit so is cut.
constexpr int smallest_letter = 7;
constexpr std::size_t most_columns = 5;

/// One column: lines [first, last), and how wide their two halves are.
struct Column {
  std::size_t first = 0, last = 0;
  float keys = 0, deeds = 0;
};

struct Arrangement {
  int letter = 0;
  float line = 0, gap = 0;
  float width = 0, height = 0;
  std::vector<Column> columns;
};

bool is_heading(const HelpLine& line) { return line.second.empty(); }

/// Above every heading but a column's first.
constexpr float heading_space = 0.6f;  // lines

/// Lines that a column of these is high.
float height_of(const std::vector<HelpLine>& lines, const Column& column) {
  float height = static_cast<float>(column.last - column.first);
  for (std::size_t i = column.first + 1; i < column.last; ++i) height += is_heading(lines[i]) ? heading_space : 0.0f;
  return height;
}

/// Where the column ends when a heading with few lines of its own at the foot goes to the next column.
std::size_t without_stub(const std::vector<HelpLine>& lines, const Column& column) {
  constexpr std::size_t stub = 3;  // lines, the heading counted
  for (std::size_t i = column.last - 1; i > column.first && i + stub >= column.last; --i) {
    if (is_heading(lines[i])) return i;
  }
  return column.last;
}

/// Columns of at most `most` lines.
std::vector<Column> cut(const std::vector<HelpLine>& lines, float most) {
  std::vector<Column> columns;
  for (std::size_t first = 0; first < lines.size();) {
    Column column{first, first + 1};
    while (column.last < lines.size() && height_of(lines, {first, column.last + 1}) <= most) ++column.last;
    if (column.last < lines.size()) column.last = without_stub(lines, column);
    columns.push_back(column);
    first = column.last;
  }
  return columns;
}

/// At most `count` columns, as even as they can be.
std::vector<Column> cut_evenly(const std::vector<HelpLine>& lines, std::size_t count) {
  const float all = height_of(lines, {0, lines.size()});
  float most = std::floor(all / static_cast<float>(count));
  std::vector<Column> columns = cut(lines, most);
  while (columns.size() > count) columns = cut(lines, ++most);
  return columns;
}

Arrangement arrange(const std::vector<HelpLine>& lines, int letter, std::size_t count) {
  Arrangement a;
  a.letter = letter;
  a.line = std::round(1.5f * static_cast<float>(letter));
  a.gap = std::round(1.0f * static_cast<float>(letter));
  a.columns = cut_evenly(lines, count);
  float highest = 0;
  for (Column& column : a.columns) {
    highest = std::max(highest, height_of(lines, column));
    for (std::size_t i = column.first; i < column.last; ++i) {
      const float width = width_of(lines[i].first, {letter, true, key_color});
      if (is_heading(lines[i])) {
        column.deeds = std::max(column.deeds, width - column.keys - a.gap);
      } else {
        column.keys = std::max(column.keys, width);
        column.deeds = std::max(column.deeds, width_of(lines[i].second, {letter, false, text_color}));
      }
    }
    a.width += std::ceil(column.keys + a.gap + column.deeds);
  }
  a.width += 2.5f * a.gap * static_cast<float>(a.columns.size() - 1) + 3 * a.gap;
  a.height = a.line * highest + 2 * a.gap;
  return a;
}

/// The message stays seen below the help.
float bottom_of_help(const Page& page) { return 0.07f * page.height + 3.6f * static_cast<float>(page.letter); }

/// The largest letters with which all fits, and with them the fewest columns.
Arrangement fit(const Page& page, const std::vector<HelpLine>& lines) {
  const float width = page.width - 2 * page.margin, height = page.height - bottom_of_help(page) - page.margin;
  Arrangement last;
  for (int letter = page.letter; letter >= smallest_letter; --letter) {
    for (std::size_t count = 1; count <= most_columns; ++count) {
      last = arrange(lines, letter, count);
      if (last.width > width) break;
      if (last.height <= height) return last;
    }
  }
  return last;
}

}  // namespace

osg::ref_ptr<osg::Node> make_help(const Page& page, const std::vector<HelpLine>& lines, osg::StateSet* plates) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  if (lines.empty()) return group;
  const Arrangement a = fit(page, lines);
  const float left = std::round(0.5f * (page.width - a.width));
  const float middle = 0.5f * (bottom_of_help(page) + page.height - page.margin);
  const float top = std::round(middle + 0.5f * a.height);
  osg::ref_ptr<osg::Geometry> panel =
      make_plate({left, top - a.height, a.width, a.height}, 0.6f * page.margin, panel_color);
  panel->setStateSet(plates);
  group->addChild(panel);

  float x = left + 1.5f * a.gap;
  for (const Column& column : a.columns) {
    float y = top - a.gap - std::round(1.1f * static_cast<float>(a.letter));
    for (std::size_t i = column.first; i < column.last; ++i) {
      if (is_heading(lines[i]) && i > column.first) y -= std::round(heading_space * a.line);
      const osg::Vec4& color = is_heading(lines[i]) ? heading_color : key_color;
      group->addChild(make_text(lines[i].first, {a.letter, true, color}, std::round(x), y));
      if (!is_heading(lines[i])) {
        const float deed_x = std::round(x + column.keys + a.gap);
        group->addChild(make_text(lines[i].second, {a.letter, false, text_color}, deed_x, y));
      }
      y -= a.line;
    }
    x += std::ceil(column.keys + a.gap + column.deeds) + 2.5f * a.gap;
  }
  return group;
}

}  // namespace roam::graphics
