#pragma once
/// \file
/// Recorder of a film of the frames: `roam view --record`.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "graphics/capture.h"
#include "graphics/frame.h"

namespace roam::app {

class Film {
 public:
  /// `rate`: pictures a second. The film has the size of its first picture. Throws roam::Error if films cannot be made,
  /// or none of the frame's present size; see graphics::Video.
  Film(graphics::Frame& frame, const std::filesystem::path& path, int rate);

  /// Call it before a frame is drawn: captures the frame if one is due. `seconds`: since the session began, never
  /// decreasing.
  void before_frame(double seconds);
  /// Whether before_frame() would capture a frame at this time. Pictures are due at multiples of 1 / rate after the
  /// first.
  [[nodiscard]] bool is_due(double seconds) const;
  /// Why the film has no more pictures, as a sentence; empty: it goes on, or has ended as it should.
  [[nodiscard]] std::string problem() const;
  /// Ends the film and gives the file its name. Throws roam::Error if the film could not be written.
  void finish();
  [[nodiscard]] const std::filesystem::path& path() const;

 private:
  struct State;
  [[nodiscard]] std::int64_t index(double seconds) const;

  graphics::Frame& frame_;
  int rate_;
  std::shared_ptr<State> state_;  ///< shared with frames still being drawn
  double begin_ = -1.0;
  std::int64_t next_ = 0;  ///< the picture that is due next
};

}  // namespace roam::app
