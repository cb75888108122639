#include "graphics/lettering.h"

#include <fontconfig/fontconfig.h>

#include <memory>
#include <osgText/Font>
#include <sstream>
#include <string_view>

namespace roam::graphics {
namespace {

/// The file of DejaVu Sans, or of fontconfig's replacement for it; empty if there is none.
std::string find_font(bool bold) {
  const std::unique_ptr<FcConfig, void (*)(FcConfig*)> fonts(FcInitLoadConfigAndFonts(), FcConfigDestroy);
  if (!fonts) return {};
  const std::unique_ptr<FcPattern, void (*)(FcPattern*)> wish(
      FcNameParse(reinterpret_cast<const FcChar8*>(bold ? "DejaVu Sans:bold" : "DejaVu Sans:book")), FcPatternDestroy);
  FcConfigSubstitute(fonts.get(), wish.get(), FcMatchPattern);
  FcDefaultSubstitute(wish.get());
  FcResult result = FcResultMatch;
  const std::unique_ptr<FcPattern, void (*)(FcPattern*)> match(FcFontMatch(fonts.get(), wish.get(), &result),
                                                               FcPatternDestroy);
  FcChar8* file = nullptr;
  if (!match || FcPatternGetString(match.get(), FC_FILE, 0, &file) != FcResultMatch) return {};
  return reinterpret_cast<const char*>(file);
}

osg::ref_ptr<osgText::Font> load_font(bool bold) {
  const std::string file = find_font(bold);
  osg::ref_ptr<osgText::Font> font = file.empty() ? nullptr : osgText::readRefFontFile(file);
  return font ? font : osgText::Font::getDefaultFont();
}

osgText::Font* font_for(bool bold) {
  // Never freed: at the end of the program their textures would outlive OpenSceneGraph's texture manager.
  static const auto& regular = *new osg::ref_ptr<osgText::Font>(load_font(false));
  static const auto& heavy = *new osg::ref_ptr<osgText::Font>(load_font(true));
  return bold ? heavy.get() : regular.get();
}

constexpr std::string_view ellipsis = "…";

}  // namespace

void load_fonts() { static_cast<void>(font_for(false)); }

osg::ref_ptr<osgText::Text> make_text(const std::string& words, const Look& look, float x, float y) {
  osg::ref_ptr<osgText::Text> text = new osgText::Text;
  text->setDataVariance(osg::Object::DYNAMIC);
  // Shaders of the other techniques need GLSL 1.30 and do not compile everywhere.
  text->setShaderTechnique(osgText::GREYSCALE);
  text->setFont(font_for(look.bold));
  // Two texels a pixel. One would be sharper on whole pixels, but OpenSceneGraph does not align letters to them.
  text->setFontResolution(2 * static_cast<unsigned>(look.size), 2 * static_cast<unsigned>(look.size));
  text->setCharacterSize(static_cast<float>(look.size));
  text->setAlignment(osgText::Text::LEFT_BASE_LINE);
  text->setPosition(osg::Vec3(x, y, 0));
  text->setColor(look.color);
  text->setText(words, osgText::String::ENCODING_UTF8);
  text->setCullingActive(false);
  return text;
}

void change_text(osgText::Text& text, const std::string& words, const osg::Vec4& color) {
  if (text.getColor() != color) text.setColor(color);
  if (text.getText() != osgText::String(words, osgText::String::ENCODING_UTF8)) {
    text.setText(words, osgText::String::ENCODING_UTF8);
  }
}

float width_of(const std::string& words, const Look& look) {
  if (words.find_first_not_of(' ') == std::string::npos) return 0;
  const osg::BoundingBox box = make_text(words, look, 0, 0)->getBoundingBox();
  return box.valid() ? box.xMax() : 0;
}

std::vector<std::string> break_lines(const std::string& words, const Look& look, float width) {
  std::vector<std::string> lines;
  std::istringstream paragraphs(words);
  for (std::string paragraph; std::getline(paragraphs, paragraph);) {
    std::istringstream stream(paragraph);
    std::string line;
    for (std::string word; stream >> word;) {
      const std::string longer = line.empty() ? word : line + " " + word;
      if (!line.empty() && width_of(longer, look) > width) {
        lines.push_back(line);
        line = word;
      } else {
        line = longer;
      }
    }
    lines.push_back(line);
  }
  return lines;
}

std::string shorten(const std::string& words, const Look& look, float width) {
  if (width_of(words, look) <= width) return words;
  std::string kept = words;
  do {
    // Remove one whole UTF-8 character.
    while (!kept.empty() && (static_cast<unsigned char>(kept.back()) & 0xC0) == 0x80) kept.pop_back();
    if (!kept.empty()) kept.pop_back();
  } while (!kept.empty() && width_of(kept + std::string(ellipsis), look) > width);
  return kept + std::string(ellipsis);
}

}  // namespace roam::graphics
