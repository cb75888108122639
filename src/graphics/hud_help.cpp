#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "graphics/hud_panels.h"

namespace roam::graphics {
namespace {

const osg::Vec4 help_panel_color(0.04f, 0.05f, 0.065f, 0.90f);
const osg::Vec4 focused_color(0.30f, 0.45f, 0.62f, 0.95f);
const osg::Vec4 heading_color(0.52f, 0.80f, 1.0f, 1.0f);
const osg::Vec4 key_color(1.0f, 1.0f, 1.0f, 1.0f);
const osg::Vec4 deed_color(0.86f, 0.89f, 0.92f, 1.0f);
/// Pixels. Lines are broken, and then divided into pages, before letters get smaller than this.
constexpr int smallest_letter = 10;
constexpr std::size_t most_columns = 5;
constexpr float columns_gap = 2.5f;  ///< in gaps between a key and its effect

/// One column: lines [first, last), and the widths of its two halves.
struct Column {
  std::size_t first = 0, last = 0;
  float keys = 0, deeds = 0;
};

struct Arrangement {
  std::vector<HelpLine> lines;
  int letter = 0;
  float line = 0, gap = 0;
  float width = 0, height = 0;
  std::vector<Column> columns;
  std::size_t page = 0, pages = 1;
  std::string footer;  ///< below the columns, if there are several pages
};

bool is_heading(const HelpLine& line) { return line.effect.empty(); }

/// Above every heading, except at the top of a column.
constexpr float heading_space = 0.6f;  // lines

/// The footer's height, with the space above it.
constexpr float footer_height = 1.0f + heading_space;  // lines

/// Height of a column, in lines.
float height_of(const std::vector<HelpLine>& lines, const Column& column) {
  float height = static_cast<float>(column.last - column.first);
  for (std::size_t i = column.first + 1; i < column.last; ++i) height += is_heading(lines[i]) ? heading_space : 0.0f;
  return height;
}

/// The end of the column after moving a heading with few lines at its foot to the next column.
std::size_t without_stub(const std::vector<HelpLine>& lines, const Column& column) {
  constexpr std::size_t stub = 3;  // lines, the heading counted
  for (std::size_t i = column.last - 1; i > column.first && i + stub >= column.last; --i) {
    if (is_heading(lines[i])) return i;
  }
  return column.last;
}

/// Divides the lines into columns of at most `most` lines.
std::vector<Column> cut(const std::vector<HelpLine>& lines, float most) {
  std::vector<Column> columns;
  for (std::size_t first = 0; first < lines.size();) {
    Column column{first, first + 1};
    while (column.last < lines.size() && height_of(lines, {first, column.last + 1}) <= most) ++column.last;
    if (column.last < lines.size()) column.last = without_stub(lines, column);
    // A broken line stays whole.
    std::size_t whole = column.last;
    while (whole > first && whole < lines.size() && lines[whole].key.empty()) --whole;
    if (whole > first) column.last = whole;
    columns.push_back(column);
    first = column.last;
  }
  return columns;
}

/// Divides the lines into at most `count` columns of similar height.
std::vector<Column> cut_evenly(const std::vector<HelpLine>& lines, std::size_t count) {
  const float all = height_of(lines, {0, lines.size()});
  float most = std::floor(all / static_cast<float>(count));
  std::vector<Column> columns = cut(lines, most);
  while (columns.size() > count) columns = cut(lines, ++most);
  return columns;
}

Arrangement blank(int letter) {
  Arrangement a;
  a.letter = letter;
  a.line = std::round(1.5f * static_cast<float>(letter));
  a.gap = std::round(1.0f * static_cast<float>(letter));
  return a;
}

/// Computes the positions of the columns.
Arrangement arrange(const std::vector<HelpLine>& lines, int letter, std::vector<Column> columns) {
  Arrangement a = blank(letter);
  a.lines = lines;
  a.columns = std::move(columns);
  float highest = 0;
  for (Column& column : a.columns) {
    highest = std::max(highest, height_of(lines, column));
    for (std::size_t i = column.first; i < column.last; ++i) {
      const float width = width_of(lines[i].key, {letter, true, key_color});
      if (is_heading(lines[i])) {
        column.deeds = std::max(column.deeds, width - column.keys - a.gap);
      } else {
        column.keys = std::max(column.keys, width);
        column.deeds = std::max(column.deeds, width_of(lines[i].effect, {letter, false, deed_color}));
      }
    }
    a.width += std::ceil(column.keys + a.gap + column.deeds);
  }
  a.width += columns_gap * a.gap * static_cast<float>(a.columns.size() - 1) + 3 * a.gap;
  a.height = a.line * highest + 2 * a.gap;
  return a;
}

/// The bottom of the help, above the message, which is not there on a small page.
float bottom_of_help(const Page& page) {
  return page.small ? page.margin : 0.07f * page.height + 3.6f * static_cast<float>(page.letter);
}

/// The lines, broken so that a column of them is at most `width` pixels wide. Text without a space is shortened.
std::vector<HelpLine> narrowed(const std::vector<HelpLine>& lines, int letter, float width) {
  const Look key_look{letter, true, key_color}, deed_look{letter, false, deed_color};
  const float gap = blank(letter).gap;
  float keys = 0;
  for (const HelpLine& line : lines) {
    if (!is_heading(line)) keys = std::max(keys, width_of(line.key, key_look));
  }
  keys = std::min(keys, 0.5f * width);
  const float deeds = width - keys - gap;
  std::vector<HelpLine> broken;
  for (const auto& [key, deed, name] : lines) {
    if (deed.empty()) {
      broken.push_back({shorten(key, key_look, width), ""});
      continue;
    }
    std::string first = shorten(key, key_look, keys);
    for (const std::string& line : break_lines(deed, deed_look, deeds)) {
      broken.push_back({std::exchange(first, {}), shorten(line, deed_look, deeds), name});
    }
  }
  return broken;
}

/// The width of each of `count` columns; none if each line would be one word.
std::optional<float> width_of_column(float width, int letter, std::size_t count) {
  constexpr float least = 14.0f;  // letters
  const float gap = blank(letter).gap;
  const auto n = static_cast<float>(count);
  const float column = std::floor((width - 3 * gap - columns_gap * gap * (n - 1)) / n) - 1;
  if (count > 1 && column < least * static_cast<float>(letter)) return std::nullopt;
  return column;
}

/// One of the pages with the fewest columns with which there are as few pages as possible.
Arrangement paged(const std::vector<HelpLine>& lines, float width, float height, std::size_t page) {
  const Arrangement none = blank(smallest_letter);
  const float most = std::floor((height - 2 * none.gap) / none.line - footer_height);
  Arrangement best;
  if (most < 2) return best;
  for (std::size_t count = 1; count <= most_columns; ++count) {
    const auto column = width_of_column(width, smallest_letter, count);
    if (!column) break;
    const std::vector<HelpLine> broken = narrowed(lines, smallest_letter, *column);
    std::vector<Column> columns = cut(broken, most);
    const std::size_t pages = (columns.size() + count - 1) / count;
    if (!best.columns.empty() && pages >= best.pages) continue;
    const std::size_t shown = std::min(page, pages - 1);
    const auto first = columns.begin() + static_cast<std::ptrdiff_t>(shown * count);
    const auto last = columns.begin() + static_cast<std::ptrdiff_t>(std::min((shown + 1) * count, columns.size()));
    const Look look{smallest_letter, true, heading_color};
    const std::string footer = shorten(fmt::format("Page {} of {}: click here, or turn the wheel", shown + 1, pages),
                                       look, width - 3 * none.gap);
    Arrangement a = arrange(broken, smallest_letter, {first, last});
    a.width = std::max(a.width, std::ceil(width_of(footer, look)) + 3 * none.gap);
    a.height += footer_height * a.line;
    if (a.width > width || a.height > height) continue;
    a.page = shown;
    a.pages = pages;
    a.footer = footer;
    best = std::move(a);
  }
  return best;
}

/// The arrangement with the largest letters with which all lines fit, then with unbroken lines if possible, then with
/// the fewest columns. If none fits, a page of them.
Arrangement fit(const Page& page, const std::vector<HelpLine>& lines, std::size_t shown) {
  const float width = page.width - 2 * page.margin, height = page.height - bottom_of_help(page) - page.margin;
  const auto fits = [&](const Arrangement& a) { return a.width <= width && a.height <= height; };
  for (int letter = std::max(page.letter, smallest_letter); letter >= smallest_letter; --letter) {
    for (std::size_t count = 1; count <= most_columns; ++count) {
      Arrangement a = arrange(lines, letter, cut_evenly(lines, count));
      if (a.width > width) break;
      if (fits(a)) return a;
    }
  }
  for (std::size_t count = 1; count <= most_columns; ++count) {
    const auto column = width_of_column(width, smallest_letter, count);
    if (!column) break;
    const std::vector<HelpLine> broken = narrowed(lines, smallest_letter, *column);
    Arrangement a = arrange(broken, smallest_letter, cut_evenly(broken, count));
    if (fits(a)) return a;
  }
  return paged(lines, width, height, shown);
}

}  // namespace

Help make_help(const Page& page, const std::vector<HelpLine>& lines, std::size_t shown, const std::string& focus,
               osg::StateSet* plates) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  Help made{{group, {}, {}}};
  const Arrangement a = lines.empty() ? Arrangement{} : fit(page, lines, shown);
  if (a.columns.empty()) return made;
  made.page = a.page;
  made.pages = a.pages;
  const auto add_plate = [&](const Rectangle& where, float radius, const osg::Vec4& color) {
    const osg::ref_ptr<osg::Geometry> plate = make_plate(where, radius, color);
    plate->setStateSet(plates);
    group->addChild(plate);
  };
  const float left = std::round(0.5f * (page.width - a.width));
  const float middle = 0.5f * (bottom_of_help(page) + page.height - page.margin);
  const float top = std::round(middle + 0.5f * a.height);
  made.where = {left, top - a.height, a.width, a.height};
  add_plate(made.where, 0.6f * page.margin, help_panel_color);

