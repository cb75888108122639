#pragma once
/// A person who stands on a plain, for the tests of keys and of time.

#include "osg_rig.h"

namespace rig {

/// A floor of 400 m by 400 m.
inline scenes::Mesh plain() {
  scenes::Mesh m;
  scenes::add_floor(m, -200.0, -200.0, 200.0, 200.0, 0.0);
  return m;
}

/// A person at the origin of a plain who looks along +x.
struct Standing : Rig {
  explicit Standing(roam::Mode mode = roam::Mode::walk) : Rig(plain(), {}, mode) {
    manipulator->setFeet({0.0, 0.0, mode == roam::Mode::walk ? 0.0 : 5.0}, 0.0, 0.0);
    frames(0.5);
  }
  [[nodiscard]] roam::Vec3 at() const { return manipulator->walker()->position(); }
};

}  // namespace rig
