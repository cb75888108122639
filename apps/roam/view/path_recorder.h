#pragma once
/// \file
/// Writer of a path file from a session.

#include <array>
#include <exception>
#include <filesystem>
#include <optional>
#include <string_view>

#include "files/whole_file.h"
#include "roam/scene_frame.h"
#include "roam/walker.h"

namespace roam::app {

/// Writes osgViewer's lines `t x y z qx qy qz qw`: the time since the recording began, the body's centre in the scene's
/// frame, and the camera's rotation. It writes body and frame too; see recorded_body.h. `--path` replays the file. An
/// existing file stays until close(). Each line is written at once, so that a temporary file with the path so far
/// survives a crash.
class PathRecorder {
 public:
  /// Begins a file with the body in it. Throws roam::Error if it cannot be written.
  PathRecorder(const std::filesystem::path& file, const WalkerSettings& body, Mode mode,
               const std::optional<SceneFrame>& frame = std::nullopt, files::Naming naming = files::Naming::exact);
  /// Closes a recording that an error cut short.
  ~PathRecorder();
  PathRecorder(const PathRecorder&) = delete;
  PathRecorder& operator=(const PathRecorder&) = delete;

  /// Adds the body's position at `time` (s, never decreasing). Writes a line when a tenth of a second has passed since
  /// the last one and something moved.
  void add(double time, const Vec3& position, const std::array<double, 4>& rotation, Mode mode);
  /// Writes the last position, and gives the file its name. Returns its path. Throws roam::Error if not everything
  /// could be written; then there is no new file.
  std::filesystem::path close();

  [[nodiscard]] double seconds() const { return last_.time - begin_; }  ///< since it began
  [[nodiscard]] double length() const { return length_; }               ///< m, so far

 private:
  struct Line {
    double time = 0.0;
    Vec3 position{0.0};
    std::array<double, 4> rotation{};
  };
  void write(const Line& line);
  void write(std::string_view text);

  files::WholeFile out_;
  std::exception_ptr failure_;  ///< the first failure; nothing is written after it
  Mode mode_;
  double begin_ = 0.0;
  double length_ = 0.0;
  Line last_;     ///< added last
  Line written_;  ///< written last
  bool empty_ = true, closed_ = false;
};

}  // namespace roam::app
