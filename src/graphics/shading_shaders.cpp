#include "graphics/shading_shaders.h"

namespace roam::graphics {

const char* const scene_vertex_glsl = R"(
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

// Without Sun (sun.h) the terms of the light add up to 1 on a floor before the eye. Walls get about 0.7, a ceiling 0.6,
// and the dark end of a long corridor 0.4. In full pictures rooms get the same, and sun through windows; outdoors the
// lamp, and the sun that shines on all sides, give way to the sun. The brightest tones are compressed, so that white
// surfaces keep their shape.
const char* const scene_fragment_glsl = R"(
#pragma import_defines(ROAM_TEXTURED, ROAM_BLENDED, ROAM_CUT, ROAM_SECTION, ROAM_SUN)
#pragma import_defines(ROAM_FULL, ROAM_GLOSS, ROAM_GLOSS_IMAGE, ROAM_EMISSION, ROAM_EMISSION_IMAGE)
#if defined(ROAM_FULL) && defined(ROAM_GLOSS)
#define ROAM_MIRROR
#endif
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
#endif
#ifdef ROAM_FULL
uniform float roam_outdoors;
#endif
#ifdef ROAM_MIRROR
uniform vec2 roam_gloss;  // roughness, metalness
uniform sampler2D roam_gloss_image;
#endif
#ifdef ROAM_EMISSION
uniform vec3 roam_emission;
uniform sampler2D roam_emission_image;
#endif

const vec3 ambient = vec3(0.295, 0.30, 0.31);
const vec3 sky = vec3(0.135, 0.14, 0.15);
const vec3 sunlight = vec3(0.36, 0.34, 0.31);
const vec3 lamp = vec3(0.37, 0.325, 0.265);
const float lamp_reach = 14.0;

const vec3 haze = vec3(0.66, 0.73, 0.79);
const float haze_reach = 10000.0;
const float most_haze = 0.6;
const float knee = 0.6;  // darker tones are kept

#ifdef ROAM_FULL
const vec3 day_ambient = vec3(0.26, 0.28, 0.33);
const vec3 day_sky = vec3(0.17, 0.20, 0.25);
const vec3 day_sun = vec3(0.64, 0.56, 0.43);
const vec3 window_sun = vec3(0.45, 0.42, 0.36);
const float round_by_day = 0.45;
const float lamp_by_day = 0.2;
#endif

#ifdef ROAM_SUN
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

float fall_off(float distance) { return 1.0 / (1.0 + distance * distance / (lamp_reach * lamp_reach)); }

// Without Sun it shines round every corner. `shone`: the share of the sun that reaches the surface.
vec3 lit(vec3 normal, vec3 view, float distance, out float shone) {
  vec3 up = osg_ViewMatrix[2].xyz;
  float towards_sun = dot(normal, mat3(osg_ViewMatrix) * roam_sun);
  float round_corners = (0.5 + 0.5 * towards_sun) * (0.5 + 0.5 * towards_sun);
  float above = 0.5 + 0.5 * dot(normal, up);
  vec3 by_lamp = lamp * dot(normal, view) * fall_off(distance);
#ifdef ROAM_FULL
  float day = roam_outdoors;
#ifdef ROAM_SUN
  shone = towards_sun > 0.0 ? sunlit(normal) : 0.0;
#else
  shone = day;
#endif
  return mix(ambient, day_ambient, day) + mix(sky, day_sky, day) * above + by_lamp * mix(1.0, lamp_by_day, day) +
         sunlight * round_corners * mix(1.0, round_by_day, day) +
         mix(window_sun, day_sun, day) * max(towards_sun, 0.0) * shone;
#else
  shone = 1.0;
  return ambient + sky * above + sunlight * round_corners + by_lamp;
#endif
}

#ifdef ROAM_MIRROR
const vec3 lamp_glint = vec3(0.16, 0.15, 0.13);
const vec3 room_below = vec3(0.40, 0.39, 0.38), room_above = vec3(0.80, 0.80, 0.80);
const vec3 ground = vec3(0.42, 0.42, 0.42), low_sky = vec3(0.80, 0.84, 0.88), high_sky = vec3(0.40, 0.55, 0.76);

// The mirrored share of a light whose half angle to the normal has that cosine: distribution of Trowbridge and Reitz,
// visibility as in Karis (2014), relative to a white matt surface.
float glint(float cosine, float rough) {
  float square = rough * rough * rough * rough;
  float spread = cosine * cosine * (square - 1.0) + 1.0;
  return min(square / (spread * spread), 200.0) * (0.25 + 0.25 * rough);
}

// The light from a surface: its colour in the light, and what it mirrors (Fresnel's law after Schlick): dielectrics 4 %
// of the surroundings, metals their colour. Rough surfaces mirror the mean light, so that the roughest look matt.
vec3 mirroring(vec3 color, vec3 light, float shone, vec3 normal, vec3 view, float distance) {
  vec2 gloss = roam_gloss;
#ifdef ROAM_GLOSS_IMAGE
  gloss *= texture2D(roam_gloss_image, gl_TexCoord[0].st).ra;
#endif
  float rough = max(gloss.x, 0.08), metal = gloss.y;
  vec3 up = osg_ViewMatrix[2].xyz, sun = mat3(osg_ViewMatrix) * roam_sun;
  float facing = clamp(dot(normal, view), 0.0, 1.0);
  vec3 share = mix(vec3(0.04), color, metal);
  share += (max(vec3(1.0 - rough), share) - share) * pow(1.0 - facing, 5.0);

  float height = dot(reflect(-view, normal), up);
  float blur = 0.06 + 0.9 * rough;
  float above = smoothstep(-blur, blur, height);
  vec3 outdoors = mix(ground, mix(low_sky, high_sky, max(height, 0.0)), above);
  vec3 around = mix(mix(room_below, room_above, above), outdoors, roam_outdoors);
  float mean = rough * rough;
  around = mix(around, light, mean);

  float by_sun = glint(max(dot(normal, normalize(sun + view)), 0.0), rough) * max(dot(normal, sun), 0.0) * shone;
  // The lamp is large, so that no point of light follows the eye.
  float by_lamp = glint(facing, max(rough, 0.4)) * facing * fall_off(distance) * (1.0 - roam_outdoors);
  vec3 glints = (day_sun * by_sun + lamp_glint * by_lamp) * (1.0 - mean * mean);
  return color * (1.0 - metal) * (1.0 - share) * light + share * (around + glints);
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
  float shone;
  vec3 light = lit(normal, view, distance, shone);
  float shade = 1.0;  // the share of later effects that this surface takes
#ifdef ROAM_MIRROR
  vec3 seen = mirroring(color.rgb, light, shone, normal, view, distance);
#else
  vec3 seen = color.rgb * light;
#endif
#ifdef ROAM_EMISSION
  vec3 emission = roam_emission;
#ifdef ROAM_EMISSION_IMAGE
  emission *= texture2D(roam_emission_image, gl_TexCoord[0].st).rgb;
#endif
  seen += emission;
#endif
  seen = toned(seen);
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

const char* const sky_vertex_glsl = R"(#version 120
varying vec3 roam_direction;
void main() {
  gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0);
  // The view may be a part of a picture, beside its middle.
  vec2 at = gl_Vertex.xy + gl_ProjectionMatrix[2].xy;
  roam_direction = vec3(at.x / gl_ProjectionMatrix[0][0], at.y / gl_ProjectionMatrix[1][1], -1.0);
}
)";

// Neither so light that white things vanish nor so dark that black ones do. Noise of half a step of 8 bit hides bands.
const char* const sky_fragment_glsl = R"(#version 120
varying vec3 roam_direction;
uniform mat4 osg_ViewMatrix;
const vec3 zenith = vec3(0.25, 0.40, 0.62);
const vec3 horizon = vec3(0.66, 0.73, 0.79);
const vec3 edge = vec3(0.63, 0.67, 0.71);
const vec3 nadir = vec3(0.40, 0.42, 0.45);
void main() {
  float height = dot(normalize(roam_direction), osg_ViewMatrix[2].xyz);
  vec3 above = mix(horizon, zenith, pow(clamp(height, 0.0, 1.0), 0.55));
  vec3 below = mix(edge, nadir, pow(clamp(-height, 0.0, 1.0), 0.6));
  vec3 color = mix(below, above, smoothstep(-0.02, 0.005, height));
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  gl_FragColor = vec4(color + (noise - 0.5) / 255.0, 0.0);
}
)";

}  // namespace roam::graphics
