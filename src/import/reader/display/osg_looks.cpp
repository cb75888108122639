#include "import/reader/display/osg_looks.h"

#include <osg/AlphaFunc>
#include <osg/Material>
#include <osg/TexEnv>
#include <osg/TexMat>
#include <osg/Texture2D>

#include "import/reader/display/normal_matrix.h"

namespace roam::reader {
namespace {

/// Element `i` of an array of any kind as numbers. Integers are scaled to 0..1 if the array or `fraction` says so.
osg::Vec4d element(const osg::Array& array, std::uint64_t i, bool fraction) {
  const unsigned size = static_cast<unsigned>(array.getDataSize());
  osg::Vec4d v(0.0, 0.0, 0.0, 1.0);
  const auto take = [&](const auto* values, double one) {
    for (unsigned k = 0; k < size && k < 4; ++k) v[k] = static_cast<double>(values[i * size + k]) / one;
  };
  const bool scaled = fraction || array.getNormalize();
  const void* data = array.getDataPointer();
  switch (array.getDataType()) {
    case GL_FLOAT:
      take(static_cast<const float*>(data), 1.0);
      break;
    case GL_DOUBLE:
      take(static_cast<const double*>(data), 1.0);
      break;
    case GL_BYTE:
      take(static_cast<const std::int8_t*>(data), scaled ? 127.0 : 1.0);
      break;
    case GL_UNSIGNED_BYTE:
      take(static_cast<const std::uint8_t*>(data), scaled ? 255.0 : 1.0);
      break;
    case GL_SHORT:
      take(static_cast<const std::int16_t*>(data), scaled ? 32767.0 : 1.0);
      break;
    case GL_UNSIGNED_SHORT:
      take(static_cast<const std::uint16_t*>(data), scaled ? 65535.0 : 1.0);
      break;
    default:
      break;
  }
  return v;
}

/// The index of the array's element for a vertex of a primitive set; -1 if there is none.
std::int64_t place(const osg::Array* array, std::uint64_t vertex, unsigned set) {
  if (array == nullptr || array->getNumElements() == 0) return -1;
  std::uint64_t at = vertex;
  switch (array->getBinding()) {
    case osg::Array::BIND_OFF:
      return -1;
    case osg::Array::BIND_OVERALL:
      at = 0;
      break;
    case osg::Array::BIND_PER_PRIMITIVE_SET:
      at = set;
      break;
    default:
      break;
  }
  return at < array->getNumElements() ? static_cast<std::int64_t>(at) : -1;
}

bool is_by_set(const osg::Array* array) {
  return array != nullptr && array->getBinding() == osg::Array::BIND_PER_PRIMITIVE_SET;
}

Colour colour_of(const osg::Vec4d& c) {
  return {colour_byte(c[0]), colour_byte(c[1]), colour_byte(c[2]), colour_byte(c[3])};
}

/// OpenSceneGraph's default, CLAMP, blends in a border that is not drawn here, so it ends at the edge too.
DisplayWrap wrap_of(osg::Texture::WrapMode mode) {
  if (mode == osg::Texture::REPEAT) return DisplayWrap::repeat;
  return mode == osg::Texture::MIRROR ? DisplayWrap::mirror : DisplayWrap::clamp;
}

bool is_on(osg::StateAttribute::GLModeValue mode) { return (mode & osg::StateAttribute::ON) != 0; }

bool any_translucent(const osg::Array& colours) {
  if (colours.getDataSize() < 4) return false;
  for (unsigned i = 0; i < colours.getNumElements(); ++i) {
    if (colour_byte(element(colours, i, true)[3]) < 255) return true;
  }
  return false;
}

template <class Attribute>
const Attribute* attribute_of(const osg::StateSet& state, osg::StateAttribute::Type type) {
  return dynamic_cast<const Attribute*>(state.getAttribute(type));
}

}  // namespace

OsgLooks::OsgLooks(const osg::Geometry& geometry, const osg::NodePath& path, const osg::Matrixd& to_world,
                   Textures& textures)
    : normals_(geometry.getNormalArray()),
      colours_(geometry.getColorArray()),
      coordinates_(geometry.getNumTexCoordArrays() > 0 ? geometry.getTexCoordArray(0) : nullptr) {
  // OpenSceneGraph's vectors are rows, glm's are columns.
  glm::dmat3 linear;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) linear[i][j] = to_world(i, j);
  }
  normal_matrix_ = normal_matrix(linear);
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  for (const osg::Node* node : path) {
    if (node->getStateSet() != nullptr) state->merge(*node->getStateSet());
  }
  take_state(*state, textures);
}

