// How surfaces look.

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Material>
#include <osg/PagedLOD>
#include <osg/Program>
#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <osgText/Text>
#include <thread>

#include "graphics_stage.h"

namespace roam::test {
namespace {

const osg::Vec3d x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);

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
  osg::ref_ptr<osg::Geometry> culled = quad({0, 4, 0}, x_axis * 9, z_axis * -9);
  culled->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace,
                                                      osg::StateAttribute::ON | osg::StateAttribute::PROTECTED);
  EXPECT_EQ(middle_of(culled), back);
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

TEST(GraphicsShading, MaterialTimesVertexColourIsTheSurface) {
  const auto colored = [](osg::Material::ColorMode mode) {
    osg::ref_ptr<osg::Geometry> geometry = paint(wall(), {1, 1, 0, 1});
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 1, 1, 1));
    material->setColorMode(mode);
    geometry->getOrCreateStateSet()->setAttribute(material);
    return middle_of(geometry);
  };
  const Pixel product = colored(osg::Material::OFF);
  EXPECT_EQ(product.r, 0);
  EXPECT_GT(product.g, 120);
  EXPECT_EQ(product.b, 0);
  const Pixel replaced = colored(osg::Material::AMBIENT_AND_DIFFUSE);
  EXPECT_GT(replaced.r, 120);
  EXPECT_GT(replaced.g, 120);
  EXPECT_EQ(replaced.b, 0);
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

TEST(GraphicsShading, AMissingTextureLeavesTheSurfaceAndNotABlackHole) {
  osg::ref_ptr<osg::Geometry> geometry = textured(wall());
  geometry->getStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D);
  EXPECT_EQ(middle_of(geometry), middle_of(wall()));
}

TEST(GraphicsShading, TexturesHaveNoDarkSeamAtTheirEdge) {
  osg::ref_ptr<osg::Geometry> geometry = wall();
  geometry->setTexCoordArray(0, new osg::Vec2Array(4));  // the very corner, everywhere
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  std::fill_n(image->data(), 3, static_cast<unsigned char>(200));
  geometry->getOrCreateStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D(image));
  EXPECT_EQ(middle_of(geometry), (Pixel{200, 200, 200}));
}

TEST(GraphicsShading, ATextureThatIsSwitchedOffBelowIsNotDrawn) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  group->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture());
  osg::ref_ptr<osg::Geometry> geometry = wall();
  geometry->getOrCreateStateSet()->setTextureMode(0, GL_TEXTURE_2D, osg::StateAttribute::OFF);
  group->addChild(geometry);
  EXPECT_EQ(middle_of(group), middle_of(wall()));
}

