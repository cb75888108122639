#pragma once
/// \file
/// Where a session is shown: window or none, picture, display, pictures and films of it.

#include <filesystem>
#include <optional>
#include <osgViewer/Viewer>
#include <string>
#include <vector>

#include "cli/histogram.h"
#include "graphics/capture.h"
#include "graphics/context.h"
#include "graphics/frame.h"
#include "graphics/hud.h"
#include "graphics/overlay.h"
#include "graphics/shading.h"
#include "roam/math.h"
#include "view/display_node.h"
#include "view/film.h"
#include "view/options.h"
#include "view/status.h"

namespace roam::app {

/// A picture that has been taken.
struct Picture {
  std::filesystem::path file;
  std::string problem;  ///< why it could not be written; empty: it is
};

/// Opens a place to draw to and draws there. All of it belongs to one thread.
class Stage {
 public:
  /// Throws roam::Error when there is no display or no OpenGL, or no film can be made; the message says what to do.
  Stage(const ViewOptions& options, const ViewPlan& plan);

  [[nodiscard]] osgViewer::Viewer& viewer() { return *viewer_; }
  [[nodiscard]] graphics::Frame& frame() { return *frame_; }
  [[nodiscard]] graphics::Hud& hud() { return *hud_; }
  [[nodiscard]] graphics::Overlay& overlay() { return *overlay_; }
  [[nodiscard]] bool headless() const { return context_.headless; }
  [[nodiscard]] TextureQuality texture_quality() const;

  /// Shows the lines and the message; changes nothing when they are what is shown.
  void show(const Status& status);
  void set_hud(HudMode mode);
  /// From full to minimal, off, and full again.
  void cycle_hud();
  void toggle_fullscreen();

  /// The film that --record asks for; none: nothing is filmed.
  [[nodiscard]] const std::optional<Film>& film() const { return film_; }
  /// Takes a picture of the next frame, to a numbered file; `poll_pictures` tells when it is written.
  void take_picture(const std::filesystem::path& path);
  /// The pictures that are done since last asked.
  [[nodiscard]] std::vector<Picture> poll_pictures();

  /// Lets all handlers see the events of a frame. Headless, the time is `seconds` since the session began, so that a
  /// session is the same on every machine; in a window it is that of the clock.
  void see_events(double seconds);
  /// Updates and draws one frame. `seconds` since the session began. Events must have been seen to.
  void draw(double seconds);
  /// Draws one frame into a file and waits for it. Throws roam::Error when it can not be written.
  void draw_picture(const std::filesystem::path& path, double seconds);
  /// Ends film and pictures. Throws roam::Error when one of them could not be written.
  void finish();

  [[nodiscard]] const Histogram& frame_times() const { return times_; }  ///< ns
  /// 0 until there were two: the first one sets everything up.
  [[nodiscard]] double last_frame_ms() const { return last_ms_; }

 private:
  graphics::Context context_;
  osg::ref_ptr<osgViewer::Viewer> viewer_;
  std::optional<graphics::Frame> frame_;
  std::optional<graphics::Hud> hud_;
  std::optional<graphics::Overlay> overlay_;
  std::optional<Film> film_;
  std::vector<graphics::Screenshot> pictures_;
  HudMode hud_mode_ = HudMode::full;
  Histogram times_;
  double last_ms_ = 0.0;
  bool fullscreen_ = false;
  int width_ = 0, height_ = 0;  ///< pixels, of the window before it filled the screen
};

}  // namespace roam::app