void OsgLooks::take_state(const osg::StateSet& state, Textures& textures) {
  const auto* texture = dynamic_cast<const osg::Texture2D*>(state.getTextureAttribute(0, osg::StateAttribute::TEXTURE));
  const bool textured = texture != nullptr && is_on(state.getTextureMode(0, GL_TEXTURE_2D));
  const bool has_image = textured && texture->getImage() != nullptr && texture->getImage()->data() != nullptr;
  if (has_image &&
      (is_on(state.getTextureMode(0, GL_TEXTURE_GEN_S)) || is_on(state.getTextureMode(0, GL_TEXTURE_GEN_T)))) {
    textures.leave_out_generated();
  } else if (has_image && coordinates_ != nullptr) {
    // The walk has the graph as const, but the image is only read.
    osg::Image& image = const_cast<osg::Image&>(*texture->getImage());
    look_.texture = textures.add_image(
        image, {wrap_of(texture->getWrap(osg::Texture::WRAP_S)), wrap_of(texture->getWrap(osg::Texture::WRAP_T))});
  }
  if (const auto* matrix =
          dynamic_cast<const osg::TexMat*>(state.getTextureAttribute(0, osg::StateAttribute::TEXMAT))) {
    texture_matrix_ = matrix->getMatrix();
  }
  // A decal or replacement hides the colour below it.
  const auto* environment = dynamic_cast<const osg::TexEnv*>(state.getTextureAttribute(0, osg::StateAttribute::TEXENV));
  const bool covers = environment != nullptr &&
                      (environment->getMode() == osg::TexEnv::REPLACE || environment->getMode() == osg::TexEnv::DECAL);

  const auto* material = attribute_of<osg::Material>(state, osg::StateAttribute::MATERIAL);
  const bool lit = (state.getMode(GL_LIGHTING) & (osg::StateAttribute::ON | osg::StateAttribute::INHERIT)) != 0;
  if (material != nullptr && lit) {
    const auto mode = material->getColorMode();
    if (mode == osg::Material::DIFFUSE || mode == osg::Material::AMBIENT_AND_DIFFUSE) {
      // The vertex colour is that of the material.
    } else {
      colours_ = nullptr;
      const osg::Vec4 diffuse = material->getDiffuse(osg::Material::FRONT);
      material_ = colour_of(osg::Vec4d(diffuse));
      // A surface that only emits light would be black.
      const osg::Vec4 emission = material->getEmission(osg::Material::FRONT);
      for (std::size_t k = 0; k < 3; ++k)
        material_[k] = std::max(material_[k], colour_byte(emission[static_cast<int>(k)]));
    }
  }
  if (covers && look_.texture != no_texture) {
    colours_ = nullptr;
    material_ = white;
  }
  const auto* alpha = attribute_of<osg::AlphaFunc>(state, osg::StateAttribute::ALPHAFUNC);
  const bool cuts = alpha != nullptr && is_on(state.getMode(GL_ALPHA_TEST)) &&
                    (alpha->getFunction() == osg::AlphaFunc::GREATER || alpha->getFunction() == osg::AlphaFunc::GEQUAL);
  // An invisible surface would still stop a body, so show it.
  if (material_[3] == 0) material_[3] = 255;
  if (is_on(state.getMode(GL_BLEND))) {
    // Files often leave blending on for opaque surfaces, and blended surfaces must be sorted and drawn last.
    const bool translucent = material_[3] < 255 || (colours_ != nullptr && any_translucent(*colours_));
    look_.transparency = translucent ? Transparency::blend : Transparency::by_texture;
  } else if (cuts && look_.texture != no_texture) {
    look_.transparency = Transparency::mask;
    look_.cutoff = alpha->getReferenceValue();
  }
}

VertexLook OsgLooks::of(std::uint64_t vertex, unsigned set) const {
  VertexLook look;
  look.colour = material_;
  if (const std::int64_t at = place(normals_, vertex, set); at >= 0) {
    const osg::Vec4d n = element(*normals_, static_cast<std::uint64_t>(at), false);
    look.normal = transformed_normal(normal_matrix_, {n[0], n[1], n[2]});
  }
  if (const std::int64_t at = place(colours_, vertex, set); at >= 0) {
    look.colour = look.colour * colour_of(element(*colours_, static_cast<std::uint64_t>(at), true));
  }
  if (look_.texture == no_texture) return look;
  if (const std::int64_t at = place(coordinates_, vertex, set); at >= 0) {
    const osg::Vec4d c = element(*coordinates_, static_cast<std::uint64_t>(at), false);
    const osg::Vec3d moved = osg::Vec3d(c[0], c[1], 0.0) * texture_matrix_;
    look.texture = {static_cast<float>(moved.x()), static_cast<float>(moved.y())};
  }
  return look;
}

bool OsgLooks::by_set() const { return is_by_set(normals_) || is_by_set(colours_); }

}  // namespace roam::reader
