#pragma once
/// \file
/// A scene and a profile of it with all members.

#include <functional>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/profile.h"

namespace made {

/// A room of two triangles, far from the origin.
inline std::vector<roam::Mesh> scene() {
  roam::Mesh mesh;
  mesh.vertices = {{-13739.1, 253.0, 182.0}, {-13730.0, 253.3, 182.0}, {-13730.0, 260.0, 182.7}, {0.1, 0.2, -0.0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return {mesh};
}

inline roam::Profile full_profile() {
  roam::Profile p;
  p.scene = roam::identity_of(scene());
  p.radius = 0.1 + 0.2;  // no round number of digits
  p.height = 1.8;
  p.support_radius = 0.45;
  p.step = 0.25;
  p.slope_degrees = 50.0;
  p.largest = 1.0 / 3.0;
  p.smallest = 0.125;
  p.regions = {{{{-1.0, -2.0, -3.0}, {1.0, 2.0, 1.0 / 7.0}}, 0.2, 0.0, "door 0.41 m wide"},
               {{{5.0, 5.0, 0.0}, {6.0, 6.0, 2.0}}, 0.3, 0.7, "a \"split\" \xE2\x80\x93 1.3 m"}};
  p.method = "paper";
  p.complete = false;
  return p;
}

/// The error message of a use that fails; empty if it succeeds.
inline std::string complaint(const std::function<void()>& use) {
  try {
    use();
  } catch (const roam::Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace made
