#pragma once
/// \file
/// GLSL 1.20 of the passes of a Composite.

namespace roam::graphics {

/// One triangle over the whole picture.
extern const char* const cover_vertex_glsl;
/// Uniforms and functions that all passes share; comes first.
extern const char* const picture_glsl;
extern const char* const occlusion_glsl;
extern const char* const blur_glsl;
extern const char* const mix_glsl;
extern const char* const smooth_glsl;

}  // namespace roam::graphics
