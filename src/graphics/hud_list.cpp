#include <algorithm>
#include <cmath>

#include "graphics/hud_panels.h"

namespace roam::graphics {
namespace {

const osg::Vec4 list_panel_color(0.04f, 0.05f, 0.065f, 0.87f);
const osg::Vec4 field_color(0.96f, 0.97f, 0.98f, 0.14f);
const osg::Vec4 focus_color(0.30f, 0.45f, 0.62f, 0.95f);
const osg::Vec4 title_color(0.52f, 0.80f, 1.0f, 1.0f);
const osg::Vec4 row_color(0.95f, 0.96f, 0.97f, 1.0f);
const osg::Vec4 faint_color(0.72f, 0.79f, 0.86f, 1.0f);

/// The places of the list's parts, in pixels.
struct Places {
  explicit Places(const Page& page) {
    const auto letter = static_cast<float>(page.letter);
    pad = std::round(0.6f * page.margin);
    const float width = std::round(std::min(0.46f * page.width, 26.0f * letter));
    // A line below the upper edge stays free for the mark of a recording.
    const float top = page.height - 2.0f * page.margin - 2.0f * page.line;
    panel = {page.width - page.margin - width, page.margin, width, std::max(0.0f, top - page.margin)};
    first = top - pad - 2.2f * page.line;  // the upper edge of the first row
    rows = static_cast<std::size_t>(std::max(0.0f, (first - panel.y - pad) / page.line));
  }
  Rectangle panel;
  float pad = 0, first = 0;
  std::size_t rows = 0;
};

}  // namespace

std::size_t rows_of_list(const Page& page) { return Places(page).rows; }

float left_of_list(const Page& page) { return Places(page).panel.x - std::round(0.4f * page.margin); }

Clickable make_list(const Page& page, const HudList& list, const std::string& focus, osg::StateSet* plates) {
  const Places places(page);
  osg::ref_ptr<osg::Group> group = new osg::Group;
  Clickable made{group, {}, places.panel};
  const Look title_look{page.letter, true, title_color}, look{page.letter, false, row_color},
      faint{page.letter, false, faint_color};
  const auto add_plate = [&](const Rectangle& where, float radius, const osg::Vec4& color) {
    const osg::ref_ptr<osg::Geometry> plate = make_plate(where, radius, color);
    plate->setStateSet(plates);
    group->addChild(plate);
  };
  const float left = places.panel.x + places.pad, right = places.panel.x + places.panel.width - places.pad;
  const float letter = static_cast<float>(page.letter), rise = std::round(0.3f * page.line);
  add_plate(places.panel, 0.5f * page.margin, list_panel_color);
  float y = places.panel.y + places.panel.height - places.pad - page.line;  // the lower edge of the line
  group->addChild(make_text(shorten(list.title, title_look, right - left), title_look, left, y + rise));
  y = std::round(y - 1.1f * page.line);
  const Rectangle field{left, y, right - left, page.line};
  add_plate(field, 0.25f * page.line, field_color);
  group->addChild(
      make_text(shorten(list.search, faint, field.width - 2 * places.pad), faint, left + places.pad, y + rise));
  made.targets.push_back({field, Hud::list_search});

  y = std::round(places.first);
  for (std::size_t i = 0; i < std::min(list.rows.size(), places.rows); ++i) {
    const ListRow& row = list.rows[i];
    y -= page.line;
    float x = left + std::round(0.9f * letter * static_cast<float>(row.depth));
    const Rectangle whole{left, y, right - left, page.line};
    if (!row.name.empty() && row.name == focus) add_plate(whole, 0.25f * page.line, focus_color);
    if (!row.opens.empty()) {
      made.targets.push_back({{left, y, x + std::round(1.2f * letter) - left, page.line}, row.opens});
      group->addChild(make_text(row.is_open ? "\u25be" : "\u25b8", faint, x, y + rise));
    }
    x += std::round(1.2f * letter);
    if (row.box != ListRow::Box::none) {
      const float side = std::round(0.8f * letter), bottom = y + std::round(0.5f * (page.line - side));
      add_plate({x, bottom, side, side}, 0.2f * side, faint_color);
      const float inner = side - 2.0f, mark = row.box == ListRow::Box::off ? inner : std::round(0.5f * inner);
      if (row.box != ListRow::Box::on) {
        add_plate({x + 1.0f, bottom + side - 1.0f - mark, inner, mark}, 0.15f * side, list_panel_color);
      }
      x += side + std::round(0.5f * letter);
    }
    const auto& cut = row.ends_with_ellipsis ? shorten : shorten_name;
    group->addChild(make_text(cut(row.text, look, right - x), look, x, y + rise));
    if (!row.name.empty()) made.targets.push_back({whole, row.name});
  }
  return made;
}

}  // namespace roam::graphics
