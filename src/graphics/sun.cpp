#include "graphics/sun.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <osg/Camera>
#include <osg/ColorMask>
#include <osg/PolygonOffset>
#include <osg/Program>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <osg/Uniform>
#include <osgUtil/CullVisitor>
#include <string>
#include <utility>

#include "graphics/shading.h"

namespace roam::graphics {
namespace {

constexpr int levels = 4;  // of maps, each four times as wide as the one before
constexpr int tile = shadow_map_side;
constexpr double finest = 8.0;  // m: half the side of the first map
constexpr double moves = 0.25;  // of half the side: a map follows the eye by such steps, which are whole texels
constexpr auto shadow_define = "ROAM_SUN";
constexpr auto full_define = "ROAM_FULL";

constexpr const char* caster_vertex = R"(#version 120
#pragma import_defines(ROAM_SECTION, ROAM_BLENDED, ROAM_CUT, ROAM_TEXTURED)
#ifdef ROAM_SECTION
uniform mat4 roam_from_sun;
varying vec4 roam_place;
#endif
varying float roam_opacity;
void main() {
  vec4 eye = gl_ModelViewMatrix * gl_Vertex;
#ifdef ROAM_SECTION
  roam_place = roam_from_sun * eye;
#endif
  roam_opacity = gl_Color.a;
  gl_TexCoord[0] = gl_TextureMatrix[0] * gl_MultiTexCoord0;
#ifdef ROAM_BLENDED
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // nowhere
#else
  gl_Position = gl_ProjectionMatrix * eye;
#endif
}
)";

constexpr const char* caster_fragment = R"(#version 120
#pragma import_defines(ROAM_SECTION, ROAM_CUT, ROAM_TEXTURED)
#ifdef ROAM_SECTION
uniform vec4 roam_section[ROAM_SECTION];
varying vec4 roam_place;
#endif
#ifdef ROAM_CUT
uniform float roam_cutoff;
uniform sampler2D roam_picture;
#endif
varying float roam_opacity;
void main() {
#ifdef ROAM_SECTION
  for (int i = 0; i < ROAM_SECTION; ++i) {
    if (dot(roam_section[i], roam_place) > 0.0) discard;
  }
#endif
#ifdef ROAM_CUT
  float opacity = roam_opacity;
#ifdef ROAM_TEXTURED
  opacity *= texture2D(roam_picture, gl_TexCoord[0].st).a;
#endif
  if (opacity < roam_cutoff) discard;
#endif
  gl_FragColor = vec4(1.0);
}
)";

/// Axes across the light, and towards the sun.
struct Axes {
  osg::Vec3d across, along, sun;
};

Axes sun_axes() {
  const Vec3 towards = sun_direction();
  Axes axes;
  axes.sun.set(towards.x, towards.y, towards.z);
  axes.across = osg::Vec3d(0, 0, 1) ^ axes.sun;
  axes.across.normalize();
  axes.along = axes.sun ^ axes.across;
  return axes;
}

/// From the graph to (across, along, towards the sun), in OpenSceneGraph's order of rows.
osg::Matrixd to_sun(const Axes& axes) {
  const auto& [x, y, z] = axes;
  return {x.x(), y.x(), z.x(), 0, x.y(), y.y(), z.y(), 0, x.z(), y.z(), z.z(), 0, 0, 0, 0, 1};
}

