#pragma once
/// \file
/// Text on the picture: font, width, line breaks.
///
/// A text is a picture of its own, drawn by Cairo with one texel for each pixel. Letters are hinted and stand on whole
/// pixels, so that stems are sharp and no letter touches another's texels.

#include <osg/Geometry>
#include <osg/Vec4>
#include <osg/ref_ptr>
#include <string>
#include <vector>

namespace roam::graphics {

/// The style of a text.
struct Look {
  int size = 16;  ///< height of an em, pixels
  bool bold = false;
  osg::Vec4 color{1, 1, 1, 1};
  float line = 0;  ///< pixels from one base line to the next; 0: as the font says
  bool operator==(const Look&) const = default;
};

/// A text in UTF-8, perhaps of several lines, for any threading model. Call all members between frames. The font is
/// DejaVu Sans as fontconfig finds it, else its replacement, else Cairo's own.
class Text : public osg::Geometry {
 public:
  Text(const std::string& words, const Look& look, float x, float y);

  /// Updates only what differs.
  void set(const std::string& words, const osg::Vec4& color);
  /// The beginning of the first base line, pixels; rounded to whole ones.
  void set_place(float x, float y);
  /// Pixels from the beginning of the base line to the right edge of the widest line.
  [[nodiscard]] float width() const { return width_; }

 private:
  void paint();

  std::string words_;
  Look look_;
  float x_ = 0, y_ = 0;
  float width_ = 0;
};

/// Loads the fonts, as the first text would do later. For programs that may open no file later.
void load_fonts();

[[nodiscard]] osg::ref_ptr<Text> make_text(const std::string& words, const Look& look, float x, float y);

/// Pixels from the beginning of the base line to the right edge of the last letter.
[[nodiscard]] float width_of(const std::string& words, const Look& look);

/// Breaks `words` at spaces into lines of at most `width` pixels. A word that is wider stays whole; a unit stays with
/// its number.
[[nodiscard]] std::vector<std::string> break_lines(const std::string& words, const Look& look, float width);

/// `words` if they fit into `width` pixels, else their beginning with "…".
[[nodiscard]] std::string shorten(const std::string& words, const Look& look, float width);

/// The same with "…" in the middle, because names of like things often differ at their ends alone.
[[nodiscard]] std::string shorten_name(const std::string& name, const Look& look, float width);

}  // namespace roam::graphics
