#pragma once
/// \file
/// The head-up display: text that can be read on any background, because it stands on dark panels of its own.
///
///     Hud hud(frame);
///     hud.set_status({{"mode", "walk"}, {"speed", "1.4 m/s"}});
///     hud.set_message("opening 0.62 m, body 0.60 m", Tone::warning);
///     hud.set_help({{"Move", ""}, {"W A S D", "go"}, {"Space", "jump"}});
///
/// Text grows with the window: it is readable from 640 x 360 to 3840 x 2160, and stays inside smaller ones. Setting
/// what is set already costs nothing; what changed is laid out anew before the next frame.

#include <cstdint>
#include <osg/ref_ptr>
#include <string>
#include <utility>
#include <vector>

#include "graphics/frame.h"

namespace roam::graphics {

/// How much is shown. full: status, message, crosshair. minimal: the first status line's values, message, crosshair.
/// off: nothing, not even help.
enum class Detail : std::uint8_t { full, minimal, off };
/// What a text is about. A warning is amber with a bar at its side, an info is white.
enum class Tone : std::uint8_t { info, warning };

/// One line of the status panel, at the upper left. UTF-8. An empty label: the value begins at the left edge. A value
/// that would make the panel wider than about half of the picture is broken into up to three lines.
struct StatusLine {
  std::string label{};
  std::string value{};
  Tone tone = Tone::info;
  bool operator==(const StatusLine&) const = default;
};

/// A key and what it does. With an empty second: a heading.
using HelpLine = std::pair<std::string, std::string>;

/// Shows itself in a frame. Use it from the thread that calls viewer.frame(), between frames, in any threading model.
class Hud {
 public:
  explicit Hud(Frame& frame);
  ~Hud();  ///< takes it off the picture
  Hud(const Hud&) = delete;
  Hud& operator=(const Hud&) = delete;

  /// Lines from top to bottom. In minimal detail only lines [0, minimal_lines) are shown.
  void set_status(std::vector<StatusLine> lines);
  /// What is told in the lower middle; empty: nothing. May have several lines; long ones are broken.
  void set_message(std::string text, Tone tone = Tone::info);
  void clear_message() { set_message({}); }
  /// A bar below the message, in [0, 1]; negative: none. For loading.
  void set_progress(double share);
  /// All lines are seen from about 480 x 360 pixels on; of more than there is room for the first, and a line that says
  /// so.
  void set_help(std::vector<HelpLine> lines);
  /// The help takes the place of the status and the crosshair; the message stays.
  void show_help(bool shown);
  [[nodiscard]] bool help_shown() const;
  void set_detail(Detail detail);
  [[nodiscard]] Detail detail() const;
  void set_minimal_lines(std::size_t lines);  ///< default 1
  void set_crosshair(bool shown);             ///< default true

  /// All that is shown now, line by line: "label: value", the message, "key: what it does". Empty when off.
  [[nodiscard]] std::string text() const;

 private:
  class Panels;
  osg::ref_ptr<Panels> panels_;
  osg::ref_ptr<osg::Group> parent_, group_;
};

}  // namespace roam::graphics
