#pragma once
/// \file
/// The scene's bookmarks as a list.

#include <string>

#include "view/commands.h"
#include "view/list_panel.h"
#include "view/records.h"

namespace roam::app {

/// A click on a bookmark leads the body there; one with the right button deletes it; one on the field above keeps a new
/// one. A double click is one click.
class BookmarkList : public ListPanel {
 public:
  BookmarkList(Stage& stage, const osgRoam::Manipulator& roamer, Records& records, News& news)
      : ListPanel(stage, roamer, news), records_(records) {}

  /// Adds "bookmarks", which shows or hides the list in place of `other`. Needs a walker.
  void add_to(Commands& commands, ListPanel& other);

 protected:
  ~BookmarkList() override = default;
  [[nodiscard]] graphics::HudList head() override;
  void click(const std::string& part) override;
  void click_right(const std::string& part) override;

 private:
  Records& records_;
  [[nodiscard]] std::string name_of(const std::string& part) const;
};

}  // namespace roam::app
