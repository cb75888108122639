#pragma once
/// \file
/// Text on the picture: which font, how wide, where lines break.

#include <osg/Vec4>
#include <osg/ref_ptr>
#include <osgText/Text>
#include <string>
#include <vector>

namespace roam::graphics {

/// How a text is written. Two of one look share their glyphs.
struct Look {
  int size = 16;  ///< pixels, of an em
  bool bold = false;
  osg::Vec4 color{1, 1, 1, 1};
};

/// Loads the fonts, which make_text does else: for programs that let OpenSceneGraph read no file later.
void load_fonts();

/// A text in UTF-8 whose base line begins at (x, y), pixels, drawn in any threading model. In DejaVu Sans as fontconfig
/// finds it, else in the font that OpenSceneGraph brings.
[[nodiscard]] osg::ref_ptr<osgText::Text> make_text(const std::string& words, const Look& look, float x, float y);

/// Changes what is different only. To be called between frames.
void change_text(osgText::Text& text, const std::string& words, const osg::Vec4& color);

/// Pixels from the first letter's left to the last one's right.
[[nodiscard]] float width_of(const std::string& words, const Look& look);

/// The lines of `words`, broken at spaces where they would be wider than `width` pixels. A word that is wider itself
/// stays whole.
[[nodiscard]] std::vector<std::string> break_lines(const std::string& words, const Look& look, float width);

/// `words`, or as many of them as fit `width` pixels with "…" behind them.
[[nodiscard]] std::string shorten(const std::string& words, const Look& look, float width);

}  // namespace roam::graphics
