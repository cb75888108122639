#include "graphics/lettering.h"

#include <cairo-ft.h>
#include <cairo.h>
#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <osg/Image>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <sstream>
#include <string_view>
#include <utility>

#include "text/stream_of.h"

namespace roam::graphics {
namespace {

constexpr std::string_view ellipsis = "…";
/// Pixels. Smaller letters get slight hints only: full ones would move stems by a large part of a letter's width, so
/// that gaps within words look like gaps between them.
constexpr int least_full_size = 12;
/// Pixels around a text, for letters that reach beyond their own width.
constexpr int margin = 2;

template <auto free>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    free(object);
  }
};
using Face = std::unique_ptr<cairo_font_face_t, Freed<cairo_font_face_destroy>>;
using Font = std::unique_ptr<cairo_scaled_font_t, Freed<cairo_scaled_font_destroy>>;

/// DejaVu Sans, or fontconfig's replacement for it. Null if there is none.
Face find_face(bool bold, bool full) {
  const auto name = reinterpret_cast<const FcChar8*>(bold ? "DejaVu Sans:bold" : "DejaVu Sans:book");
  const std::unique_ptr<FcPattern, Freed<FcPatternDestroy>> wish(FcNameParse(name));
  FcConfigSubstitute(nullptr, wish.get(), FcMatchPattern);
  FcDefaultSubstitute(wish.get());
  FcResult result = FcResultMatch;
  const std::unique_ptr<FcPattern, Freed<FcPatternDestroy>> match(FcFontMatch(nullptr, wish.get(), &result));
  FcChar8* file = nullptr;
  if (!match || FcPatternGetString(match.get(), FC_FILE, 0, &file) != FcResultMatch) return nullptr;
  // FreeType's own hinter puts stems on whole pixels in both directions; the fonts' instructions do so in one.
  FcPatternDel(match.get(), FC_AUTOHINT);
  FcPatternAddBool(match.get(), FC_AUTOHINT, FcTrue);
  FcPatternDel(match.get(), FC_HINT_STYLE);
  FcPatternAddInteger(match.get(), FC_HINT_STYLE, full ? FC_HINT_FULL : FC_HINT_SLIGHT);
  Face face(cairo_ft_font_face_create_for_pattern(match.get()));
  return cairo_font_face_status(face.get()) == CAIRO_STATUS_SUCCESS ? std::move(face) : nullptr;
}

Font load_font(int size, bool bold) {
  const bool full = size >= least_full_size;
  Face face = find_face(bold, full);
  if (!face) {
    const auto weight = bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL;
    face.reset(cairo_toy_font_face_create("@cairo:", CAIRO_FONT_SLANT_NORMAL, weight));
  }
  const std::unique_ptr<cairo_font_options_t, Freed<cairo_font_options_destroy>> options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), full ? CAIRO_HINT_STYLE_FULL : CAIRO_HINT_STYLE_SLIGHT);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_ON);
  cairo_matrix_t scale, none;
  cairo_matrix_init_scale(&scale, size, size);
  cairo_matrix_init_identity(&none);
  return Font(cairo_scaled_font_create(face.get(), &scale, &none, options.get()));
}

/// The font of a style. Fonts are kept until the program ends.
cairo_scaled_font_t* font_for(const Look& look) {
  static std::mutex mutex;
  static std::map<std::pair<int, bool>, Font> fonts;
  const std::lock_guard lock(mutex);
  Font& font = fonts[{look.size, look.bold}];
  if (!font) font = load_font(look.size, look.bold);
  return font.get();
}

cairo_font_extents_t extents_of(const Look& look) {
  cairo_font_extents_t extents;
  cairo_scaled_font_extents(font_for(look), &extents);
  return extents;
}

/// Coverage of each pixel, from the lowest row, with `above` rows from the top to the first base line.
osg::ref_ptr<osg::Image> paint_lines(const std::vector<std::string>& lines, const Look& look, std::array<int, 2> size,
                                     int above, int line) {
  const auto [width, height] = size;
  const std::unique_ptr<cairo_surface_t, Freed<cairo_surface_destroy>> surface(
      cairo_image_surface_create(CAIRO_FORMAT_A8, width, height));
  const std::unique_ptr<cairo_t, Freed<cairo_destroy>> pen(cairo_create(surface.get()));
  cairo_set_scaled_font(pen.get(), font_for(look));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    cairo_move_to(pen.get(), margin, above + line * static_cast<int>(i));
    cairo_show_text(pen.get(), lines[i].c_str());
  }
  cairo_surface_flush(surface.get());
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(width, height, 1, GL_ALPHA, GL_UNSIGNED_BYTE, 1);
  const unsigned char* const rows = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < height; ++y) {
    const unsigned char* const row = rows + static_cast<std::ptrdiff_t>(height - 1 - y) * stride;
    std::copy(row, row + width, image->data(0, static_cast<unsigned>(y)));
  }
  return image;
}

}  // namespace

void load_fonts() {
  for (const bool bold : {false, true}) static_cast<void>(width_of("0", {.bold = bold}));
}

Text::Text(const std::string& words, const Look& look, float x, float y)
    : words_(words), look_(look), x_(std::round(x)), y_(std::round(y)) {
  setDataVariance(osg::Object::DYNAMIC);
  setUseDisplayList(false);
  setUseVertexBufferObjects(true);
  setCullingActive(false);
  setVertexArray(new osg::Vec3Array(4));
  const osg::ref_ptr<osg::Vec2Array> texels = new osg::Vec2Array;
  for (const auto& [s, t] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}}) {
    texels->push_back(osg::Vec2(static_cast<float>(s), static_cast<float>(t)));
  }
  setTexCoordArray(0, texels);
  setColorArray(new osg::Vec4Array(1, &look_.color), osg::Array::BIND_OVERALL);
  getOrCreateStateSet()->setDataVariance(osg::Object::DYNAMIC);
  paint();
}