osg::ref_ptr<osg::Texture2D> make_map() {
  osg::ref_ptr<osg::Texture2D> map = new osg::Texture2D;
  constexpr int across = 2;
  map->setTextureSize(across * tile, levels / across * tile);
  map->setInternalFormat(GL_DEPTH_COMPONENT24);
  map->setSourceFormat(GL_DEPTH_COMPONENT);
  map->setSourceType(GL_UNSIGNED_INT);
  map->setShadowComparison(true);
  map->setShadowCompareFunc(osg::Texture::LEQUAL);
  for (const auto which : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
    map->setFilter(which, osg::Texture::LINEAR);
  for (const auto which : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
    map->setWrap(which, osg::Texture::CLAMP_TO_EDGE);
  map->setResizeNonPowerOfTwoHint(false);
  return map;
}

}  // namespace

/// Draws the maps, before the scene, while the scene is culled: by then the eye is known.
class Sun::Maps : public osg::Node {
 public:
  Maps(Frame& frame, osg::Group& scene)
      : frame_(frame),
        scene_(&scene),
        axes_(sun_axes()),
        map_(make_map()),
        outdoors_(new osg::Uniform("roam_outdoors", 1.0f)),
        to_map_(new osg::Uniform("roam_sun_map", osg::Matrixf())),
        tiles_(new osg::Uniform(osg::Uniform::FLOAT_VEC4, "roam_sun_tiles", levels)) {
    setName("sun");
    setCullingActive(false);
    for (osg::Uniform* uniform : {outdoors_.get(), to_map_.get(), tiles_.get()}) {
      uniform->setDataVariance(osg::Object::DYNAMIC);
    }
    make_state();
    for (int i = 0; i < levels; ++i) drawn_[i].camera = make_camera(i);
  }

  void traverse(osg::NodeVisitor& visitor) override {
    osgUtil::CullVisitor* const cull = visitor.asCullVisitor();
    if (cull == nullptr) return;
    const bool full = frame_.next_quality() == Quality::full && scene_->getBound().valid();
    const bool shown = full && shown_;
    set_full(full);
    show(shown);
    if (!shown) {
      paused_ = true;
      return;
    }
    aim(cull->getCurrentCamera()->getInverseViewMatrix().getTrans());
    for (const Level& level : drawn_) {
      if (level.is_due) level.camera->accept(*cull);
    }
  }

  void set_shown(bool shown) { shown_ = shown; }
  void watch(std::function<std::uint64_t()> version) { watched_ = std::move(version); }
  void set_outdoors(float share) { outdoors_->set(share); }
  void end() {
    show(false);
    set_full(false);
  }

 private:
  /// A square about a place across the light.
  struct Area {
    osg::Vec2d centre;
    double half = 0.0;
    bool operator==(const Area& o) const { return centre == o.centre && half == o.half; }
  };
  struct Level {
    Area area;
    bool is_due = false;
    bool is_stale = false;  // a little has changed since it was drawn
    osg::ref_ptr<osg::Camera> camera;
  };

  void make_state() {
    casters_ = new osg::Group;
    casters_->addChild(scene_);
    osg::StateSet& state = *casters_->getOrCreateStateSet();
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName("roam shadow");
    program->addShader(new osg::Shader(osg::Shader::VERTEX, caster_vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, caster_fragment));
    constexpr unsigned all = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
    state.setAttributeAndModes(program, all);
    state.setAttributeAndModes(new osg::ColorMask(false, false, false, false), all);
    state.setMode(GL_BLEND, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    state.setMode(GL_DEPTH_TEST, osg::StateAttribute::ON);
    state.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    constexpr float slope = 1.5f, units = 4.0f;
    state.setAttributeAndModes(new osg::PolygonOffset(slope, units));
    state.addUniform(new osg::Uniform("roam_from_sun", osg::Matrixf(osg::Matrixd::inverse(to_sun(axes_)))));
  }

  osg::ref_ptr<osg::Camera> make_camera(int level) {
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF_INHERIT_VIEWPOINT);
    camera->setRenderOrder(osg::Camera::PRE_RENDER, level);
    camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera->setImplicitBufferAttachmentMask(0, 0);
    camera->attach(osg::Camera::DEPTH_BUFFER, map_);
    camera->setDrawBuffer(GL_NONE);
    camera->setReadBuffer(GL_NONE);
    camera->setClearMask(GL_DEPTH_BUFFER_BIT);
    camera->setClearDepth(1.0);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setCullingMode(osg::CullSettings::VIEW_FRUSTUM_SIDES_CULLING);
    camera->setViewport(level % 2 * tile, level / 2 * tile, tile, tile);
    camera->setViewMatrix(to_sun(axes_));
    camera->addChild(casters_);  // the camera's own state has its viewport
    return camera;
  }

  /// Lights the scene by day or lamp, and lets smooth surfaces mirror, or as without a sun.
  void set_full(bool full) {
    osg::StateSet& state = *scene_->getOrCreateStateSet();
    if (full == (state.getUniform("roam_outdoors") != nullptr)) return;
    if (full) {
      state.setDefine(full_define);
      state.addUniform(outdoors_);
    } else {
      state.removeDefine(full_define);
      state.removeUniform(outdoors_);
    }
  }

  /// Lights the scene with shadows, or without.
  void show(bool shown) {
    osg::StateSet& state = *scene_->getOrCreateStateSet();
    if (shown == (state.getUniform("roam_sun_tiles") != nullptr)) return;
    if (shown) {
      state.setDefine(shadow_define, std::to_string(levels));
      state.setTextureAttribute(shadow_unit, map_);
      for (osg::Uniform* uniform : {to_map_.get(), tiles_.get()}) state.addUniform(uniform);
      return;
    }
    state.removeDefine(shadow_define);
    state.removeTextureAttribute(shadow_unit, osg::StateAttribute::TEXTURE);
    for (osg::Uniform* uniform : {to_map_.get(), tiles_.get()}) state.removeUniform(uniform);
  }

  /// Puts the maps about the eye. Those that moved are due; all if the scene has changed; one if a little of it has.
  void aim(const osg::Vec3d& eye) {
    const osg::BoundingSphered all(scene_->getBound().center(), scene_->getBound().radius());
    const osg::Uniform* const section = scene_->getStateSet()->getUniform("roam_section");
    const std::uint64_t version = watched_ ? watched_() : 0;
    const bool changed = all.center() != seen_.center() || all.radius() != seen_.radius() ||
                         children_ != scene_->getNumChildren() || section != section_;
    const bool changed_a_little = version != version_;
    const bool resumed = std::exchange(paused_, false);
    seen_ = all;
    children_ = scene_->getNumChildren();
    section_ = section;
    version_ = version;
    const osg::Matrixd to = to_sun(axes_);
    const osg::Vec3d middle = all.center() * to, at = eye * to;
    const double near = middle.z() + all.radius(), far = middle.z() - all.radius();
    double half = finest;
    for (int i = 0; i < levels; ++i, half *= 4.0) {
      Level& level = drawn_[i];
      Area area{{middle.x(), middle.y()}, all.radius()};
      if (half < all.radius()) {
        const double step = moves * half;
        area = {{step * std::round(at.x() / step), step * std::round(at.y() / step)}, half};
      }
      level.is_stale = level.is_stale || changed_a_little;
      level.is_due = changed || !(area == level.area) || (resumed && level.is_stale);
      level.is_stale = level.is_stale && !level.is_due;
      // A map of the whole scene needs none beyond it.
      if (i > 0 && drawn_[i - 1].area.half == all.radius()) level.is_due = level.is_stale = false;
      level.area = area;
      const osg::Vec2d& c = area.centre;
      level.camera->setProjectionMatrixAsOrtho(c.x() - area.half, c.x() + area.half, c.y() - area.half,
                                               c.y() + area.half, -near, -far);
      const osg::Vec4d shown(c.x(), c.y(), area.half, 2.0 * area.half / tile);
      tiles_->setElement(static_cast<unsigned>(i), osg::Vec4(shown));
    }
    refresh_one();
    // Depth is 0 at the scene's end towards the sun and 1 at the other.
    const osg::Matrixd depth(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.0 / (far - near), 0, 0, 0, -near / (far - near), 1);
    to_map_->set(osg::Matrixf(to * depth));
  }

  /// Lets the next stale map be due, after the one that was the last.
  void refresh_one() {
    for (int i = 0; i < levels; ++i) {
      last_ = (last_ + 1) % levels;
      Level& level = drawn_[last_];
      if (!std::exchange(level.is_stale, false)) continue;
      level.is_due = true;
      return;
    }
  }

  Frame& frame_;
  osg::ref_ptr<osg::Group> scene_;
  const Axes axes_;
  osg::ref_ptr<osg::Texture2D> map_;
  osg::ref_ptr<osg::Group> casters_;  // the scene, drawn as depths
  osg::ref_ptr<osg::Uniform> outdoors_, to_map_, tiles_;
  std::array<Level, levels> drawn_;
  int last_ = levels - 1;  // of the maps that were drawn in turn
  bool shown_ = true;
  bool paused_ = true;         // the frame before had no shadows
  osg::BoundingSphered seen_;  // the scene of which the maps are
  unsigned children_ = 0;
  std::uint64_t version_ = 0;
  std::function<std::uint64_t()> watched_;
  osg::ref_ptr<const osg::Uniform> section_;
};

Sun::Sun(Frame& frame, osg::Group& scene) : root_(frame.root()), maps_(new Maps(frame, scene)) {
  root_->insertChild(0, maps_);
}

Sun::~Sun() {
  maps_->end();
  root_->removeChild(maps_);
}

void Sun::set_outdoors(double share) { maps_->set_outdoors(static_cast<float>(std::clamp(share, 0.0, 1.0))); }
void Sun::watch(std::function<std::uint64_t()> version) { maps_->watch(std::move(version)); }
void Sun::set_shadows(bool shown) { maps_->set_shown(shown); }

}  // namespace roam::graphics
