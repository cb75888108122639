#pragma once
/// \file
/// Layout and drawing of the parts of the head-up display.

#include <initializer_list>
#include <optional>
#include <osg/Group>
#include <osg/StateSet>
#include <string>
#include <vector>

#include "graphics/hud.h"
#include "graphics/lettering.h"
#include "graphics/plate.h"

namespace roam::graphics {

/// The size of the picture and the sizes derived from it, in pixels.
struct Page {
  float width = 0, height = 0;
  float right = 0;     ///< of the part for status, message and hint; beyond it is a large plan, or the list
  float below = 0;     ///< upper edge of the part below a plan, which has the whole width
  int letter = 16;     ///< size of the text
  float margin = 16;   ///< from the picture's edge
  float line = 23;     ///< from one base line to the next
  bool small = false;  ///< there is little room: parts that are not needed now are left out

  static Page of(float width, float height);
  bool operator==(const Page&) const = default;
};

/// The status lines at the upper left. Keeps its texts, because they change with every frame. Long values are broken
/// into up to three lines, or fewer if there is no room for all of them.
class StatusPanel {
 public:
  explicit StatusPanel(const osg::ref_ptr<osg::StateSet>& plates) : plates_(plates) {}
  [[nodiscard]] osg::Node* node() const { return group_.get(); }
  void lay_out(const Page& page, const std::vector<StatusLine>& lines);
  /// The plate; empty without lines.
  [[nodiscard]] const Rectangle& place() const { return place_; }

 private:
  struct Row {
    osg::ref_ptr<Text> label, value;
    std::string words;                // the unbroken value
    std::vector<std::string> broken;  // all its lines
    std::string shown;                // the lines that are shown
    std::size_t lines = 0;            // and their number; 0: not known yet
  };
  void rebuild(const std::vector<StatusLine>& lines);
  /// Width of a row's value, in pixels.
  [[nodiscard]] float width_for(std::size_t row) const;
  /// Left edge of a row's value, in pixels.
  [[nodiscard]] float left_of(std::size_t row) const;
  void break_value(std::size_t row, const std::string& words);
  /// The number of lines of each row. The last rows, which are those of tools, come first.
  [[nodiscard]] std::vector<std::size_t> share_lines() const;
  /// A row's first lines, with "…" if there are more.
  [[nodiscard]] std::string first_lines(std::size_t row, std::size_t count) const;
  void place_rows();
  void place_plate(float width);

  osg::ref_ptr<osg::StateSet> plates_;
  osg::ref_ptr<osg::Group> group_ = new osg::Group;
  osg::ref_ptr<osg::Geometry> plate_;
  Page page_;
  std::vector<std::string> labels_;
  std::vector<Row> rows_;
  float value_left_ = 0;
  float width_ = 0;
  std::size_t lines_ = 0;
  Rectangle place_;
};

/// A node, and the rectangle that it covers.
struct Placed {
  osg::ref_ptr<osg::Node> node;
  Rectangle where;
};

/// The message in the lower middle, with the progress bar. It ends below `limit` pixels from below;
/// nothing without room for a line.
[[nodiscard]] Placed make_message(const Page& page, const std::string& text, Tone tone, std::optional<double> progress,
                                  float limit, osg::StateSet* plates);

/// A sentence above the middle, over the crosshair; under it where one of `others` is in the way. Broken where it is
/// too long.
[[nodiscard]] Placed make_hint(const Page& page, const std::string& text, double opacity,
                               std::initializer_list<Rectangle> others, osg::StateSet* plates);

/// A red dot and a text at the upper right.
[[nodiscard]] Placed make_recording(const Page& page, const std::string& text, osg::StateSet* plates);

/// Whether a plan leaves room for the status beside it, and for the hint and the message below it.
[[nodiscard]] bool leaves_room(const Rectangle& plan, const Page& page);

/// The labels that lie behind none of the rectangles `above`.
[[nodiscard]] osg::ref_ptr<osg::Node> make_labels(const Page& page, const std::vector<HudLabel>& labels,
                                                  const std::vector<Rectangle>& above, osg::StateSet* plates);

/// A clickable part of the display, in pixels.
struct Target {
  Rectangle where;
  std::string name;
};

/// A node, its clickable parts, and the rectangle that it covers.
struct Clickable {
  osg::ref_ptr<osg::Node> node;
  std::vector<Target> targets;
  Rectangle where;
};

/// A text at the lower left.
[[nodiscard]] Clickable make_button(const Page& page, const std::string& text, osg::StateSet* plates);

/// The list at the right edge. The row named `focus` is highlighted. Its targets are the names of rows, and
/// Hud::list_search.
[[nodiscard]] Clickable make_list(const Page& page, const HudList& list, const std::string& focus,
                                  osg::StateSet* plates);
/// The rows that a list has room for, and its left edge in pixels.
[[nodiscard]] std::size_t rows_of_list(const Page& page);
[[nodiscard]] float left_of_list(const Page& page);

/// The help, of which a small window shows one of several pages.
struct Help : Clickable {
  std::size_t page = 0, pages = 1;
};

/// The keys, over the whole picture. The lines named `focus` are highlighted. Uses as many columns, letters as small
/// and as many breaks as needed to fit. If they still do not fit, shows the page `shown`, or the last one, and a line
/// that turns it, Hud::help_more.
[[nodiscard]] Help make_help(const Page& page, const std::vector<HelpLine>& lines, std::size_t shown,
                             const std::string& focus, osg::StateSet* plates);

/// The small cross in the middle: light with a dark rim.
[[nodiscard]] osg::ref_ptr<osg::Node> make_crosshair(const Page& page, osg::StateSet* plates);

/// Replaces the children of a group. Null nodes are left out.
void show_only(osg::Group& group, std::initializer_list<osg::ref_ptr<osg::Node>> nodes);

}  // namespace roam::graphics