void Text::set(const std::string& words, const osg::Vec4& color) {
  if (color != look_.color) {
    look_.color = color;
    setColorArray(new osg::Vec4Array(1, &color), osg::Array::BIND_OVERALL);
  }
  if (words == words_) return;
  words_ = words;
  paint();
}

void Text::set_place(float x, float y) {
  const osg::Vec3 by(std::round(x) - x_, std::round(y) - y_, 0);
  if (by == osg::Vec3()) return;
  x_ += by.x();
  y_ += by.y();
  auto& corners = static_cast<osg::Vec3Array&>(*getVertexArray());
  for (osg::Vec3& corner : corners) corner += by;
  corners.dirty();
}

void Text::paint() {
  const std::vector<std::string> lines = parts_of(words_, '\n');
  width_ = 0;
  for (const std::string& line : lines) width_ = std::max(width_, width_of(line, look_));
  removePrimitiveSet(0, getNumPrimitiveSets());
  if (width_ <= 0) return;
  const cairo_font_extents_t font = extents_of(look_);
  const int line = static_cast<int>(std::lround(look_.line > 0 ? look_.line : static_cast<float>(font.height)));
  const int above = static_cast<int>(std::ceil(font.ascent)) + margin;
  const int below = static_cast<int>(std::ceil(font.descent)) + margin + line * static_cast<int>(lines.size() - 1);
  const int width = static_cast<int>(std::ceil(width_)) + 2 * margin, height = above + below;

  // A new texture, because another thread may be drawing the old one.
  const osg::ref_ptr<osg::Texture2D> texture =
      new osg::Texture2D(paint_lines(lines, look_, {width, height}, above, line));
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
  texture->setResizeNonPowerOfTwoHint(false);
  getStateSet()->setTextureAttributeAndModes(0, texture);
  const float left = x_ - margin, bottom = y_ - static_cast<float>(below);
  auto& corners = static_cast<osg::Vec3Array&>(*getVertexArray());
  for (unsigned i = 0; i < 4; ++i) {
    corners[i].set(left + (i & 1 ? static_cast<float>(width) : 0.0f), bottom + (i & 2 ? static_cast<float>(height) : 0),
                   0);
  }
  corners.dirty();
  addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4));
}

osg::ref_ptr<Text> make_text(const std::string& words, const Look& look, float x, float y) {
  return new Text(words, look, x, y);
}

float width_of(const std::string& words, const Look& look) {
  if (words.find_first_not_of(' ') == std::string::npos) return 0;
  cairo_text_extents_t extents;
  cairo_scaled_font_text_extents(font_for(look), words.c_str(), &extents);
  return static_cast<float>(extents.x_bearing + extents.width);
}

namespace {

/// Whether `word` is the unit of a number at the end of `line`, such as "m" or "km/h,".
bool is_unit(const std::string& word, const std::string& line) {
  constexpr std::size_t longest = 5;
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  return word.size() <= longest && std::isalpha(static_cast<unsigned char>(word.front())) != 0 && is_digit(line.back());
}

}  // namespace

std::vector<std::string> break_lines(const std::string& words, const Look& look, float width) {
  std::vector<std::string> lines;
  for (const std::string& paragraph : parts_of(words, '\n')) {
    std::istringstream stream = stream_of(paragraph);
    std::string line;
    for (std::string word; stream >> word;) {
      const std::string longer = line.empty() ? word : line + " " + word;
      if (!line.empty() && width_of(longer, look) > width) {
        std::size_t rest = is_unit(word, line) ? line.rfind(' ') : std::string::npos;
        if (rest != std::string::npos && width_of(longer.substr(rest + 1), look) > width) rest = std::string::npos;
        lines.push_back(line.substr(0, rest));
        line = rest == std::string::npos ? word : longer.substr(rest + 1);
      } else {
        line = longer;
      }
    }
    lines.push_back(line);
  }
  return lines;
}

namespace {

/// Where each UTF-8 character of a text begins, and where the last one ends.
std::vector<std::size_t> characters_of(const std::string& words) {
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if ((static_cast<unsigned char>(words[i]) & 0xC0) != 0x80) begins.push_back(i);
  }
  begins.push_back(words.size());
  return begins;
}

/// `words`, or as many characters as fit into `width` pixels: all from the beginning but a share `tail` from the end.
std::string cut(const std::string& words, const Look& look, float width, double tail) {
  if (width_of(words, look) <= width) return words;
  const std::vector<std::size_t> begins = characters_of(words);
  const std::size_t all = begins.size() - 1;
  std::string kept(ellipsis);
  for (std::size_t count = all; count-- > 0;) {
    const auto last = static_cast<std::size_t>(tail * static_cast<double>(count));
    kept = words.substr(0, begins[count - last]).append(ellipsis).append(words, begins[all - last]);
    if (width_of(kept, look) <= width) break;
  }
  return kept;
}

}  // namespace

std::string shorten(const std::string& words, const Look& look, float width) { return cut(words, look, width, 0.0); }

std::string shorten_name(const std::string& name, const Look& look, float width) { return cut(name, look, width, 0.5); }

}  // namespace roam::graphics
