#include "graphics/composite_shaders.h"

namespace roam::graphics {

const char* const cover_vertex_glsl = R"(#version 120
void main() { gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0); }
)";

const char* const picture_glsl = R"(#version 120
uniform vec2 roam_size;         // pixels of the picture
uniform vec2 roam_tangents;     // of half the fields of view
uniform vec2 roam_shift;        // of the middle of the view, in halves of the picture
uniform vec2 roam_depth_scale;  // near / distance = x + y * depth
uniform float roam_near;        // metres
uniform sampler2D roam_depth;

float depth_at(vec2 pixel) {
  return roam_depth_scale.x + roam_depth_scale.y * texture2D(roam_depth, pixel / roam_size).r;
}
vec2 ray_through(vec2 pixel) { return (2.0 * pixel / roam_size - 1.0 + roam_shift) * roam_tangents; }
// The angle of a pixel in the middle of the picture.
float pixel_angle() { return 2.0 * roam_tangents.y / roam_size.y; }
)";

// Horizon-like occlusion by twelve neighbours on a spiral, which turns from pixel to pixel in blocks of 4 x 4.
const char* const occlusion_glsl = R"(
const float least_radius = 0.7;      // metres
const float radius_share = 0.05;     // of the distance, for what is far
uniform float roam_reach;            // most pixels
const float bias = 0.06;             // sine of the angle below which nothing occludes
const float strength = 1.9;

vec3 place_at(vec2 pixel, float depth) {
  return vec3(ray_through(pixel), 1.0) * (roam_near / depth);
}

float smaller(float a, float b) { return abs(a) < abs(b) ? a : b; }

void main() {
  vec2 pixel = 2.0 * floor(gl_FragCoord.xy) + 0.5;
  float depth = depth_at(pixel);
  float distance = roam_near / max(depth, 1e-9);
  float radius = max(least_radius, radius_share * distance);
  float reach = min(radius / (distance * pixel_angle()), roam_reach);
  vec3 place = place_at(pixel, max(depth, 1e-9));

  float right = depth_at(pixel + vec2(1.0, 0.0)) - depth, up = depth_at(pixel + vec2(0.0, 1.0)) - depth;
  float left = pixel.x < 1.0 ? right : depth - depth_at(pixel - vec2(1.0, 0.0));
  float down = pixel.y < 1.0 ? up : depth - depth_at(pixel - vec2(0.0, 1.0));
  if (pixel.x + 1.0 > roam_size.x) right = left;
  if (pixel.y + 1.0 > roam_size.y) up = down;
  vec2 slope = vec2(smaller(left, right), smaller(down, up)) * roam_size / (2.0 * roam_tangents);
  vec3 normal = -normalize(vec3(slope, depth - dot(slope, ray_through(pixel))));

  vec2 cell = mod(floor(gl_FragCoord.xy), 4.0);
  float turn = 6.2831853 * fract(0.0625 * (4.0 * cell.x + cell.y) + 0.25 * cell.y);
  float shift = fract(0.25 * cell.x + 0.3125 * cell.y);
  mat2 rotation = mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
  float hidden = 0.0;
  for (int i = 0; i < 12; ++i) {
    float share = (float(i) + 0.2 + 0.8 * shift) / 12.0;
    float angle = 2.3999632 * float(i);
    vec2 at = floor(pixel + rotation * vec2(cos(angle), sin(angle)) * (share * reach + 1.0)) + 0.5;
    at = clamp(at, vec2(0.5), roam_size - 0.5);
    vec3 to = place_at(at, max(depth_at(at), 1e-9)) - place;
    float square = dot(to, to);
    float sine = dot(to, normal) * inversesqrt(square + 1e-12);
    hidden += max(sine - bias, 0.0) * max(1.0 - square / (radius * radius), 0.0);
  }
  float light = depth > 0.0 && reach > 1.5 ? clamp(1.0 - strength * hidden / 12.0, 0.0, 1.0) : 1.0;
  gl_FragColor = vec4(light, depth, 0.0, 1.0);
}
)";

