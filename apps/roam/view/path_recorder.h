#pragma once
/// \file
/// Writes the way of a session as a path file.

#include <array>
#include <exception>
#include <filesystem>
#include <string_view>

#include "files/whole_file.h"
#include "roam/walker.h"

namespace roam::app {

/// Writes osgViewer's lines `t x y z qx qy qz qw`: the time since the recording began, the body's centre in the scene's
/// frame, and the rotation of the camera; and the body, see recorded_body.h. What is written can be gone again by
/// `--path`. What was there stays until close(). Each line is written at once, so that after a crash the temporary file
/// has the way so far.
class PathRecorder {
 public:
  /// Begins a file, and says the body in it. Throws roam::Error when it cannot be written.
  PathRecorder(const std::filesystem::path& file, const WalkerSettings& body, Mode mode,
               files::Naming naming = files::Naming::exact);
  /// Closes a recording that an error cut short.
  ~PathRecorder();
  PathRecorder(const PathRecorder&) = delete;
  PathRecorder& operator=(const PathRecorder&) = delete;

  /// Where the body is at `time` (s, never less than the time before). Writes when a tenth of a second has passed since
  /// the last line and something moved.
  void add(double time, const Vec3& position, const std::array<double, 4>& rotation, Mode mode);
  /// Writes where it ends, and gives the file its name. Returns its path. Throws roam::Error when not everything could
  /// be written: then there is no new file.
  std::filesystem::path close();

  [[nodiscard]] double seconds() const { return last_.time - begin_; }  ///< since it began

 private:
  struct Line {
    double time = 0.0;
    Vec3 position{0.0};
    std::array<double, 4> rotation{};
  };
  void write(const Line& line);
  void write(std::string_view text);

  files::WholeFile out_;
  std::exception_ptr failure_;  ///< the first; what comes after it is not written
  Mode mode_;
  double begin_ = 0.0;
  Line last_;     ///< that was seen
  Line written_;  ///< that was written last
  bool empty_ = true, closed_ = false;
};

}  // namespace roam::app
