#pragma once
/// \file
/// Where on the picture the parts of the head-up display lie, and what they are drawn with.

#include <optional>
#include <osg/Group>
#include <osg/StateSet>
#include <string>
#include <vector>

#include "graphics/hud.h"
#include "graphics/lettering.h"
#include "graphics/plate.h"

namespace roam::graphics {

/// The picture's size, and what follows from it. All in pixels.
struct Page {
  float width = 0, height = 0;
  int letter = 16;    ///< size of the text
  float margin = 16;  ///< from the picture's edge
  float line = 23;    ///< from one base line to the next

  static Page of(float width, float height);
  bool operator==(const Page&) const = default;
};

/// The status lines at the upper left. Keeps its texts, because what they say changes with every frame. Long values are
/// broken into up to three lines, fewer where there would be no room for all below each other.
class StatusPanel {
 public:
  explicit StatusPanel(osg::ref_ptr<osg::StateSet> plates) : plates_(std::move(plates)) {}
  [[nodiscard]] osg::Node* node() const { return group_.get(); }
  void lay_out(const Page& page, const std::vector<StatusLine>& lines);

 private:
  struct Row {
    osg::ref_ptr<osgText::Text> label, value;
    std::string words;                // the value as it came
    std::vector<std::string> broken;  // as many lines as it would take
    std::string shown;                // the first of them
    std::size_t lines = 0;            // and how many it has; 0: not yet said
  };
  void rebuild(const std::vector<StatusLine>& lines);
  /// Pixels that a row has for its value.
  [[nodiscard]] float width_for(std::size_t row) const;
  void break_value(std::size_t row, const std::string& words);
  [[nodiscard]] std::size_t lines_in_all(std::size_t most_lines) const;
  /// A row's first lines, with "…" where that is not all.
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
};

/// The message in the lower middle, with the bar of progress.
[[nodiscard]] osg::ref_ptr<osg::Node> make_message(const Page& page, const std::string& text, Tone tone,
                                                   std::optional<double> progress, osg::StateSet* plates);

/// The keys, over the whole picture: in as many columns, as small and broken into as many lines as they need to fit.
/// Where not even that is enough, the first of them and "… enlarge the window".
[[nodiscard]] osg::ref_ptr<osg::Node> make_help(const Page& page, const std::vector<HelpLine>& lines,
                                                osg::StateSet* plates);

/// The small cross in the middle: light with a dark rim.
[[nodiscard]] osg::ref_ptr<osg::Node> make_crosshair(const Page& page, osg::StateSet* plates);

}  // namespace roam::graphics
