// The looks of smooth, metallic and shining surfaces.

#include <osg/Texture2D>

#include "graphics/sun.h"
#include "graphics_stage.h"

namespace roam::test {
namespace {

using graphics::FrameSettings;
using graphics::Gloss;

const Gloss smooth{.roughness = 0.25f}, rough{.roughness = 0.9375f}, gold{.roughness = 0.25f, .metalness = 1.0f};
const osg::Vec3d sun_at(graphics::sun_direction().x, graphics::sun_direction().y, graphics::sun_direction().z);

osg::ref_ptr<osg::Texture2D> image_of(GLenum format, std::initializer_list<unsigned char> texels, int width) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(width, 1, 1, format, GL_UNSIGNED_BYTE, 1);
  std::copy(texels.begin(), texels.end(), image->data());
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  return texture;
}

/// A slanted board, seen from where it mirrors the sun, in its middle, to the eye.
struct Board {
  explicit Board(const graphics::Surface& surface, const FrameSettings& settings = with_full)
      : stage(96, 96, settings) {
    stage.frame.set_edges(false);
    osg::Vec3d normal(-0.3, 0.25, 0.9);
    normal.normalize();
    across = normal ^ y_axis;
    across.normalize();
    paint(board, {0.8f, 0.3f, 0.1f, 1.0f});
    osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
    for (const auto& [s, t] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
      places->push_back(osg::Vec2(static_cast<float>(s), static_cast<float>(t)));
    }
    board->setTexCoordArray(0, places);
    board->setVertexArray(quad({}, across * 9, (normal ^ across) * 9)->getVertexArray());
    graphics::apply(surface, *board->getOrCreateStateSet());
    stage.add(board);
    sun.emplace(stage.frame, *stage.scene);
    stage.look((normal * (2.0 * (normal * sun_at)) - sun_at) * 6.0, {});
  }

  [[nodiscard]] Pixel middle() { return at(*stage.picture(), 48, 48); }
  /// The brightness of the middle minus that beside it.
  [[nodiscard]] int highlight() {
    const auto picture = stage.picture();
    return at(*picture, 48, 48).sum() - at(*picture, 4, 48).sum();
  }

  Stage stage;
  osg::Vec3d across;
  osg::ref_ptr<osg::Geometry> board = quad({}, x_axis, y_axis);
  std::optional<graphics::Sun> sun;
};

Pixel middle_of(const std::optional<Gloss>& gloss) { return Board({.gloss = gloss}).middle(); }

TEST(GraphicsGloss, TheSunGlintsWhereASmoothSurfaceMirrorsItAndNotOnARoughOne) {
  EXPECT_GT(Board({.gloss = smooth}).highlight(), 100);
  EXPECT_LT(std::abs(Board({.gloss = rough}).highlight()), 15);
  EXPECT_LT(std::abs(Board({}).highlight()), 15);
}

TEST(GraphicsGloss, AMetalTintsWhatItMirrorsAndVarnishDoesNot) {
  const Pixel dull = middle_of(std::nullopt), metal = middle_of(gold), varnish = middle_of(smooth);
  EXPECT_GT(metal.sum(), dull.sum() + 60);
  EXPECT_GT(metal.r, 2 * metal.b) << metal;
  EXPECT_GT(varnish.b, dull.b + 40) << varnish;
}

TEST(GraphicsGloss, TheRoughestSurfacesLookAsWithoutGlossWhetherMetalOrNot) {
  const Pixel dull = middle_of(std::nullopt);
  EXPECT_LT(middle_of(Gloss{1.0f, 1.0f}).distance(dull), 9);
  EXPECT_LT(middle_of(Gloss{1.0f, 0.0f}).distance(dull), 30);
}

TEST(GraphicsGloss, NoSunGlintsInTheShadow) {
  Board board({.gloss = smooth});
  board.stage.add(quad(sun_at * 20, x_axis * 12, y_axis * 12));
  EXPECT_LT(std::abs(board.highlight()), 15);
}

TEST(GraphicsGloss, OnlyFullPicturesMirror) {
  for (const FrameSettings& settings : {plain, with_light}) {
    Board with({.gloss = gold}, settings), without({}, settings);
    EXPECT_EQ(differing(*with.stage.picture(), *without.stage.picture()), 0);
  }
}

TEST(GraphicsGloss, SurfacesMirrorWithoutShadowsToo) {
  Board board({.gloss = smooth});
  board.sun->set_shadows(false);
  EXPECT_GT(board.highlight(), 100);
  Board matt({});
  for (Board* one : {&board, &matt}) one->sun.reset();
  EXPECT_EQ(differing(*board.stage.picture(), *matt.stage.picture()), 0);
}

TEST(GraphicsGloss, UnderARoofTheLampGlintsAndMetalIsNotBlack) {
  for (const Gloss& gloss : {gold, smooth}) {
    Stage stage(96, 96, with_full);
    osg::ref_ptr<osg::Geometry> wall = quad({0, 2, 0}, x_axis * 9, z_axis * 9);
    graphics::apply({.gloss = gloss}, *wall->getOrCreateStateSet());
    stage.add(wall);
    graphics::Sun sun(stage.frame, *stage.scene);
    sun.set_outdoors(0.0);
    const auto picture = stage.picture();
    EXPECT_GT(at(*picture, 48, 48).sum(), at(*picture, 4, 48).sum() + 8);
    for (const int y : {4, 48, 92}) EXPECT_GT(at(*picture, 4, y).sum(), 3 * 90) << gloss.metalness;
  }
}

TEST(GraphicsGloss, AnImageSaysWhereASurfaceIsSmooth) {
  Board board({.gloss = Gloss{1.0f, 1.0f, true}});
  board.board->getOrCreateStateSet()->setTextureAttribute(graphics::gloss_unit,
                                                          image_of(GL_LUMINANCE_ALPHA, {255, 0, 51, 255}, 2));
  const auto picture = board.stage.picture();
  const Pixel here = at(*picture, 42, 48), there = at(*picture, 54, 48);
  EXPECT_GT(std::abs(here.sum() - there.sum()), 60) << here << there;
}

TEST(GraphicsGloss, SurfacesShineByThemselvesInEveryQuality) {
  for (const FrameSettings& settings : {plain, with_light, with_full}) {
    Stage stage(64, 64, settings);
    osg::ref_ptr<osg::Geometry> lamp = paint(quad({0, 4, 0}, x_axis * 9, z_axis * 9), {0, 0, 0, 1});
    graphics::apply({.emission = graphics::Emission{{0.5f, 0.25f, 0.0f}}}, *lamp->getOrCreateStateSet());
    stage.add(lamp);
    EXPECT_LT(at(*stage.picture(), 32, 32).distance({128, 64, 0}), 4);
    graphics::apply({.emission = graphics::Emission{{0.5f, 0.25f, 0.0f}, true}}, *lamp->getOrCreateStateSet());
    lamp->getOrCreateStateSet()->setTextureAttribute(graphics::emission_unit, image_of(GL_RGB, {255, 0, 255}, 1));
    lamp->setTexCoordArray(0, new osg::Vec2Array(4));
    EXPECT_LT(at(*stage.picture(), 32, 32).distance({128, 0, 0}), 4);
  }
}

}  // namespace
}  // namespace roam::test
