#include "graphics/plate.h"

#include <algorithm>
#include <osg/Array>
#include <osg/Program>

namespace roam::graphics {
namespace {

constexpr const char* vertex_source = R"(#version 120
varying vec2 roam_place;
varying vec3 roam_shape;
varying vec4 roam_color;
void main() {
  roam_place = gl_MultiTexCoord0.xy;
  roam_shape = gl_MultiTexCoord1.xyz;
  roam_color = gl_Color;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

// The distance to the outline, in pixels, gives an edge that is soft over one pixel.
constexpr const char* fragment_source = R"(#version 120
varying vec2 roam_place;
varying vec3 roam_shape;
varying vec4 roam_color;
void main() {
  vec2 beyond = abs(roam_place) - roam_shape.xy + roam_shape.z;
  float distance = length(max(beyond, 0.0)) + min(max(beyond.x, beyond.y), 0.0) - roam_shape.z;
  gl_FragColor = vec4(roam_color.rgb, roam_color.a * clamp(0.5 - distance, 0.0, 1.0));
}
)";

}  // namespace

osg::ref_ptr<osg::Geometry> make_plate(const Rectangle& where, float radius, const osg::Vec4& color) {
  osg::ref_ptr<osg::Geometry> plate = new osg::Geometry;
  plate->setDataVariance(osg::Object::DYNAMIC);
  plate->setUseDisplayList(false);
  plate->setUseVertexBufferObjects(true);
  plate->setCullingActive(false);
  plate->setVertexArray(new osg::Vec3Array(4));
  plate->setTexCoordArray(0, new osg::Vec2Array(4));
  plate->setTexCoordArray(1, new osg::Vec3Array(4));
  osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(4);
  std::fill(colors->begin(), colors->end(), color);
  plate->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
  plate->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4));
  move_plate(*plate, where, radius);
  return plate;
}

void move_plate(osg::Geometry& plate, const Rectangle& where, float radius) {
  auto& corners = static_cast<osg::Vec3Array&>(*plate.getVertexArray());
  auto& places = static_cast<osg::Vec2Array&>(*plate.getTexCoordArray(0));
  auto& shapes = static_cast<osg::Vec3Array&>(*plate.getTexCoordArray(1));
  const osg::Vec2 half(0.5f * where.width, 0.5f * where.height);
  for (unsigned i = 0; i < 4; ++i) {
    // One pixel more on all sides for the soft edge.
    const osg::Vec2 place((i & 1 ? 1.0f : -1.0f) * (half.x() + 1), (i & 2 ? 1.0f : -1.0f) * (half.y() + 1));
    corners[i].set(where.x + half.x() + place.x(), where.y + half.y() + place.y(), 0);
    places[i] = place;
    shapes[i].set(half.x(), half.y(), std::min({radius, half.x(), half.y()}));
  }
  corners.dirty();
  places.dirty();
  shapes.dirty();
  plate.dirtyBound();
}

osg::ref_ptr<osg::StateSet> plate_state() {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName("roam plate");
  program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex_source));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment_source));
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  state->setAttribute(program);
  return state;
}

}  // namespace roam::graphics
