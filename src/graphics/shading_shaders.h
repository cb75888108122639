#pragma once
/// \file
/// The shaders of scenes and of the sky.

namespace roam::graphics {

/// After depth_glsl().
extern const char* const scene_vertex_glsl;
/// After a head that states the version, `roam_sun` (towards the sun) and `roam_sun_side` (texels of a map of shadows).
extern const char* const scene_fragment_glsl;
extern const char* const sky_vertex_glsl;
extern const char* const sky_fragment_glsl;

}  // namespace roam::graphics
