#include "graphics/shading.h"

#include <osg/BlendFunc>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Program>
#include <osg/StateSet>
#include <osg/Uniform>
#include <string>

#include "graphics/frame.h"
#include "text/number.h"

namespace roam::graphics {
namespace {

constexpr const char* scene_vertex = R"(
#pragma import_defines(ROAM_SECTION, ROAM_SUN)
varying vec3 roam_position;
varying vec3 roam_normal;
varying vec4 roam_surface;
#if defined(ROAM_SECTION) || defined(ROAM_SUN)
uniform mat4 osg_ViewMatrixInverse;
varying vec4 roam_place;
#endif
void main() {
  vec4 eye = gl_ModelViewMatrix * gl_Vertex;
  roam_position = eye.xyz;
#if defined(ROAM_SECTION) || defined(ROAM_SUN)
  roam_place = osg_ViewMatrixInverse * eye;
#endif
  roam_normal = gl_NormalMatrix * gl_Normal;
  // Many models have each wall twice, front and back, at one place. The one that faces the eye is to be seen, so the
  // other yields by more than depths are inexact: along the line of sight, which moves nothing in the picture.
  if (dot(roam_normal, eye.xyz) > 0.0) eye.xyz *= 1.00005;
  roam_surface = gl_Color;
  gl_TexCoord[0] = gl_TextureMatrix[0] * gl_MultiTexCoord0;
  gl_Position = roam_clip(eye);
}
)";

// Without shadows the terms of the light add up to 1 on a floor before the eye. Walls get about 0.7, a ceiling 0.6, and
// the dark end of a long corridor 0.4. With shadows (sun.h) rooms get the same, and sun through windows; outdoors the
// lamp, and the sun that shines on all sides, give way to the sun. The brightest tones are compressed, so that white
// surfaces keep their shape.
constexpr const char* scene_fragment = R"(
#pragma import_defines(ROAM_TEXTURED, ROAM_BLENDED, ROAM_CUT, ROAM_SECTION, ROAM_SUN)
varying vec3 roam_position;
varying vec3 roam_normal;
varying vec4 roam_surface;
uniform mat4 osg_ViewMatrix;
uniform sampler2D roam_picture;
#ifdef ROAM_CUT
uniform float roam_cutoff;
#endif
#ifdef ROAM_SECTION
uniform vec4 roam_section[ROAM_SECTION];
#endif
#if defined(ROAM_SECTION) || defined(ROAM_SUN)
varying vec4 roam_place;
#endif
#ifdef ROAM_SUN
uniform sampler2DShadow roam_shadow;
uniform mat4 roam_sun_map;                // from the graph to metres across the light, and depth
uniform vec4 roam_sun_tiles[ROAM_SUN];    // centre, half of the side, side of a texel: metres across the light
uniform float roam_outdoors;
#endif

const vec3 ambient = vec3(0.245, 0.26, 0.29);
const vec3 sky = vec3(0.15, 0.16, 0.18);
const vec3 sunlight = vec3(0.36, 0.34, 0.31);
const vec3 lamp = vec3(0.32, 0.30, 0.255);
const float lamp_reach = 14.0;

const vec3 haze = vec3(0.63, 0.67, 0.71);
const float haze_reach = 10000.0;
const float most_haze = 0.6;
const float knee = 0.6;  // darker tones are kept

#ifdef ROAM_SUN
const vec3 day_ambient = vec3(0.25, 0.265, 0.30);
const vec3 day_sky = vec3(0.19, 0.21, 0.25);
const vec3 day_sun = vec3(0.58, 0.55, 0.48);
const vec3 window_sun = vec3(0.45, 0.42, 0.36);
const float round_by_day = 0.45;
const float lamp_by_day = 0.2;

// The share of the sun that a surface gets, from the finest map that has it; which that is is noisy at a map's border,
// so that the border is not seen. The map is read from a point off the surface, so that no texel shadows itself. It is
// read outside of all branches, because drivers without a card run every branch: the mean of four comparisons, each of
// which the driver smooths over four texels.
float sunlit(vec3 normal) {
  const float texel = 0.5 / roam_sun_side;  // of a texture of 2 x 2 maps
  const float off = 1.8, apart = 0.75;      // texels
  vec3 at = (roam_sun_map * vec4(roam_place.xyz, 1.0)).xyz;
  vec3 out_of = mat3(roam_sun_map) * (normal * mat3(osg_ViewMatrix));
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  vec3 place = vec3(0.0);
  float known = 0.0;
  for (int i = ROAM_SUN - 1; i >= 0; --i) {
    vec4 tile = roam_sun_tiles[i];
    vec3 here = at + off * tile.w * out_of;
    vec2 within = (here.xy - tile.xy) / tile.z;
    vec2 corner = vec2(mod(float(i), 2.0), floor(0.5 * float(i)));
    bool inside = max(abs(within.x), abs(within.y)) < 0.88 + 0.1 * noise;
    place = inside ? vec3((0.5 * within + 0.5 + corner) * 0.5, here.z) : place;
    known = inside ? 1.0 : known;
  }
  vec2 by = vec2(apart * texel, -apart * texel);
  float light = shadow2D(roam_shadow, place + vec3(by.xx, 0.0)).r + shadow2D(roam_shadow, place + vec3(by.xy, 0.0)).r +
                shadow2D(roam_shadow, place + vec3(by.yx, 0.0)).r + shadow2D(roam_shadow, place + vec3(by.yy, 0.0)).r;
  return mix(roam_outdoors, 0.25 * light, known);
}
#endif

// Without shadows the sun shines round every corner.
vec3 lit(vec3 normal, vec3 view, float distance) {
  vec3 up = osg_ViewMatrix[2].xyz;
  float towards_sun = dot(normal, mat3(osg_ViewMatrix) * roam_sun);
  float fall_off = 1.0 / (1.0 + distance * distance / (lamp_reach * lamp_reach));
  float round_corners = (0.5 + 0.5 * towards_sun) * (0.5 + 0.5 * towards_sun);
  float above = 0.5 + 0.5 * dot(normal, up);
  vec3 by_lamp = lamp * dot(normal, view) * fall_off;
#ifdef ROAM_SUN
  float day = roam_outdoors;
  float shone = towards_sun > 0.0 ? sunlit(normal) : 0.0;
  return mix(ambient, day_ambient, day) + mix(sky, day_sky, day) * above + by_lamp * mix(1.0, lamp_by_day, day) +
         sunlight * round_corners * mix(1.0, round_by_day, day) +
         mix(window_sun, day_sun, day) * max(towards_sun, 0.0) * shone;
#else
  return ambient + sky * above + sunlight * round_corners + by_lamp;
#endif
}

vec3 toned(vec3 color) {
  float most = max(color.r, max(color.g, color.b));
  float over = max(most - knee, 0.0);
  float shown = most - over + (1.0 - knee) * (1.0 - exp(over / (knee - 1.0)));
  return color * (shown / max(most, 1e-4));
}

void main() {
#ifdef ROAM_SECTION
  for (int i = 0; i < ROAM_SECTION; ++i) {
    if (dot(roam_section[i], roam_place) > 0.0) discard;
  }
#endif
  vec4 color = roam_surface;
#ifdef ROAM_TEXTURED
  color *= texture2D(roam_picture, gl_TexCoord[0].st);
#endif
#ifdef ROAM_CUT
  if (color.a < roam_cutoff) discard;
#endif
  float distance = length(roam_position);
  vec3 view = -roam_position / max(distance, 1e-6);
  // A normal of length 0 says that the geometry has none.
  bool has_normal = dot(roam_normal, roam_normal) > 1e-6;
  vec3 normal = has_normal ? roam_normal : cross(dFdx(roam_position), dFdy(roam_position));
  float size = length(normal);
  normal = size > 0.0 ? normal / size : view;
  if (dot(normal, view) < 0.0) normal = -normal;
  vec3 light = lit(normal, view, distance);
  float shade = 1.0;  // the share of later effects that this surface takes
  vec3 seen = toned(color.rgb * light);
#ifdef ROAM_TEXTURED
  if (!has_normal) {
    seen = color.rgb;
    shade = 0.0;
  }
#endif
  float square = distance * distance;
  float hazed = most_haze * square / (square + haze_reach * haze_reach);
#ifdef ROAM_BLENDED
  shade = color.a;
#endif
  gl_FragColor = vec4(mix(seen, haze, hazed), shade);
}
)";