  float x = left + 1.5f * a.gap;
  if (!a.footer.empty()) {
    const float y = made.where.y + a.gap + std::round(0.3f * a.line);
    const Rectangle row{x - 0.5f * a.gap, y - std::round(0.3f * a.line), a.width - 2 * a.gap, a.line};
    made.targets.push_back({row, Hud::help_more});
    if (focus == Hud::help_more) add_plate(row, 0.25f * a.line, focused_color);
    group->addChild(make_text(a.footer, {a.letter, true, heading_color}, std::round(x), y));
  }
  for (const Column& column : a.columns) {
    float y = top - a.gap - std::round(1.1f * static_cast<float>(a.letter));
    const float width = column.keys + a.gap + column.deeds;
    for (std::size_t i = column.first; i < column.last; ++i) {
      const HelpLine& line = a.lines[i];
      if (is_heading(line) && i > column.first) y -= std::round(heading_space * a.line);
      const Rectangle row{x - 0.5f * a.gap, y - std::round(0.3f * a.line), width + a.gap, a.line};
      if (!line.name.empty()) made.targets.push_back({row, line.name});
      if (!line.name.empty() && line.name == focus) add_plate(row, 0.25f * a.line, focused_color);
      group->addChild(
          make_text(line.key, {a.letter, true, is_heading(line) ? heading_color : key_color}, std::round(x), y));
      if (!is_heading(line)) {
        const float deed_x = std::round(x + column.keys + a.gap);
        group->addChild(make_text(line.effect, {a.letter, false, deed_color}, deed_x, y));
      }
      y -= a.line;
    }
    x += std::ceil(width) + columns_gap * a.gap;
  }
  return made;
}

}  // namespace roam::graphics
