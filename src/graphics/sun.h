#pragma once
/// \file
/// The sun: its shadows, its glints, and how bright it is beside the lamp at the eye.
///
/// Shadow maps lie in one texture, from fine about the eye to coarse for the whole scene, up to 512 m from the eye. A
/// map moves by whole texels and is drawn only when it moves or the scene changes, so shadows do not tremble and a
/// frame usually draws none. Surfaces without normals that are textured (photogrammetry) cast shadows and get none;
/// blended surfaces cast none.
///
///     roam::graphics::Sun sun(frame, *scene);
///     sun.set_outdoors(0.0);   // under a roof: between two frames

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
  /// Whether frames of Quality::full have shadows; true at first. They suit scenes whose detail does not depend on the
  /// eye: else a coarse shadow may lie on a fine surface. With and without, surfaces are brighter where they face the
  /// sun, and smooth ones mirror it.
  void set_shadows(bool shown);

 private:
  class Maps;
  osg::ref_ptr<osg::Group> root_;
  osg::ref_ptr<Maps> maps_;
};

}  // namespace roam::graphics
