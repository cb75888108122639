#pragma once
/// \file
/// Text on the picture: font, width, line breaks.

#include <osg/Vec4>
#include <osg/ref_ptr>
#include <osgText/Text>
#include <string>
#include <vector>

namespace roam::graphics {

/// The style of a text. Texts of one style share their glyphs.
struct Look {
  int size = 16;  ///< height of an em, pixels
  bool bold = false;
  osg::Vec4 color{1, 1, 1, 1};
};

/// Loads the fonts, as make_text would do later. For programs in which OpenSceneGraph may read no file later.
void load_fonts();

/// A text in UTF-8 whose baseline begins at (x, y), pixels, for any threading model. The font is DejaVu Sans as
/// fontconfig finds it, else OpenSceneGraph's own.
[[nodiscard]] osg::ref_ptr<osgText::Text> make_text(const std::string& words, const Look& look, float x, float y);

/// Updates only what differs. Call it between frames.
void change_text(osgText::Text& text, const std::string& words, const osg::Vec4& color);

/// Pixels from the left edge of the first letter to the right edge of the last.
[[nodiscard]] float width_of(const std::string& words, const Look& look);

/// Breaks `words` at spaces into lines of at most `width` pixels. A word that is wider stays whole.
[[nodiscard]] std::vector<std::string> break_lines(const std::string& words, const Look& look, float width);

/// `words` if they fit into `width` pixels, else their beginning with "…".
[[nodiscard]] std::string shorten(const std::string& words, const Look& look, float width);

}  // namespace roam::graphics
