#include "graphics/shading.h"

#include <osg/BlendFunc>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Program>
#include <osg/StateSet>
#include <osg/Uniform>
#include <string>
#include <utility>

#include "graphics/frame.h"
#include "graphics/shading_shaders.h"
#include "text/number.h"

namespace roam::graphics {
namespace {

/// The head of the fragment shader: the sun, and the side of a map of shadows.
std::string sun_glsl() {
  const Vec3 sun = sun_direction();
  return "#version 120\nconst vec3 roam_sun = vec3(" + number_text(sun.x) + ", " + number_text(sun.y) + ", " +
         number_text(sun.z) + ");\nconst float roam_sun_side = " + std::to_string(shadow_map_side) + ".0;\n";
}

osg::ref_ptr<osg::Program> make_program(const char* name, const std::string& vertex, const std::string& fragment) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName(name);
  program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
  return program;
}

/// Makes a drawable invisible to bounds.
struct Nowhere : osg::Drawable::ComputeBoundingBoxCallback {
  osg::BoundingBox computeBound(const osg::Drawable&) const override { return {}; }
};

}  // namespace

Vec3 sun_direction() { return {0.48, -0.36, 0.80}; }

void apply(const Surface& surface, osg::StateSet& state) {
  if (surface.textured) state.setDefine(textured_define);
  if (surface.cutoff) {
    state.setDefine("ROAM_CUT");
    state.addUniform(new osg::Uniform("roam_cutoff", *surface.cutoff));
  }
  if (const auto& gloss = surface.gloss) {
    state.setDefine("ROAM_GLOSS");
    if (gloss->by_image) state.setDefine("ROAM_GLOSS_IMAGE");
    state.addUniform(new osg::Uniform("roam_gloss", osg::Vec2(gloss->roughness, gloss->metalness)));
  }
  if (const auto& emission = surface.emission) {
    state.setDefine("ROAM_EMISSION");
    if (emission->by_image) state.setDefine("ROAM_EMISSION_IMAGE");
    const auto& [red, green, blue] = emission->color;
    state.addUniform(new osg::Uniform("roam_emission", osg::Vec3(red, green, blue)));
  }
  if (surface.blended) {
    state.setDefine("ROAM_BLENDED");
    // The background keeps its share of later effects.
    state.setAttributeAndModes(
        new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, osg::BlendFunc::ZERO, osg::BlendFunc::ONE));
    state.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
  }
}

osg::ref_ptr<osg::Group> make_scene_group() {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  group->setName("scene");
  osg::StateSet& state = *group->getOrCreateStateSet();
  state.setAttribute(
      make_program("roam scene", std::string(depth_glsl()) + scene_vertex_glsl, sun_glsl() + scene_fragment_glsl));
  for (const auto& [name, unit] :
       {std::pair{"roam_picture", picture_unit}, std::pair{"roam_shadow", shadow_unit},
        std::pair{"roam_gloss_image", gloss_unit}, std::pair{"roam_emission_image", emission_unit}}) {
    state.addUniform(new osg::Uniform(name, static_cast<int>(unit)));
  }
  state.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
  return group;
}

void set_section(osg::Group& scene, std::span<const HalfSpace> hidden) {
  constexpr const char* define = "ROAM_SECTION";
  constexpr const char* name = "roam_section";
  osg::StateSet& state = *scene.getOrCreateStateSet();
  state.removeUniform(name);
  if (hidden.empty()) {
    state.removeDefine(define);
    return;
  }
  osg::ref_ptr<osg::Uniform> values = new osg::Uniform(osg::Uniform::FLOAT_VEC4, name, static_cast<int>(hidden.size()));
  for (unsigned i = 0; i < hidden.size(); ++i) {
    const auto& [normal, distance] = hidden[i];
    values->setElement(i, osg::Vec4(osg::Vec3d(normal.x, normal.y, normal.z), static_cast<float>(-distance)));
  }
  state.addUniform(values);
  state.setDefine(define, std::to_string(hidden.size()));
}

osg::ref_ptr<osg::Node> make_sky() {
  osg::ref_ptr<osg::Geometry> all = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (const auto& [x, y] : {std::pair{-1, -1}, std::pair{3, -1}, std::pair{-1, 3}}) {
    corners->push_back(osg::Vec3(static_cast<float>(x), static_cast<float>(y), 0));
  }
  all->setVertexArray(corners);
  all->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
  all->setUseDisplayList(false);
  all->setUseVertexBufferObjects(true);
  all->setComputeBoundingBoxCallback(new Nowhere);
  all->setCullingActive(false);
  osg::StateSet& state = *all->getOrCreateStateSet();
  state.setAttribute(make_program("roam sky", sky_vertex_glsl, sky_fragment_glsl));
  state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  state.setRenderBinDetails(-100, "RenderBin");
  osg::ref_ptr<osg::Geode> sky = new osg::Geode;
  sky->setName("sky");
  sky->addDrawable(all);
  sky->setCullingActive(false);
  return sky;
}

}  // namespace roam::graphics
