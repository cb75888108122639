#pragma once
/// \file
/// Films what a frame shows: `roam view --record`.

#include <filesystem>
#include <memory>
#include <string>

#include "graphics/capture.h"
#include "graphics/frame.h"

namespace roam::app {

class Film {
 public:
  static constexpr int frames_per_second = 30;

  /// Throws roam::Error when films can not be made: see graphics::Video.
  Film(graphics::Frame& frame, const std::filesystem::path& path);

  /// Before a frame is drawn: takes it where the film is due. `seconds` since the session began, never less than
  /// before.
  void before_frame(double seconds);
  /// Whether before_frame() would take a frame at this time.
  [[nodiscard]] bool is_due(double seconds) const { return seconds >= next_; }
  /// Why no more is filmed, for people; empty while all is well.
  [[nodiscard]] std::string problem() const;
  /// Ends it and gives the file its name. Throws roam::Error when the film could not be written.
  void finish();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  struct State;
  graphics::Frame& frame_;
  std::filesystem::path path_;
  std::shared_ptr<State> state_;  ///< shared with frames that are still being drawn
  double begin_ = -1.0;
  double next_ = 0.0;
};

}  // namespace roam::app
