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
  return {fmt::format("Bookmarks: {}", names.size()), (key.empty() ? key : key + ": ") + "keep this place", {}};
}

void BookmarkList::click(const std::string& part) {
  if (part == graphics::Hud::list_search) return records_.add_bookmark();
  const std::vector<std::string> names = records_.bookmark_names();
  std::size_t row = names.size();
  std::from_chars(part.data(), part.data() + part.size(), row);
  if (row < names.size()) records_.go_to_bookmark(names[row]);
}

}  // namespace roam::app
