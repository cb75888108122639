// Drawing without a graphics card.

#include <cstdlib>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Texture2D>
#include <string>
#include <vector>

#include "view_driven.h"

namespace {

using namespace roam::app;

/// Collects the samples that the textures of a graph take of each pixel at most.
class Samples : public osg::NodeVisitor {
 public:
  Samples() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
  void apply(osg::Node& node) override {
    if (const osg::StateSet* state = node.getStateSet()) {
      const auto* texture =
          dynamic_cast<const osg::Texture2D*>(state->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
      if (texture != nullptr && texture->getImage() != nullptr) taken.push_back(texture->getMaxAnisotropy());
    }
    traverse(node);
  }
  std::vector<float> taken;
};

TEST(ViewSoftware, TakesOneSampleOfEachTexture) {
  EXPECT_EQ(texture_quality({.software = true}).anisotropy, 1.0f);
  EXPECT_GT(texture_quality({.software = false}).anisotropy, 1.0f);

  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  DrivenSession driven;
  std::string image{"\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0", 16};  // TGA, 2 x 2, colours as they are
  image += {24, 0};
  image.append(12, '\x7f');
  driven.folder.write("stone.tga", image);
  driven.folder.write("ground.mtl", "newmtl stone\nKd 1 1 1\nmap_Kd stone.tga\n");
  driven.write_scene(
      "mtllib ground.mtl\nusemtl stone\nv -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nvt 0 0\nvt 9 0\nvt 9 9\nvt 0 9\n"
      "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  driven.begin();
  driven.run(0.1);
  Samples samples;
  driven.session->stage().viewer().getSceneData()->accept(samples);
  unsetenv("LIBGL_ALWAYS_SOFTWARE");
  EXPECT_EQ(samples.taken, std::vector<float>{1.0f});
}

}  // namespace