TEST(GraphicsShading, WhatFilesBringAgainstThePictureIsTakenAway) {
  osg::ref_ptr<osg::Geometry> geometry = wall();
  osg::StateSet& state = *geometry->getOrCreateStateSet();
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, "void main() { gl_FragColor = vec4(1, 0, 1, 1); }"));
  state.setAttributeAndModes(program, osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  state.setAttributeAndModes(new osg::Depth(osg::Depth::LESS),
                             osg::StateAttribute::ON | osg::StateAttribute::PROTECTED);
  state.setMode(GL_LIGHTING, osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  state.setTextureAttributeAndModes(1, texture());
  EXPECT_EQ(middle_of(geometry), middle_of(wall()));
}

TEST(GraphicsShading, ArraysThatAreTooShortAreLeftOut) {
  osg::ref_ptr<osg::Geometry> geometry = wall();
  geometry->setColorArray(new osg::Vec4Array(2), osg::Array::BIND_PER_VERTEX);
  geometry->setNormalArray(new osg::Vec3Array(3), osg::Array::BIND_PER_VERTEX);
  geometry->setTexCoordArray(0, new osg::Vec2Array(1));
  EXPECT_EQ(middle_of(geometry), middle_of(wall()));
}

TEST(GraphicsShading, WhatIsTransparentIsBlendedOverWhatLiesBehind) {
  Stage stage(64, 64);
  osg::ref_ptr<osg::Geometry> glass = paint(quad({0, 3, 0}, x_axis * 9, z_axis * 9), {1, 1, 1, 0.25f});
  glass->getOrCreateStateSet()->setAttributeAndModes(new osg::BlendFunc);
  glass->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
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

TEST(GraphicsShading, PreparingTwiceChangesNothingMore) {
  osg::ref_ptr<osg::Geometry> geometry = textured(wall());
  graphics::prepare(*geometry);
  const osg::Array* colors = geometry->getColorArray();
  const osg::Array* normals = geometry->getNormalArray();
  const unsigned count = colors->getModifiedCount();
  graphics::prepare(*geometry);
  EXPECT_EQ(geometry->getColorArray(), colors);
  EXPECT_EQ(geometry->getNormalArray(), normals);
  EXPECT_EQ(colors->getModifiedCount(), count);
}

TEST(GraphicsShading, ThreadsMayPrepareGraphsThatShareParts) {
  osg::ref_ptr<osg::Geometry> shared = textured(wall());
  std::vector<osg::ref_ptr<osg::Group>> graphs;
  for (int i = 0; i < 4; ++i) {
    graphs.push_back(new osg::Group);
    for (int k = 0; k < 50; ++k) graphs.back()->addChild(textured(wall()));
    graphs.back()->addChild(shared);
  }
  std::vector<std::thread> threads;
  for (const auto& graph : graphs) threads.emplace_back([graph] { graphics::prepare(*graph); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& graph : graphs) {
    for (unsigned k = 0; k < graph->getNumChildren(); ++k) {
      ASSERT_TRUE(graph->getChild(k)->asGeometry()->getColorArray());
      EXPECT_EQ(graph->getChild(k)->asGeometry()->getColorArray()->getNumElements(), 1u);
    }
  }
}

TEST(GraphicsShading, WhatIsReadByTheCallbackIsPrepared) {
  const std::string file = testing::TempDir() + "roam-graphics-prepared.osgb";
  ASSERT_TRUE(osgDB::writeNodeFile(*wall(), file));
  osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
  options->setReadFileCallback(graphics::make_preparing_reader());
  const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file, options);
  std::filesystem::remove(file);
  ASSERT_TRUE(node && node->asGeometry());
  EXPECT_TRUE(node->asGeometry()->getColorArray());
}

TEST(GraphicsShading, PagesThatThePagerReadsThroughTheRegistryArePrepared) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("roam-graphics-pages-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  ASSERT_TRUE(osgDB::writeNodeFile(*wall(), (folder / "page.osgb").string()));
  osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
  paged->setDatabasePath(folder.string() + "/");
  paged->setCenter(osg::Vec3(0, 4, 0));
  paged->setRadius(10);
  paged->setFileName(0, "page.osgb");
  paged->setRange(0, 0, 1e6f);

  osgDB::Registry::instance()->setReadFileCallback(graphics::make_preparing_reader());
  {
    Stage stage(64, 64);
    stage.scene->addChild(paged);
    for (int i = 0; i < 500 && paged->getNumChildren() == 0; ++i) {
      stage.viewer.frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (paged->getNumChildren() == 1) {
      EXPECT_EQ(at(*stage.picture(), 32, 32), middle_of(wall()));
      ASSERT_TRUE(paged->getChild(0)->asGeometry());
      EXPECT_TRUE(paged->getChild(0)->asGeometry()->getColorArray());
    } else {
      ADD_FAILURE() << "the page was not read";
    }
  }
  osgDB::Registry::instance()->setReadFileCallback(nullptr);
  std::filesystem::remove_all(folder);
}

TEST(GraphicsShading, TextsOfFilesAreNotDrawnAndTheirSharedStateIsLeftAlone) {
  osg::ref_ptr<osgText::Text> text = new osgText::Text;
  text->setText("label");
  const osg::StateSet* state = text->getStateSet();
  graphics::prepare(*text);
  EXPECT_EQ(text->getNodeMask(), 0u);
  ASSERT_TRUE(state);
  EXPECT_TRUE(state->getAttribute(osg::StateAttribute::PROGRAM));
}

}  // namespace
}  // namespace roam::test
