#pragma once
/// \file
/// A list at the right edge of the window, for the mouse.

#include <osgGA/GUIEventHandler>
#include <string>
#include <vector>

#include "osgRoam/Manipulator.h"
#include "view/news.h"
#include "view/presses.h"
#include "view/stage.h"

namespace roam::app {

/// A list that is shown or not, scrolls by the wheel, and tells which of its parts is clicked. At most one is shown.
/// Call all members from the thread that draws, between two frames.
class ListPanel : public osgGA::GUIEventHandler {
 public:
  [[nodiscard]] bool is_shown() const { return shown_; }
  void close() { shown_ = false; }
  /// Shows it, or no longer; closes `other`.
  void toggle_instead_of(ListPanel& other) {
    other.close();
    shown_ = !shown_;
  }
  /// Draws it. Call it in each frame in which it is shown.
  void draw();

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

 protected:
  ListPanel(Stage& stage, const osgRoam::Manipulator& roamer, News& news)
      : roamer_(roamer), news_(news), stage_(stage) {}
  ~ListPanel() override = default;

  void scroll_to_top() { first_ = 0; }
  /// The list without rows. Brings rows_ up to date.
  [[nodiscard]] virtual graphics::HudList head() = 0;
  /// A click on a row, its arrow, or Hud::list_search, by name. Errors become news.
  virtual void click(const std::string& part) = 0;

  /// The same with the right button.
  virtual void click_right(const std::string& part) { click(part); }
  /// Whether the present click is the second of a double click.
  [[nodiscard]] bool is_again() const { return again_; }
  /// Whether the person types for the list.
  [[nodiscard]] bool takes_keys() const { return shown_ && !roamer_.mouseGrab() && !stage_.hud().help_shown(); }
  void hint(const std::string& text) { stage_.hint(text, 4.0); }

  const osgRoam::Manipulator& roamer_;
  News& news_;
  std::vector<graphics::ListRow> rows_;  ///< all of them

 private:
  void press(const std::string& part, bool right);
  void scroll(double notches);

  Stage& stage_;
  bool shown_ = false;
  bool is_down_ = false;  ///< a button of the mouse was pressed here
  Presses presses_;
  bool again_ = false;
  std::size_t first_ = 0;  ///< of the rows that are seen
};

}  // namespace roam::app
