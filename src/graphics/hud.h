#pragma once
/// \file
/// The head-up display: text on dark panels, readable on any background.
///
///     Hud hud(frame);
///     hud.set_status({{"mode", "walk"}, {"speed", "1.4 m/s"}});
///     hud.set_message("opening 0.62 m, body 0.60 m", Tone::warning);
///     hud.set_help({{"Move", ""}, {"W A S D", "go"}, {"Space", "jump"}});
///
/// The text scales with the window. It is readable from 640 x 360 to 3840 x 2160, and stays inside smaller windows.
/// Setting an unchanged value costs nothing; changes are laid out before the next frame.

#include <cstdint>
#include <osg/ref_ptr>
#include <string>
#include <vector>

#include "graphics/frame.h"

namespace roam::graphics {

/// Amount of display. full: status, message, crosshair. minimal: the first status line, message,
/// crosshair. off: nothing, not even help; only a hint.
enum class Detail : std::uint8_t { full, minimal, off };
/// Kind of a text. A warning is amber with a bar at its side; an info is white.
enum class Tone : std::uint8_t { info, warning };

/// One line of the status panel, at the upper left. UTF-8. With an empty label the value begins at the left edge. A
/// value that would make the panel wider than about half of the picture is broken into up to three lines.
struct StatusLine {
  std::string label{};
  std::string value{};
  Tone tone = Tone::info;
  bool operator==(const StatusLine&) const = default;
};

/// A key and its effect.
struct HelpLine {
  std::string key{};
  std::string effect{};  ///< empty: a heading
  std::string name{};    ///< of a line that can be clicked: see Hud::help_at()
  bool operator==(const HelpLine&) const = default;
};

/// A text on the picture, centred above a point. Pixels from the lower left corner.
struct HudLabel {
  std::string text;
  float x = 0, y = 0;
  bool operator==(const HudLabel&) const = default;
};

/// The head-up display of a frame. Use it between frames, from the thread that calls viewer.frame(), in any threading
/// model.
class Hud {
 public:
  explicit Hud(Frame& frame);
  ~Hud();  ///< removes it from the picture
  Hud(const Hud&) = delete;
  Hud& operator=(const Hud&) = delete;

  /// Lines from top to bottom. In minimal detail only the first one is shown.
  void set_status(std::vector<StatusLine> lines);
  /// The message in the lower middle; empty: none. It may have several lines; long ones are broken.
  void set_message(std::string text, Tone tone = Tone::info);
  /// A bar below the message for progress in [0, 1]; negative: none.
  void set_progress(double share);
  /// A sentence above the middle, in any detail; empty: none. `opacity` in [0, 1].
  void set_hint(std::string text, double opacity = 1.0);
  /// Beside a red dot at the upper right; empty: nothing.
  void set_recording(std::string text);
  /// Texts below all other parts of the display.
  void set_labels(std::vector<HudLabel> labels);
  /// From about 480 x 360 pixels on, all lines are visible. In smaller windows only the first ones are, with a line
  /// that says so.
  void set_help(std::vector<HelpLine> lines);
  /// The help replaces the status and the crosshair; the message stays.
  void show_help(bool shown);
  [[nodiscard]] bool help_shown() const;
  /// The name of the help's line at a point of the last frame, x and y in [-1, 1]; empty: none.
  [[nodiscard]] std::string help_at(double x, double y) const;
  /// Highlights the help's line with this name; empty: none.
  void set_help_focus(std::string name);
  /// A button at the lower left, in full detail and without help; empty: none.
  void set_button(std::string text);
  /// Whether the button is at a point of the last frame, x and y in [-1, 1].
  [[nodiscard]] bool button_at(double x, double y) const;
  void set_detail(Detail detail);
  [[nodiscard]] Detail detail() const;
  void set_crosshair(bool shown);  ///< default true

  /// All visible text, line by line: "label: value", "recording: ...", the message, the hint, the labels, "key:
  /// effect". Not the button.
  [[nodiscard]] std::string text() const;

 private:
  class Panels;
  osg::ref_ptr<Panels> panels_;
  osg::ref_ptr<osg::Group> parent_, group_;
};

}  // namespace roam::graphics
