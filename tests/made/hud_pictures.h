#pragma once
/// \file
/// Pictures of the head-up display: the part that it changes, backgrounds, contrasts.

#include <algorithm>
#include <cmath>
#include <osg/Texture2D>
#include <string>
#include <vector>

#include "graphics/hud.h"
#include "graphics_stage.h"

namespace roam::test {

using graphics::Hud;

struct Region {
  int left = 0, bottom = 0, right = 0, top = 0;  // right and top: one beyond
  int pixels = 0;
};

/// The smallest rectangle of all pixels that the display changes.
inline Region changed(const osg::Image& without, const osg::Image& with) {
  Region r{without.s(), without.t(), 0, 0, 0};
  for (int y = 0; y < without.t(); ++y) {
    for (int x = 0; x < without.s(); ++x) {
      if (at(without, x, y).distance(at(with, x, y)) < 6) continue;
      r.left = std::min(r.left, x);
      r.right = std::max(r.right, x + 1);
      r.bottom = std::min(r.bottom, y);
      r.top = std::max(r.top, y + 1);
      ++r.pixels;
    }
  }
  return r;
}

inline Region shown_in(Stage& stage) {
  const auto without = stage.picture(false);
  return changed(*without, *stage.picture(true));
}

/// A wall of the photogrammetric kind, which is drawn as it is: one grey all over the picture.
inline void fill_with(Stage& stage, unsigned char level) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  std::fill_n(image->data(), 3, level);
  osg::ref_ptr<osg::Geometry> wall = quad({0, 1, 0}, {9, 0, 0}, {0, 0, 9});
  wall->setTexCoordArray(0, new osg::Vec2Array(4));
  const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
  wall->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
  stage.add(wall);
}

/// Relative luminance, as the Web Content Accessibility Guidelines 2 define it.
inline double luminance(const Pixel& p) {
  const auto linear = [](int level) {
    const double c = level / 255.0;
    return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(p.r) + 0.7152 * linear(p.g) + 0.0722 * linear(p.b);
}

/// More lines than a small window has room for.
inline const std::vector<graphics::HelpLine> many_keys = [] {
  std::vector<graphics::HelpLine> keys;
  for (int section = 0; section < 4; ++section) {
    keys.push_back({"Section " + std::to_string(section), ""});
    for (int i = 0; i < 9; ++i) keys.push_back({"Shift+Ctrl+" + std::to_string(i), "what this key does, said shortly"});
  }
  return keys;
}();

}  // namespace roam::test
