#pragma once
/// \file
/// A child process with an X server that has no screen.

#include <memory>
#include <osg/Referenced>

#include "process/child.h"

namespace roam::graphics {

/// Runs Xvfb for the life of the object. It also ends with this process, even if that crashes.
class Xvfb : public osg::Referenced {
 public:
  /// A screen of `width` x `height` pixels. Throws roam::Error if Xvfb is not installed or does not start.
  /// `resets`: it begins anew when its last client leaves, as a person's own server may.
  Xvfb(int width, int height, bool resets = false);

  [[nodiscard]] int display() const { return display_; }  ///< N of ":N"
  [[nodiscard]] pid_t pid() const { return process_->id(); }

 private:
  std::unique_ptr<process::Child> process_;
  int display_ = -1;
};

}  // namespace roam::graphics