constexpr const char* sky_vertex = R"(#version 120
varying vec3 roam_direction;
void main() {
  gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0);
  // The view may be a part of a picture, beside its middle.
  vec2 at = gl_Vertex.xy + gl_ProjectionMatrix[2].xy;
  roam_direction = vec3(at.x / gl_ProjectionMatrix[0][0], at.y / gl_ProjectionMatrix[1][1], -1.0);
}
)";

// Grey enough to show both white and black. Noise of half a step of 8 bit hides bands.
constexpr const char* sky_fragment = R"(#version 120
varying vec3 roam_direction;
uniform mat4 osg_ViewMatrix;
const vec3 zenith = vec3(0.30, 0.38, 0.48);
const vec3 horizon = vec3(0.63, 0.67, 0.71);
const vec3 edge = vec3(0.53, 0.55, 0.56);
const vec3 nadir = vec3(0.23, 0.23, 0.24);
void main() {
  float height = dot(normalize(roam_direction), osg_ViewMatrix[2].xyz);
  vec3 above = mix(horizon, zenith, pow(clamp(height, 0.0, 1.0), 0.55));
  vec3 below = mix(edge, nadir, pow(clamp(-height, 0.0, 1.0), 0.6));
  vec3 color = mix(below, above, smoothstep(-0.02, 0.005, height));
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  gl_FragColor = vec4(color + (noise - 0.5) / 255.0, 0.0);
}
)";

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
  state.setAttribute(make_program("roam scene", std::string(depth_glsl()) + scene_vertex, sun_glsl() + scene_fragment));
  state.addUniform(new osg::Uniform("roam_picture", 0));
  state.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
  return group;
}

void set_section(osg::Group& scene, std::span<const SectionPlane> planes) {
  constexpr const char* define = "ROAM_SECTION";
  constexpr const char* name = "roam_section";
  osg::StateSet& state = *scene.getOrCreateStateSet();
  state.removeUniform(name);
  if (planes.empty()) {
    state.removeDefine(define);
    return;
  }
  osg::ref_ptr<osg::Uniform> values = new osg::Uniform(osg::Uniform::FLOAT_VEC4, name, static_cast<int>(planes.size()));
  for (unsigned i = 0; i < planes.size(); ++i) {
    const auto& [normal, distance] = planes[i];
    values->setElement(i, osg::Vec4(osg::Vec3d(normal.x, normal.y, normal.z), static_cast<float>(-distance)));
  }
  state.addUniform(values);
  state.setDefine(define, std::to_string(planes.size()));
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
  state.setAttribute(make_program("roam sky", sky_vertex, sky_fragment));
  state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  state.setRenderBinDetails(-100, "RenderBin");
  osg::ref_ptr<osg::Geode> sky = new osg::Geode;
  sky->setName("sky");
  sky->addDrawable(all);
  sky->setCullingActive(false);
  return sky;
}

}  // namespace roam::graphics
