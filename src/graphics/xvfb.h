#pragma once
/// \file
/// A child process with an X server that has no screen.

#include <array>
#include <memory>
#include <osg/Referenced>
#include <string>

#include "files/descriptor.h"
#include "process/child.h"

namespace roam::graphics {

/// Runs Xvfb for the life of the object. It also ends with this process, even if that crashes. Only programs of the
/// same user may connect to it: those that know its cookie.
class Xvfb : public osg::Referenced {
 public:
  /// A screen of `width` x `height` pixels. Throws roam::Error if Xvfb is not installed or does not start.
  /// `resets`: it begins anew when its last client leaves, as a person's own server may.
  Xvfb(int width, int height, bool resets = false);

  [[nodiscard]] int display() const { return display_; }  ///< N of ":N"
  /// Lets this process connect to it, and to no other server that demands a cookie.
  void authorize() const;
  /// For the environment variable XAUTHORITY of other programs: a file as of xauth(1), as long as the object lives.
  [[nodiscard]] std::string authority() const;
  [[nodiscard]] pid_t pid() const { return process_->id(); }

 private:
  std::array<unsigned char, 16> cookie_{};
  files::Descriptor authority_;
  std::unique_ptr<process::Child> process_;
  int display_ = -1;
};

}  // namespace roam::graphics
