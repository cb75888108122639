#include "view/bookmark_list.h"

#include <fmt/format.h>

#include <charconv>

#include "text/printable.h"

namespace roam::app {

void BookmarkList::add_to(Commands& commands, ListPanel& other) {
  commands.add("bookmarks", [this, &other] { toggle_instead_of(other); });
}

graphics::HudList BookmarkList::head() {
  const std::vector<std::string> names = records_.bookmark_names();
  rows_.clear();
  for (std::size_t i = 0; i < names.size(); ++i) rows_.push_back({printable(names[i]), std::to_string(i)});
  const std::string key = key_of(roamer_.controls(), "bookmark");
  const char* const deletes = names.empty() ? "" : "   right click: deletes";
  return {
      fmt::format("Bookmarks: {}{}", names.size(), deletes), (key.empty() ? key : key + ": ") + "keep this place", {}};
}

void BookmarkList::click(const std::string& part) {
  if (is_again()) return;
  if (part == graphics::Hud::list_search) return records_.add_bookmark();
  if (const std::string name = name_of(part); !name.empty()) records_.go_to_bookmark(name);
}

void BookmarkList::click_right(const std::string& part) {
  if (is_again()) return;  // the next row has moved there
  if (const std::string name = name_of(part); !name.empty()) records_.remove_bookmark(name);
}

/// The name of a row's bookmark; empty if there is none.
std::string BookmarkList::name_of(const std::string& part) const {
  const std::vector<std::string> names = records_.bookmark_names();
  std::size_t row = names.size();
  std::from_chars(part.data(), part.data() + part.size(), row);
  return row < names.size() ? names[row] : std::string();
}

}  // namespace roam::app
