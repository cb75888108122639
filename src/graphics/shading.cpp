#include "graphics/shading.h"

#include <osg/BlendFunc>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Program>
#include <osg/StateSet>
#include <osg/Uniform>
#include <string>

#include "graphics/frame.h"

namespace roam::graphics {
namespace {

constexpr const char* scene_vertex = R"(
#pragma import_defines(ROAM_SECTION)
varying vec3 roam_position;
varying vec3 roam_normal;
varying vec4 roam_surface;
#ifdef ROAM_SECTION
uniform mat4 osg_ViewMatrixInverse;
varying vec4 roam_place;
#endif
void main() {
  vec4 eye = gl_ModelViewMatrix * gl_Vertex;
  roam_position = eye.xyz;
#ifdef ROAM_SECTION
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

// The terms of the light add up to 1 on a floor before the eye. Walls get about 0.7, a ceiling 0.6, and the dark end of
// a long corridor 0.4. The brightest tones are compressed, so that white surfaces keep their shape.
constexpr const char* scene_fragment = R"(#version 120
#pragma import_defines(ROAM_TEXTURED, ROAM_BLENDED, ROAM_CUT, ROAM_SECTION, ROAM_GLOSS)
varying vec3 roam_position;
varying vec3 roam_normal;
varying vec4 roam_surface;
uniform mat4 osg_ViewMatrix;
uniform sampler2D roam_picture;
#ifdef ROAM_CUT
uniform float roam_cutoff;
#endif
#ifdef ROAM_GLOSS
uniform vec2 roam_gloss;  // roughness, metalness
#endif
#ifdef ROAM_SECTION
uniform vec4 roam_section[ROAM_SECTION];
varying vec4 roam_place;
#endif

const vec3 sun = vec3(0.48, -0.36, 0.80);
const vec3 ambient = vec3(0.245, 0.26, 0.29);
const vec3 sky = vec3(0.15, 0.16, 0.18);
const vec3 sunlight = vec3(0.36, 0.34, 0.31);
const vec3 lamp = vec3(0.32, 0.30, 0.255);
const float lamp_reach = 14.0;

const vec3 haze = vec3(0.63, 0.67, 0.71);
const float haze_reach = 10000.0;
const float most_haze = 0.6;
const float knee = 0.6;  // darker tones are kept

vec3 lit(vec3 normal, vec3 view, float distance) {
  vec3 up = osg_ViewMatrix[2].xyz;
  vec3 to_sun = mat3(osg_ViewMatrix) * sun;
  float fall_off = 1.0 / (1.0 + distance * distance / (lamp_reach * lamp_reach));
  float towards_sun = 0.5 + 0.5 * dot(normal, to_sun);
  return ambient + sky * (0.5 + 0.5 * dot(normal, up)) + sunlight * towards_sun * towards_sun +
         lamp * dot(normal, view) * fall_off;
}

#ifdef ROAM_GLOSS
// Dielectrics mirror 4 % of the light, metals their own colour (Fresnel's law after Schlick). What is mirrored: bright
// above, dark below, and the sun; rough surfaces mirror the mean light instead.
vec3 glossy(vec3 color, vec3 light, vec3 normal, vec3 view) {
  float rough = roam_gloss.x, metal = roam_gloss.y, sharp = 1.0 - rough;
  vec3 mirrored = reflect(-view, normal);
  vec3 share = mix(vec3(0.04), color, metal);
  share += (max(vec3(sharp), share) - share) * pow(1.0 - max(dot(normal, view), 0.0), 5.0);
  float blur = 0.08 + 0.6 * rough;
  float up = smoothstep(-blur, blur, dot(mirrored, osg_ViewMatrix[2].xyz));
  vec3 around = mix(mix(vec3(0.30, 0.31, 0.33), vec3(1.05, 1.08, 1.12), up), light, rough * rough);
  float glint = pow(max(dot(mirrored, mat3(osg_ViewMatrix) * sun), 0.0), mix(4.0, 180.0, sharp * sharp)) * sharp;
  return color * (1.0 - metal) * light + share * (around + 1.5 * glint);
}
#endif

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
#ifdef ROAM_GLOSS
  vec3 seen = toned(glossy(color.rgb, light, normal, view));
#else
  vec3 seen = toned(color.rgb * light);
#endif
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
  roam_direction = vec3(gl_Vertex.x / gl_ProjectionMatrix[0][0], gl_Vertex.y / gl_ProjectionMatrix[1][1], -1.0);
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

void apply(const Surface& surface, osg::StateSet& state) {
  if (surface.textured) state.setDefine(textured_define);
  if (surface.cutoff) {
    state.setDefine("ROAM_CUT");
    state.addUniform(new osg::Uniform("roam_cutoff", *surface.cutoff));
  }
  if (surface.gloss) {
    state.setDefine("ROAM_GLOSS");
    state.addUniform(new osg::Uniform("roam_gloss", osg::Vec2(surface.gloss->roughness, surface.gloss->metalness)));
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
  state.setAttribute(make_program("roam scene", std::string(depth_glsl()) + scene_vertex, scene_fragment));
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
