#include "graphics/overlay.h"

#include <algorithm>
#include <cmath>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/LineWidth>
#include <osg/Program>
#include <osg/StateSet>
#include <string>
#include <utility>

namespace roam::graphics {
namespace {

const osg::Vec4 body_color(0.35f, 0.80f, 1.0f, 0.9f);
const osg::Vec4 held_color(1.0f, 0.66f, 0.20f, 0.95f);
const osg::Vec4 contact_color(1.0f, 0.25f, 0.30f, 1.0f);
const osg::Vec4 measure_color(0.95f, 0.15f, 0.75f, 1.0f);
const osg::Vec4 way_color(0.10f, 0.85f, 0.35f, 1.0f);
const osg::Vec4 barred_color(1.0f, 0.45f, 0.10f, 1.0f);
const osg::Vec4 triangle_color(1.0f, 0.72f, 0.20f, 0.95f);
const osg::Vec4 face_color(1.0f, 0.72f, 0.20f, 0.28f);
const osg::Vec4 box_color(0.25f, 0.55f, 1.0f, 1.0f);
const osg::Vec4 grip_color(0.15f, 0.50f, 1.0f, 1.0f), grip_side_color(0.05f, 0.35f, 0.85f, 1.0f);
const osg::Vec4 held_grip_color(1.0f, 0.80f, 0.25f, 1.0f);
constexpr double normal_length = 0.3, cross_size = 0.05;  // metres
constexpr int circle_corners = 48;
constexpr double pi = 3.14159265358979323846;

constexpr const char* vertex_source = R"(
varying vec4 roam_color;
void main() {
  vec4 eye = gl_ModelViewMatrix * gl_Vertex;
  // A thousandth nearer: what lies on a wall is seen on it.
  eye.xyz *= 0.999;
  roam_color = gl_Color;
  gl_Position = roam_clip(eye);
}
)";

constexpr const char* fragment_source = R"(#version 120
varying vec4 roam_color;
uniform float roam_strength;
void main() { gl_FragColor = vec4(roam_color.rgb, roam_color.a * roam_strength); }
)";

osg::Vec3 to_osg(const Vec3& p) { return osg::Vec3d(p.x, p.y, p.z); }

/// Points of one primitive type, each with a colour.
class Strokes {
 public:
  explicit Strokes(GLenum type) : type_(type) {}
  void add(const Vec3& point, const osg::Vec4& color) {
    points_->push_back(to_osg(point));
    colors_->push_back(color);
  }
  void line(const Vec3& a, const Vec3& b, const osg::Vec4& color) {
    add(a, color);
    add(b, color);
  }
  /// Adds the part of a circle about `centre` from angle `from` to `to`: centre + cos t u + sin t v.
  void arc(const Vec3& centre, const Vec3& u, const Vec3& v, double from, double to, const osg::Vec4& color) {
    const int pieces = std::max(1, static_cast<int>(std::lround(circle_corners * (to - from) / (2 * pi))));
    const auto at = [&](int i) {
      const double t = from + (to - from) * i / pieces;
      return centre + std::cos(t) * u + std::sin(t) * v;
    };
    for (int i = 0; i < pieces; ++i) line(at(i), at(i + 1), color);
  }
  void add_to(osg::Group& group) const {
    if (points_->empty()) return;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(points_);
    geometry->setColorArray(colors_, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(new osg::DrawArrays(type_, 0, static_cast<GLsizei>(points_->size())));
    group.addChild(geometry);
  }

 private:
  GLenum type_;
  osg::ref_ptr<osg::Vec3Array> points_ = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec4Array> colors_ = new osg::Vec4Array;
};

void draw_body(const BodyMark& body, Strokes& lines) {
  const osg::Vec4& color = body.held ? held_color : body_color;
  const double r = body.radius;
  const double half = std::max(0.0, 0.5 * body.height - r);
  const Vec3 x(r, 0, 0), y(0, r, 0), z(0, 0, r);
  const Vec3 top = body.centre + Vec3(0, 0, half), bottom = body.centre - Vec3(0, 0, half);
  if (body.inside) {
    constexpr double above_floor = 0.02;  // metres
    return lines.arc(bottom - (1.0 - above_floor / r) * z, x, y, 0, 2 * pi, color);
  }
  lines.arc(top, x, y, 0, 2 * pi, color);
  if (half > 0) lines.arc(bottom, x, y, 0, 2 * pi, color);
  for (const double height : {0.5, 0.866}) {  // 30 and 60 degrees of latitude
    const double share = std::sqrt(1 - height * height);
    lines.arc(top + height * z, share * x, share * y, 0, 2 * pi, color);
    lines.arc(bottom - height * z, share * x, share * y, 0, 2 * pi, color);
  }
  constexpr int meridians = 8;
  for (int i = 0; i < meridians; ++i) {
    const double t = 2 * pi * i / meridians;
    const Vec3 out = std::cos(t) * x + std::sin(t) * y;
    lines.arc(top, out, z, 0, 0.5 * pi, color);
    lines.arc(bottom, out, -z, 0, 0.5 * pi, color);
    if (half > 0) lines.line(top + out, bottom + out, color);
  }
}

void draw_cross(const Vec3& point, const osg::Vec4& color, Strokes& lines) {
  for (int k = 0; k < 3; ++k) {
    Vec3 arm(0.0);
    arm[k] = cross_size;
    lines.line(point - arm, point + arm, color);
  }
}

void draw_contact(const ContactMark& contact, Strokes& lines) {
  lines.line(contact.point, contact.point + normal_length * contact.normal, contact_color);
  draw_cross(contact.point, contact_color, lines);
}

void draw_triangle(const std::array<Vec3, 3>& corners, Strokes& lines, Strokes& faces) {
  for (std::size_t k = 0; k < 3; ++k) {
    lines.line(corners[k], corners[(k + 1) % 3], triangle_color);
    faces.add(corners[k], face_color);
  }
}

void draw_edges(const Box& box, Strokes& lines) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      Vec3 from = box.lower;
      if ((corner & 1) != 0) from[(axis + 1) % 3] = box.upper[(axis + 1) % 3];
      if ((corner & 2) != 0) from[(axis + 2) % 3] = box.upper[(axis + 2) % 3];
      Vec3 to = from;
      to[axis] = box.upper[axis];
      lines.line(from, to, box_color);
    }
  }
}

