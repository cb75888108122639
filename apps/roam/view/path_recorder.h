#pragma once
/// \file
/// Writes the way of a session as a path file.

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "roam/walker.h"

namespace roam::app {

/// Writes osgViewer's lines `t x y z qx qy qz qw`: the time since the recording began, the body's centre in the scene's
/// frame, and the rotation of the camera; and the body, see recorded_body.h. What is written can be gone again by
/// `--path`. Each line is on disk when it has been written.
class PathRecorder {
 public:
  /// Begins a file, and says the body in it; what was there is replaced. Throws roam::Error when it cannot be written.
  PathRecorder(std::filesystem::path file, const WalkerSettings& body, Mode mode);

  /// Where the body is at `time` (s, never less than the time before). Writes when a tenth of a second has passed since
  /// the last line and something moved.
  void add(double time, const Vec3& position, const std::array<double, 4>& rotation, Mode mode);
  /// Writes where it ends. Throws roam::Error when not everything could be written.
  void close();

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] double seconds() const { return last_.time - begin_; }  ///< since it began

 private:
  struct Line {
    double time = 0.0;
    Vec3 position{0.0};
    std::array<double, 4> rotation{};
  };
  void write(const Line& line);

  std::filesystem::path file_;
  std::ofstream out_;
  Mode mode_;
  double begin_ = 0.0;
  Line last_;     ///< that was seen
  Line written_;  ///< that was written last
  bool empty_ = true;
};

/// The first of roam-1.EXTENSION, roam-2.EXTENSION, ... in `folder` that does not exist: what keys write never replaces
/// anything.
[[nodiscard]] std::filesystem::path unused_name(const std::filesystem::path& folder, const std::string& extension);

}  // namespace roam::app
