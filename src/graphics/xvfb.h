#pragma once
/// \file
/// An X server that has no screen, started for us.

#include <memory>
#include <osg/Referenced>

#include "process/child.h"

namespace roam::graphics {

/// Runs Xvfb for as long as it exists, or as the thread that made it.
class Xvfb : public osg::Referenced {
 public:
  /// A screen of `width` x `height` pixels. Throws roam::Error when Xvfb is not there or does not come up.
  Xvfb(int width, int height);

  [[nodiscard]] int display() const { return display_; }  ///< N of ":N"
  [[nodiscard]] pid_t pid() const { return process_->id(); }

 private:
  std::unique_ptr<process::Child> process_;
  int display_ = -1;
};

}  // namespace roam::graphics