/// An octahedron of two shades.
void draw_grip(const GripMark& grip, Strokes& faces) {
  for (int octant = 0; octant < 8; ++octant) {
    const osg::Vec4& color = grip.held ? held_grip_color : (octant & 4) != 0 ? grip_color : grip_side_color;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 corner(0.0);
      corner[axis] = (octant >> axis & 1) != 0 ? grip.radius : -grip.radius;
      faces.add(grip.at + corner, color);
    }
  }
}

/// With a strength below 1: the parts behind walls, faintly. `bin`: after all transparent surfaces.
osg::ref_ptr<osg::Group> make_pass(int bin, bool depth_test, float strength, osg::Node* content) {
  osg::ref_ptr<osg::Group> pass = new osg::Group;
  osg::StateSet& state = *pass->getOrCreateStateSet();
  state.addUniform(new osg::Uniform("roam_strength", strength));
  // With the depth comparison of Frame::space().
  state.setRenderBinDetails(bin, "RenderBin");
  if (!depth_test) state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  pass->addChild(content);
  return pass;
}

void make_state(osg::StateSet& state) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName("roam overlay");
  program->addShader(new osg::Shader(osg::Shader::VERTEX, std::string(depth_glsl()) + vertex_source));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment_source));
  state.setAttribute(program);
  state.setAttributeAndModes(new osg::BlendFunc);
  state.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
}

}  // namespace

Overlay::Overlay(Frame& frame)
    : frame_(frame), parent_(frame.space()), group_(new osg::Group), marks_(new osg::Group), grips_(new osg::Group) {
  group_->setName("overlay");
  make_state(*group_->getOrCreateStateSet());
  constexpr float faint = 0.22f;
  group_->addChild(make_pass(20, false, faint, marks_));
  group_->addChild(make_pass(21, true, 1.0f, marks_));
  group_->addChild(make_pass(22, false, 1.0f, grips_));
  parent_->addChild(group_);
}

Overlay::~Overlay() { parent_->removeChild(group_); }

void Overlay::set_marks(const Marks& marks) {
  constexpr float least_width = 2.0f, height_in_widths = 540.0f;
  const float width = std::max(least_width, static_cast<float>(frame_.height()) / height_in_widths);
  if (std::exchange(line_width_, width) != width) {
    group_->getOrCreateStateSet()->setAttribute(new osg::LineWidth(width));
  }
  Strokes lines(GL_LINES), faces(GL_TRIANGLES), grips(GL_TRIANGLES);
  if (marks.body) draw_body(*marks.body, lines);
  for (const ContactMark& contact : marks.contacts) draw_contact(contact, lines);
  for (const std::array<Vec3, 3>& triangle : marks.triangles) draw_triangle(triangle, lines, faces);
  for (const auto& [from, to] : marks.lines) lines.line(from, to, measure_color);
  for (const auto& [from, to] : marks.way) lines.line(from, to, way_color);
  for (const auto& [from, to] : marks.barred) lines.line(from, to, barred_color);
  for (const Vec3& point : marks.points) draw_cross(point, measure_color, lines);
  if (marks.box) {
    draw_edges(marks.box->box, lines);
    for (const GripMark& grip : marks.box->grips) draw_grip(grip, grips);
  }
  marks_->removeChildren(0, marks_->getNumChildren());
  grips_->removeChildren(0, grips_->getNumChildren());
  grips.add_to(*grips_);
  faces.add_to(*marks_);
  lines.add_to(*marks_);
}

}  // namespace roam::graphics