// Averages the block of turns. Pixels off the plane of the middle one do not count.
const char* const blur_glsl = R"(
uniform sampler2D roam_occlusion;
void main() {
  vec2 half_size = ceil(0.5 * roam_size);
  vec2 middle = texture2D(roam_occlusion, gl_FragCoord.xy / half_size).rg;
  vec2 slope = vec2(dFdx(middle.g), dFdy(middle.g));
  float tolerance = max(middle.g, 1e-9) * 0.02;
  slope = clamp(slope, vec2(-4.0 * tolerance), vec2(4.0 * tolerance));
  vec2 sum = vec2(middle.r, 1.0) * 0.01;
  for (int x = -2; x < 2; ++x) {
    for (int y = -2; y < 2; ++y) {
      vec2 by = vec2(float(x), float(y));
      vec2 seen = texture2D(roam_occlusion, (gl_FragCoord.xy + by) / half_size).rg;
      float off = abs(seen.g - middle.g - dot(slope, by));
      sum += vec2(seen.r, 1.0) * clamp(2.0 - off / tolerance, 0.0, 1.0);
    }
  }
  gl_FragColor = vec4(sum.x / sum.y, middle.g, 0.0, 1.0);
}
)";

const char* const mix_glsl = R"(
#pragma import_defines(ROAM_OCCLUSION, ROAM_EDGES, ROAM_SMOOTHING)
uniform sampler2D roam_color;
uniform sampler2D roam_occlusion;

const vec3 shade = vec3(0.05, 0.055, 0.075);  // the colour of full occlusion: not quite black
const float outline = 0.30;                   // darkest line at an outline or convex edge
const float crease = 0.10;                    // and in a concave one
// Metres a pixel: lines fade out between these, bends first, because far terrain is full of them.
const float finest = 0.012, coarsest_bend = 0.15, coarsest_step = 0.2, coarsest_end = 0.25;

float occlusion_at(float depth) {
  vec2 half_size = ceil(0.5 * roam_size);
  vec2 at = 0.5 * (gl_FragCoord.xy - 0.5);
  vec2 corner = floor(at);
  vec2 share = at - corner;
  float sum = 1e-4, weights = 1e-4;
  for (int x = 0; x < 2; ++x) {
    for (int y = 0; y < 2; ++y) {
      vec2 to = vec2(float(x), float(y));
      vec2 seen = texture2D(roam_occlusion, (corner + to + 0.5) / half_size).rg;
      vec2 near = mix(1.0 - share, share, to);
      float weight = (near.x * near.y + 0.01) / (0.01 + abs(seen.g - depth) / max(depth, 1e-9));
      sum += weight * seen.r;
      weights += weight;
    }
  }
  return sum / weights;
}

float fading(float pixel_size, float most) { return 1.0 - smoothstep(finest, most, pixel_size); }

// How dark a bend of the surface from slope a to slope b is drawn: x if it is convex, y if it is concave.
vec2 drawn(float a, float b) {
  float sine = (b - a) * inversesqrt((1.0 + a * a) * (1.0 + b * b));
  return smoothstep(0.3, 0.75, vec2(-sine, sine));
}

// The edge between a pixel and the next: `middle` is the slope between them, `next` that beyond, `last` that before.
// A bend lies where the middle slope is the mean of the two beside it, and each pixel has its share of the line: drawn
// whole in the pixel that bends most, slanting lines would be dotted. At a step, the pixel before it has the line.
vec2 edge(float last, float middle, float next, float pixel_size) {
  float beyond = max(middle - max(last, next), min(last, next) - middle);
  if (beyond > 0.5) return drawn(last, middle) * fading(pixel_size, coarsest_step);
  float share = clamp((last - middle) / (last - next), 0.0, 1.0);
  return last == next ? vec2(0.0) : drawn(last, next) * share * fading(pixel_size, coarsest_bend);
}

