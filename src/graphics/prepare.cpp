#include <mutex>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/NodeVisitor>
#include <osg/StateSet>
#include <osg/Texture2D>

#include "graphics/shading.h"

namespace roam::graphics {
namespace {

using Attribute = osg::StateAttribute;

constexpr Attribute::Type unwanted_attributes[] = {
    Attribute::PROGRAM,    Attribute::DEPTH,    Attribute::CLIPCONTROL, Attribute::CULLFACE,
    Attribute::FRONTFACE,  Attribute::FOG,      Attribute::LIGHTMODEL,  Attribute::COLORMASK,
    Attribute::SHADEMODEL, Attribute::VIEWPORT, Attribute::SCISSOR,     Attribute::POLYGONOFFSET};
constexpr Attribute::GLMode unwanted_modes[] = {GL_LIGHTING, GL_CULL_FACE, GL_DEPTH_TEST, GL_FOG, GL_SCISSOR_TEST};
constexpr const char* textured = "ROAM_TEXTURED";

/// Material x vertex colour is the surface. Where the file wants the colour *instead* of the material's, that is white.
void prepare_material(osg::StateSet& state) {
  auto* material = dynamic_cast<osg::Material*>(state.getAttribute(Attribute::MATERIAL));
  if (!material) return;
  const osg::Material::ColorMode mode = material->getColorMode();
  if (mode == osg::Material::OFF) return;
  material->setColorMode(osg::Material::OFF);
  if (mode == osg::Material::DIFFUSE || mode == osg::Material::AMBIENT_AND_DIFFUSE) {
    const float alpha = material->getDiffuse(osg::Material::FRONT).a();
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, alpha));
  }
}

/// A texture whose file is missing would be drawn black.
bool can_be_drawn(const osg::StateAttribute* texture) {
  const auto* flat = dynamic_cast<const osg::Texture2D*>(texture);
  return flat && flat->getImage() && flat->getImage()->valid();
}

/// The old wrapping mixes a border into the texels at the edge, black where none is set: a dark seam between tiles.
void prepare_edges(osg::Texture& texture) {
  for (const osg::Texture::WrapParameter side : {osg::Texture::WRAP_S, osg::Texture::WRAP_T}) {
    if (texture.getWrap(side) == osg::Texture::CLAMP) texture.setWrap(side, osg::Texture::CLAMP_TO_EDGE);
  }
}

void set_textured(osg::StateSet& state, bool on) {
  const auto wished = on ? Attribute::ON : Attribute::OFF;
  const osg::StateSet::DefinePair* now = state.getDefinePair(textured);
  if (!now || now->second != wished) state.setDefine(textured, wished);
}

void prepare_textures(osg::StateSet& state) {
  for (unsigned unit = 1; unit < state.getTextureAttributeList().size(); ++unit) {
    const osg::StateSet::AttributeList attributes = state.getTextureAttributeList()[unit];
    for (const auto& [type, value] : attributes) state.removeTextureAttribute(unit, type.first);
  }
  for (unsigned unit = 1; unit < state.getTextureModeList().size(); ++unit) {
    const osg::StateSet::ModeList modes = state.getTextureModeList()[unit];
    for (const auto& [mode, value] : modes) state.removeTextureMode(unit, mode);
  }
  for (const Attribute::Type type : {Attribute::TEXENV, Attribute::TEXGEN}) state.removeTextureAttribute(0, type);

  // The shader does not see whether a texture is switched on: what it samples is said by a define, state by state.
  Attribute* texture = state.getTextureAttribute(0, Attribute::TEXTURE);
  const auto mode = state.getTextureMode(0, GL_TEXTURE_2D);
  if (texture && !can_be_drawn(texture)) {
    state.removeTextureAttribute(0, Attribute::TEXTURE);
    set_textured(state, false);
  } else if (texture) {
    prepare_edges(*texture->asTexture());
    set_textured(state, (mode & Attribute::ON) != 0 || (mode & Attribute::INHERIT) != 0);
  } else if ((mode & (Attribute::ON | Attribute::INHERIT)) == 0) {
    set_textured(state, false);
  }
}

void prepare_state(osg::StateSet& state) {
  for (const Attribute::Type type : unwanted_attributes) state.removeAttribute(type);
  for (const Attribute::GLMode mode : unwanted_modes) state.removeMode(mode);
  prepare_material(state);
  prepare_textures(state);
}

/// Whether `array` says something about each of `vertices` vertices, or one thing about all.
bool fits(const osg::Array* array, unsigned vertices) {
  if (!array || array->getNumElements() == 0) return false;
  if (array->getBinding() == osg::Array::BIND_OVERALL) return true;
  return array->getBinding() == osg::Array::BIND_PER_VERTEX && array->getNumElements() >= vertices;
}

void prepare_geometry(osg::Geometry& geometry) {
  if (geometry.containsDeprecatedData()) geometry.fixDeprecatedData();
  const unsigned vertices = geometry.getVertexArray() ? geometry.getVertexArray()->getNumElements() : 0;
  if (!fits(geometry.getColorArray(), vertices)) {
    osg::ref_ptr<osg::Vec4Array> white = new osg::Vec4Array(1);
    (*white)[0] = osg::Vec4(1, 1, 1, 1);
    geometry.setColorArray(white, osg::Array::BIND_OVERALL);
  }
  if (!fits(geometry.getNormalArray(), vertices)) {
    geometry.setNormalArray(new osg::Vec3Array(1), osg::Array::BIND_OVERALL);
  }
  if (geometry.getTexCoordArray(0) && !fits(geometry.getTexCoordArray(0), vertices)) {
    geometry.setTexCoordArray(0, nullptr);
  }
  if (geometry.getUseDisplayList()) geometry.setUseDisplayList(false);
  if (!geometry.getUseVertexBufferObjects()) geometry.setUseVertexBufferObjects(true);
}

class Preparation : public osg::NodeVisitor {
 public:
  Preparation() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }
  void apply(osg::Node& node) override {
    if (node.getStateSet()) prepare_state(*node.getStateSet());
    traverse(node);
  }
  void apply(osg::Drawable& drawable) override {
    // Texts, particles and the like draw in ways of their own, and their states are shared with those of other texts.
    if (drawable.getNodeMask() != 0) drawable.setNodeMask(0);
  }
  void apply(osg::Geometry& geometry) override {
    if (geometry.getStateSet()) prepare_state(*geometry.getStateSet());
    prepare_geometry(geometry);
  }
};

/// What a second thread might share with a first, it must see either untouched or finished.
std::mutex preparing;

class PreparingReader : public osgDB::ReadFileCallback {
 public:
  explicit PreparingReader(osg::ref_ptr<osgDB::ReadFileCallback> next) : next_(std::move(next)) {}
  osgDB::ReaderWriter::ReadResult readNode(const std::string& file, const osgDB::Options* options) override {
    auto result =
        next_ ? next_->readNode(file, options) : osgDB::Registry::instance()->readNodeImplementation(file, options);
    if (result.getNode()) prepare(*result.getNode());
    return result;
  }

 private:
  osg::ref_ptr<osgDB::ReadFileCallback> next_;
};

}  // namespace

void prepare(osg::Node& graph) {
  const std::lock_guard lock(preparing);
  Preparation preparation;
  graph.accept(preparation);
}

osg::ref_ptr<osgDB::ReadFileCallback> make_preparing_reader(osg::ref_ptr<osgDB::ReadFileCallback> next) {
  return new PreparingReader(std::move(next));
}

}  // namespace roam::graphics
