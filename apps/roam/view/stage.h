#pragma once
/// \file
/// The output of a session: window or off-screen picture, head-up display, pictures and films.

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <limits>
#include <optional>
#include <osgViewer/Viewer>
#include <string>
#include <utility>
#include <vector>

#include "cli/histogram.h"
#include "cli/output_file.h"
#include "graphics/capture.h"
#include "graphics/context.h"
#include "graphics/frame.h"
#include "graphics/hud.h"
#include "graphics/overlay.h"
#include "graphics/shading.h"
#include "roam/math.h"
#include "view/commands.h"
#include "view/display_node.h"
#include "view/film.h"
#include "view/options.h"
#include "view/status.h"
#include "view/thrift.h"
#include "view/view_report.h"

namespace roam::app {

/// The result of taking a picture.
struct Picture {
  std::filesystem::path file;
  std::string problem;  ///< why it could not be written; empty: it was
};

/// The quality of textures for a renderer. Software computes each sample separately: ground seen at a flat angle would
/// take minutes a frame.
[[nodiscard]] TextureQuality texture_quality(const graphics::Abilities& abilities);

/// Opens a window or an off-screen buffer, and draws there. Call all members from one thread.
class Stage {
 public:
  /// Throws roam::Error if there is no display, no OpenGL, or no film can be made; the message says what to do.
  Stage(const ViewOptions& options, const ViewPlan& plan);

  [[nodiscard]] osgViewer::Viewer& viewer() { return *viewer_; }
  [[nodiscard]] graphics::Frame& frame() { return *frame_; }
  [[nodiscard]] graphics::Hud& hud() { return *hud_; }
  [[nodiscard]] graphics::Overlay& overlay() { return *overlay_; }
  [[nodiscard]] bool headless() const { return context_.headless; }
  [[nodiscard]] TextureQuality texture_quality() const { return app::texture_quality(context_.abilities); }
  /// Says why drawing is not full, if that was not wished: no graphics card, or slow frames. Else empty.
  [[nodiscard]] std::string quality_note() const;
  /// A note on the effects that are off because there is no graphics card; empty if none are, or the person chose it.
  [[nodiscard]] std::string plainness() const;

  /// Shows the lines and the message; does nothing if they are shown already.
  void show(const Status& status);
  void set_hud(HudMode mode);
  [[nodiscard]] HudMode hud_mode() const { return hud_mode_; }
  [[nodiscard]] bool edges() const { return frame_->edges(); }
  /// Shows a sentence in any mode for `seconds`, the last of them fading. Replaces the one before.
  void hint(const std::string& text, double seconds = std::numeric_limits<double>::infinity());
  /// Shows a question in place of all hints; empty: no longer.
  void ask(std::string question) { question_ = std::move(question); }
  /// Makes a hint that is shown end after `seconds`, if not before.
  void end_hint(double seconds) { hint_end_ = std::min(hint_end_, now_ + seconds); }
  /// Adds "help", "hud", "fullscreen", "picture" and "picture_with_display", which write numbered files.
  /// poll_pictures() returns them when written.
  void add_to(Commands& commands);

  /// Whether the next frame is one for a picture without the display, which no tool's marks belong to.
  [[nodiscard]] bool is_still_next() const { return still_wanted_ || enlarged_in_ > 0; }
  /// The pictures finished since the last call, and the film if it has stopped since.
  [[nodiscard]] std::vector<Picture> poll_pictures();

  /// Begins a frame. Returns its seconds: by the clock in a window. Headless: 1/60 if the session `runs`, else 0, so
  /// that a session is the same on every machine.
  double advance(bool runs);
  /// Seconds since the session began.
  [[nodiscard]] double now() const { return now_; }
  /// Passes the frame's events to all handlers.
  void see_events();
  /// Updates and draws the frame. Call see_events() first.
  void draw();
  /// While held, the film leaves out what is drawn.
  void hold_film(bool held) { film_held_ = held; }
  /// Whether the next frame is one of the film's.
  [[nodiscard]] bool is_filmed() const { return film_ && !film_held_ && film_->is_due(now_); }
  /// Draws the frame if it is `wanted`, shown in a window, or due in a film. Then rests, which limits the frame rate.
  void draw_if_seen(bool wanted);
  /// Draws the view into a file of the plan's size, however large that is, and waits for it. Throws roam::Error if it
  /// cannot be written.
  void draw_picture(const std::filesystem::path& path, bool with_display = false);
  /// Adds the frame statistics, and the files that options request.
  void fill(ViewReport& report) const;
  /// Ends film and pictures.
  void finish(Unwritten& unwritten);

  /// 0 before the second frame; the first one includes the setup.
  [[nodiscard]] double last_frame_ms() const { return last_ms_; }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] osg::ref_ptr<osg::Image> large_picture(int width, int height);
  [[nodiscard]] bool is_writing_much() const;
  void take_enlarged();
  [[nodiscard]] std::array<int, 2> enlarged_size() const;
  void say_what_is_finished();
  void cycle_hud();
  void fade_hint();
  void toggle_fullscreen();
  void draw_less_if_slow(Clock::time_point begin, double ms);

  graphics::Context context_;
  osg::ref_ptr<osgViewer::Viewer> viewer_;
  std::optional<graphics::Frame> frame_;
  std::optional<graphics::Hud> hud_;
  std::optional<graphics::Overlay> overlay_;
  std::optional<Film> film_;
  bool film_held_ = false, film_stopped_ = false;
  std::vector<graphics::Screenshot> pictures_;
  std::vector<Picture> failed_;                   ///< pictures that could not be drawn
  std::optional<std::array<int, 2>> screenshot_;  ///< pixels; none: the window's
  double picture_scale_ = 1.0;
  bool still_wanted_ = false, picture_wanted_ = false;  ///< of the next frame, the second with the display
  int enlarged_in_ = 0;  ///< frames, so that the window says it before; 0: none is wanted
  HudMode hud_mode_ = HudMode::plain;
  std::string hint_, question_;
  double hint_end_ = 0.0;             ///< s
  std::vector<std::string> written_;  ///< names of film and picture
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point frame_begin_ = begin_;
  double now_ = 0.0;  ///< s
  bool runs_ = false;
  Histogram times_;  ///< ns
  Histogram draw_calls_;
  std::optional<Thrift> thrift_;     ///< none: the quality is as wished
  bool is_plain_by_itself_ = false;  ///< for lack of a graphics card
  std::string drawn_less_;           ///< why
  double last_ms_ = 0.0;
  bool fullscreen_ = false;
  int width_ = 0, height_ = 0;  ///< pixels, of the window before full screen
};

}  // namespace roam::app
