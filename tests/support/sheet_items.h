#pragma once
/// \file
/// The items of a sheet, for tests by facts.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "draw/sheet.h"

namespace sheets {

/// The items of a kind whose name is, or ends with, the words `what`; an empty one takes all.
template <class Item>
std::vector<Item> all(const roam::draw::Sheet& sheet, const std::string& what = {}) {
  std::vector<Item> found;
  for (const auto& item : sheet.items) {
    const Item* one = std::get_if<Item>(&item);
    if (one != nullptr && (what.empty() || (" " + one->what).ends_with(" " + what))) found.push_back(*one);
  }
  return found;
}

/// All points of some lines.
inline roam::draw::Rect box(const roam::draw::Lines& lines) {
  roam::draw::Rect box;
  for (const roam::draw::Polyline& line : lines.lines) {
    for (const roam::draw::Point& p : line) box.include(p);
  }
  return box;
}

/// Fails for texts that leave the sheet, or cover each other by more than twice `slack` pixels.
inline void expect_readable(const roam::draw::Sheet& sheet, double slack = 0.0) {
  const roam::draw::Rect paper{{0.0, 0.0}, {sheet.width, sheet.height}};
  const auto texts = all<roam::draw::Text>(sheet);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_TRUE(paper.contains(texts[i].box)) << texts[i].what << ": " << texts[i].text;
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(texts[i].box.grown(-slack).overlaps(texts[k].box.grown(-slack)))
          << texts[i].what << ": " << texts[i].text << "\n over " << texts[k].what << ": " << texts[k].text;
    }
  }
}

}  // namespace sheets
