#pragma once
/// \file
/// The sun: its shadows, its glints, and how bright it is beside the lamp at the eye.
///
/// Shadow maps lie in one texture, from fine about the eye to coarse for the whole scene, up to 512 m from the eye. A
/// map moves by whole texels and is drawn only when it moves or the scene changes, so shadows do not tremble. A drawn
/// map draws the scene within it once more: none in most frames, one a frame while the detail follows the eye, up to
/// four where the scene grows or is cut. Its projection is parallel; nodes whose detail depends on the eye must draw
/// there as they were drawn last. Surfaces without normals that are textured (photogrammetry) cast shadows and get
/// none; blended surfaces cast none.
///
///     roam::graphics::Sun sun(frame, *scene);
///     sun.set_outdoors(0.0);   // under a roof: between two frames

#include <cstdint>
#include <functional>
#include <osg/Group>
#include <osg/ref_ptr>

#include "graphics/frame.h"

namespace roam::graphics {

/// Lights a scene. Use it from the thread that calls viewer.frame(), between frames. Destroy it before the frame.
class Sun {
 public:
  /// `scene`: from make_scene_group(), below frame.space().
  Sun(Frame& frame, osg::Group& scene);
  ~Sun();  ///< the scene is lit as without it
  Sun(const Sun&) = delete;
  Sun& operator=(const Sun&) = delete;

  /// The share of the sky that the eye sees, in [0, 1]; 1 at first. Frames with shadows have a brighter lamp at the eye
  /// and a weaker sun the smaller it is.
  void set_outdoors(double share);
  /// Whether frames of Quality::full have shadows; true at first. With and without, surfaces are brighter where they
  /// face the sun, and smooth ones mirror it.
  void set_shadows(bool shown);
  /// `version` is called in each frame with shadows. When it returns another number, a little of the scene has changed:
  /// each frame draws one map anew, in turn, until all have been. Without it, only changes of the scene's bounds,
  /// direct children and section are seen, which draw all at once; so does the first frame with shadows after one
  /// without.
  void watch(std::function<std::uint64_t()> version);

 private:
  class Maps;
  osg::ref_ptr<osg::Group> root_;
  osg::ref_ptr<Maps> maps_;
};

}  // namespace roam::graphics
