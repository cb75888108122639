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

#include <cstddef>
#include <cstdint>
#include <optional>
#include <osg/ref_ptr>
#include <string>
#include <vector>

#include "graphics/frame.h"
#include "graphics/plate.h"

namespace roam::graphics {

/// Amount of display, from most to least. full: status, message, crosshair. minimal: the first status line, message,
/// crosshair. off: nothing, not even help; only a hint.
enum class Detail : std::uint8_t { full, minimal, off };
/// Kind of a text. A warning is amber with a bar at its side; an info is white.
enum class Tone : std::uint8_t { info, warning };

/// One line of the status panel, at the upper left. UTF-8. With an empty label the value begins at the left edge. A
/// value that would make the panel wider than about half of the picture is broken into up to five lines.
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

/// A text on the picture, centred above a point, and above earlier texts that it would hide. Pixels from the lower left
/// corner.
struct HudLabel {
  std::string text;
  float x = 0, y = 0;
  bool operator==(const HudLabel&) const = default;
};

/// A row of the list, with a box that is ticked, half ticked or not.
struct ListRow {
  enum class Box : std::uint8_t { none, off, half, on };
  std::string text{};   ///< shortened in its middle where it is too long
  std::string name{};   ///< of its box and its text: see Hud::list_at()
  std::string opens{};  ///< name of the arrow before it; empty: none
  bool is_open = false;
  int depth = 0;  ///< steps to the right
  Box box = Box::none;
  bool ends_with_ellipsis = false;  ///< where it is too long, it is shortened at its end
  bool operator==(const ListRow&) const = default;
};

/// A list at the right edge. Give it the rows that are to be seen: Hud::list_rows() of them have room.
struct HudList {
  std::string title{};
  std::string search{};  ///< a field below the title, for a click
  std::vector<ListRow> rows{};
  bool operator==(const HudList&) const = default;
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
  /// Texts on the picture. Those that would lie behind another part of the display, or behind a plan, are not drawn.
  void set_labels(std::vector<HudLabel> labels);
  /// Where not all lines have room with letters of 10 pixels, they are divided into pages.
  void set_help(std::vector<HelpLine> lines);
  /// The help replaces the status, the crosshair and the list; the message stays, unless the window is small. It begins
  /// with its first page.
  void show_help(bool shown);
  /// Shows the next page of the help (1), after the last one the first, or the one before (-1), if there is one.
  void turn_help(int pages);
  /// Whether pages follow the one that the last frame showed.
  [[nodiscard]] bool help_goes_on() const;
  [[nodiscard]] bool help_shown() const;
  /// The name of the help's line at a point of the last frame, x and y in [-1, 1], or help_more; empty: none.
  [[nodiscard]] std::string help_at(double x, double y) const;
  static constexpr const char* help_more = "more";  ///< the line that turns the page
  /// Highlights the help's line with this name; empty: none.
  void set_help_focus(std::string name);
  /// A button at the lower left, in full detail and without help; empty: none.
  void set_button(std::string text);
  /// Whether the button is at a point of the last frame, x and y in [-1, 1].
  [[nodiscard]] bool button_at(double x, double y) const;
  /// The list, which takes the place of a plan; none: no list. It is hidden while the help is shown.
  void set_list(std::optional<HudList> list);
  /// The number of rows that a list has room for.
  [[nodiscard]] std::size_t list_rows() const;
  /// The name of the list's part at a point of the last frame, x and y in [-1, 1]: of a row or an arrow, or
  /// list_search. Empty: none.
  [[nodiscard]] std::string list_at(double x, double y) const;
  static constexpr const char* list_search = "search";
  /// Whether the list covers a point of the last frame.
  [[nodiscard]] bool list_covers(double x, double y) const;
  /// Highlights the row with this name; empty: none.
  void set_list_focus(std::string name);
  /// The rectangle of a plan at the right of the picture; an empty one: none. Unless there is room beside and below it,
  /// status and message stay left of it, and the hint, or below it if it is too long for that.
  void set_plan(const Rectangle& where);
  /// The rectangles of the status, the message, the hint, the recording, the button, the list and the help that the
  /// last frame showed, in pixels.
  [[nodiscard]] std::vector<Rectangle> panels() const;
  void set_detail(Detail detail);
  [[nodiscard]] Detail detail() const;
  void set_crosshair(bool shown);  ///< default true

  /// All visible text, line by line: "label: value", "recording: ...", the message, the hint, all labels, the list with
  /// "[x] " before its ticked rows, "key: effect". Not the button.
  [[nodiscard]] std::string text() const;

 private:
  class Panels;
  osg::ref_ptr<Panels> panels_;
  osg::ref_ptr<osg::Group> parent_, group_;
};

}  // namespace roam::graphics
