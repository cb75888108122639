// How surfaces look.

#include <osg/Texture2D>

#include "graphics_stage.h"

namespace roam::test {
namespace {

/// The middle of a picture of `geometry` alone.
Pixel middle_of(const osg::ref_ptr<osg::Node>& node) {
  Stage stage(64, 64);
  stage.add(node);
  return at(*stage.picture(), 32, 32);
}

osg::ref_ptr<osg::Geometry> wall() { return quad({0, 4, 0}, x_axis * 9, z_axis * 9); }

osg::ref_ptr<osg::Geometry> with_normals(osg::ref_ptr<osg::Geometry> geometry, const osg::Vec3& normal) {
  osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(4);
  for (osg::Vec3& n : *normals) n = normal;
  geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
  return geometry;
}

/// A picture of four texels: red, green below, blue, white above.
osg::ref_ptr<osg::Texture2D> texture() {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(2, 2, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  const unsigned char texels[] = {200, 0, 0, 0, 200, 0, 0, 0, 200, 200, 200, 200};
  std::copy(std::begin(texels), std::end(texels), image->data());
  osg::ref_ptr<osg::Texture2D> made = new osg::Texture2D(image);
  made->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  made->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  return made;
}

osg::ref_ptr<osg::Geometry> textured(osg::ref_ptr<osg::Geometry> geometry) {
  osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
  for (const auto& [s, t] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
    places->push_back(osg::Vec2(static_cast<float>(s), static_cast<float>(t)));
  }
  geometry->setTexCoordArray(0, places);
  geometry->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture());
  return geometry;
}

TEST(GraphicsShading, WhiteCorridorWallsAreNeitherBlackNorAlike) {
  Stage stage(320, 180);
  // 3 m wide and high, 60 m long, closed at its end; the eye looks along it.
  stage.add(quad({-1.5, 28, 0}, y_axis * 30, z_axis * 1.5));
  stage.add(quad({1.5, 28, 0}, y_axis * 30, z_axis * 1.5));
  stage.add(quad({0, 28, -1.5}, x_axis * 1.5, y_axis * 30));
  stage.add(quad({0, 28, 1.5}, x_axis * 1.5, y_axis * 30));
  stage.add(quad({0, 58, 0}, x_axis * 1.5, z_axis * 1.5));
  const auto picture = stage.picture();
  const Pixel left = at(*picture, 60, 90), right = at(*picture, 260, 90), floor = at(*picture, 160, 20),
              ceiling = at(*picture, 160, 160), end = at(*picture, 160, 90);
  const Pixel all[] = {left, right, floor, ceiling, end};
  for (const Pixel& p : all) {
    EXPECT_GT(p.sum(), 3 * 70) << p;
    EXPECT_LT(p.sum(), 3 * 250) << p;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT(all[i].distance(all[k]), 3 * 9) << all[i] << all[k];
  }
  EXPECT_GT(floor.sum(), left.sum());
  EXPECT_GT(left.sum(), ceiling.sum());
}

TEST(GraphicsShading, BackFacesAreSeenAsFrontFacesAre) {
  const Pixel front = middle_of(quad({0, 4, 0}, x_axis * 9, z_axis * 9));
  const Pixel back = middle_of(quad({0, 4, 0}, x_axis * 9, z_axis * -9));
  EXPECT_EQ(front, back);
  EXPECT_EQ(middle_of(with_normals(wall(), {0, -1, 0})), middle_of(with_normals(wall(), {0, 1, 0})));
}

TEST(GraphicsShading, OfAWallThatIsThereTwiceTheSideThatFacesTheEyeIsSeen) {
  for (const bool front_first : {true, false}) {
    Stage stage;
    const osg::Vec3d along(0.9, 0.4, 0);
    // Turned by half a turn, so that the two are cut into triangles along different lines.
    osg::ref_ptr<osg::Geometry> front = paint(quad({0, 30, 0}, along * 60, z_axis * 20), {1, 0, 0, 1});
    osg::ref_ptr<osg::Geometry> back = paint(quad({0, 30, 0}, along * -60, z_axis * 20), {0, 0, 1, 1});
    with_normals(front, {0.406f, -0.914f, 0});
    with_normals(back, {-0.406f, 0.914f, 0});
    stage.add(front_first ? front : back);
    stage.add(front_first ? back : front);
    const auto picture = stage.picture();
    int blue = 0, red = 0;
    for (int y = 0; y < 180; ++y) {
      for (int x = 0; x < 320; ++x) {
        blue += at(*picture, x, y).b > 40 && at(*picture, x, y).r == 0;
        red += at(*picture, x, y).r > 40 && at(*picture, x, y).b == 0;
      }
    }
    EXPECT_EQ(blue, 0);
    EXPECT_GT(red, 10'000);
  }
}

TEST(GraphicsShading, NormalsOfTheGeometryAreUsedAndElseThoseOfItsFaces) {
  EXPECT_LT(middle_of(with_normals(wall(), {0, -1, 0})).distance(middle_of(wall())), 4);
  EXPECT_GT(middle_of(with_normals(wall(), {0, 0, 1})).distance(middle_of(wall())), 20);
}

TEST(GraphicsShading, VertexColoursAreKept) {
  osg::ref_ptr<osg::Geometry> geometry = wall();
  osg::ref_ptr<osg::Vec4ubArray> colors = new osg::Vec4ubArray(4);
  for (osg::Vec4ub& c : *colors) c.set(0, 255, 0, 255);
  colors->setNormalize(true);
  geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
  const Pixel p = middle_of(geometry);
  EXPECT_GT(p.g, 120);
  EXPECT_EQ(p.r, 0);
  EXPECT_EQ(p.b, 0);
}

TEST(GraphicsShading, PhotogrammetryIsShownAsItsPictureIs) {
  Stage stage(64, 64);
  stage.add(textured(quad({0, 4, 0}, x_axis * 2, z_axis * 2)));
  const auto picture = stage.picture();
  EXPECT_EQ(at(*picture, 24, 24), (Pixel{200, 0, 0}));
  EXPECT_EQ(at(*picture, 40, 24), (Pixel{0, 200, 0}));
  EXPECT_EQ(at(*picture, 24, 40), (Pixel{0, 0, 200}));
  EXPECT_EQ(at(*picture, 40, 40), (Pixel{200, 200, 200}));
}

TEST(GraphicsShading, ATextureOnGeometryWithNormalsIsLit) {
  Stage stage(64, 64);
  stage.add(with_normals(textured(quad({0, 4, 0}, x_axis * 2, z_axis * 2)), {0, -1, 0}));
  const Pixel red = at(*stage.picture(), 24, 24);
  EXPECT_GT(red.r, 80);
  EXPECT_LT(red.r, 195);
  EXPECT_EQ(red.g, 0);
}

TEST(GraphicsShading, WhatIsTransparentIsBlendedOverWhatLiesBehind) {
  Stage stage(64, 64);
  osg::ref_ptr<osg::Geometry> glass = paint(quad({0, 3, 0}, x_axis * 9, z_axis * 9), {1, 1, 1, 0.25f});
  graphics::apply({.blended = true}, *glass->getOrCreateStateSet());
  stage.add(glass);
  stage.add(paint(wall(), {1, 0, 0, 1}));
  const Pixel p = at(*stage.picture(), 32, 32);
  EXPECT_GT(p.r, 120);
  EXPECT_GT(p.g, 25);
  EXPECT_LT(p.g, 80);
}

TEST(GraphicsShading, TheSkyShowsWhiteThingsAndBlackOnes) {
  Stage stage(64, 64);
  for (const osg::Vec3d& direction : {osg::Vec3d(0, 1, 0.02), osg::Vec3d(0, 1, 2), osg::Vec3d(0, 1, -2)}) {
    stage.look({0, 0, 0}, direction);
    const Pixel p = at(*stage.picture(), 32, 32);
    EXPECT_GT(p.sum(), 3 * 50) << p;
    EXPECT_LT(p.sum(), 3 * 200) << p;
  }
}

TEST(GraphicsShading, TheSkyMovesNoBounds) {
  Stage stage(64, 64);
  EXPECT_FALSE(stage.frame.root()->getBound().valid());
  stage.add(quad({0, 4, 0}, x_axis, z_axis));
  EXPECT_NEAR(stage.frame.root()->getBound().radius(), std::sqrt(2.0), 1e-3);
}

TEST(GraphicsShading, ASectionHidesWhatIsBeyondItsPlanes) {
  Stage stage(64, 64);
  stage.add(quad({0, 4, 0}, x_axis * 9, z_axis * 9));  // a wall of y = 4, seen from 0
  const auto is_wall = [&](int x, int y) {
    const auto picture = stage.picture();
    return at(*picture, x, y).distance(at(*picture, 32, 32)) < 60;
  };
  const auto cut = [&](const std::vector<HalfSpace>& planes) { graphics::set_section(*stage.scene, planes); };
  EXPECT_TRUE(is_wall(8, 32) && is_wall(56, 32) && is_wall(32, 8) && is_wall(32, 56));
  cut({{{1, 0, 0}, 0.5}});
  EXPECT_TRUE(is_wall(8, 32) && is_wall(32, 8) && is_wall(32, 56));
  EXPECT_FALSE(is_wall(56, 32));
  cut({{{1, 0, 0}, 0.5}, {{-1, 0, 0}, 0.5}, {{0, 0, 1}, 0.5}, {{0, 0, -1}, 0.5}, {{0, 1, 0}, 5}, {{0, -1, 0}, 0}});
  EXPECT_FALSE(is_wall(8, 32) || is_wall(56, 32) || is_wall(32, 8) || is_wall(32, 56));
  cut({});
  EXPECT_TRUE(is_wall(8, 32) && is_wall(56, 32) && is_wall(32, 8) && is_wall(32, 56));
}

}  // namespace
}  // namespace roam::test