// Lines across one direction, as above.
vec2 lines(vec2 pixel, vec2 to, float here, float pixel_size) {
  float before = depth_at(pixel - to), after = depth_at(pixel + to);
  // Surfaces go on straight beyond the picture.
  if (any(lessThan(pixel - to, vec2(0.0)))) before = 2.0 * here - after;
  if (any(greaterThan(pixel + to, roam_size))) after = 2.0 * here - before;
  float first = depth_at(pixel - 2.0 * to), last = depth_at(pixel + 2.0 * to);
  if (any(lessThan(pixel - 2.0 * to, vec2(0.0)))) first = 2.0 * before - here;
  if (any(greaterThan(pixel + 2.0 * to, roam_size))) last = 2.0 * after - here;
  float scale = 1.0 / (max(here, 1e-9) * pixel_angle());
  float a = (before - first) * scale, b = (here - before) * scale;
  float c = (after - here) * scale, d = (last - after) * scale;
  // Along a surface that is seen at a low angle, a pixel is long.
  float long_pixel = pixel_size * sqrt(1.0 + min(b * b, c * c));
  vec2 found = max(edge(b, c, d, long_pixel), edge(-c, -b, -a, long_pixel));
  // There a far step is a small angle too, which varies from pixel to pixel.
  float jump = (2.0 * here - before - after) / max(here, 1e-9);
  found.x = max(found.x, smoothstep(0.08, 0.16, jump) * fading(pixel_size, coarsest_end));
  return found;
}

void main() {
  vec4 color = texture2D(roam_color, gl_FragCoord.xy / roam_size);
  vec2 pixel = gl_FragCoord.xy;
  float depth = depth_at(pixel);
#ifdef ROAM_OCCLUSION
  float light = mix(1.0, occlusion_at(depth), color.a);
  color.rgb = mix(shade * color.rgb, color.rgb, light);
#endif
#ifdef ROAM_EDGES
  float pixel_size = roam_near * pixel_angle() / max(depth, 1e-9);
  vec2 found = max(lines(pixel, vec2(1.0, 0.0), depth, pixel_size), lines(pixel, vec2(0.0, 1.0), depth, pixel_size));
  float line = color.a * max(outline * found.x, crease * found.y);
  color.rgb *= 1.0 - line;
#endif
#ifdef ROAM_SMOOTHING
  gl_FragColor = vec4(color.rgb, dot(color.rgb, vec3(0.299, 0.587, 0.114)));
#else
  gl_FragColor = vec4(color.rgb, 1.0);
#endif
}
)";

// Blends across the direction of the steepest brightness; its alpha is the brightness of a pixel.
const char* const smooth_glsl = R"(
uniform sampler2D roam_color;
void main() {
  vec2 texel = 1.0 / roam_size;
  vec2 at = gl_FragCoord.xy * texel;
  vec4 middle = texture2D(roam_color, at);
  float nw = texture2D(roam_color, at + texel * vec2(-0.5, 0.5)).a;
  float ne = texture2D(roam_color, at + texel * vec2(0.5, 0.5)).a;
  float sw = texture2D(roam_color, at + texel * vec2(-0.5, -0.5)).a;
  float se = texture2D(roam_color, at + texel * vec2(0.5, -0.5)).a;
  float least = min(middle.a, min(min(nw, ne), min(sw, se)));
  float most = max(middle.a, max(max(nw, ne), max(sw, se)));
  vec2 along = vec2(sw + se - nw - ne, nw + sw - ne - se);
  float small = max((nw + ne + sw + se) * 0.03, 0.008);
  along = clamp(along / (min(abs(along.x), abs(along.y)) + small), -8.0, 8.0) * texel;
  vec3 narrow = 0.5 * (texture2D(roam_color, at - along / 6.0).rgb + texture2D(roam_color, at + along / 6.0).rgb);
  vec4 far = texture2D(roam_color, at - 0.5 * along) + texture2D(roam_color, at + 0.5 * along);
  vec3 wide = 0.5 * narrow + 0.25 * far.rgb;
  float brightness = dot(wide, vec3(0.299, 0.587, 0.114));
  vec3 color = brightness < least || brightness > most ? narrow : wide;
  bool flat_here = most - least < max(0.035, 0.09 * most);
  gl_FragColor = vec4(flat_here ? middle.rgb : color, 1.0);
}
)";

}  // namespace roam::graphics
