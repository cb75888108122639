#include "view/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "text/printable.h"
#include "view/patterns.h"
#include "view/prompt.h"

namespace roam::app {
namespace {

using graphics::ListRow;

// Names of the list's parts, besides those of nodes: a letter and a number.
constexpr const char* pass_row = "pass";
constexpr const char* all_row = "all";
constexpr char box_part = 'b', arrow_part = 'a';

ListRow::Box box_of(SceneObjects::Hidden hidden) {
  return hidden == SceneObjects::Hidden::none  ? ListRow::Box::on
         : hidden == SceneObjects::Hidden::all ? ListRow::Box::off
                                               : ListRow::Box::half;
}

/// A name without the identifier that IFC puts at its end: "Wall_0YvctVUKr0kugbFTf53O9L".
std::string without_guid(const std::string& name) {
  constexpr std::size_t letters = 22;
  if (name.size() < letters + 2) return name;
  const std::size_t at = name.size() - letters;
  const bool is_guid =
      (name[at - 1] == '_' || name[at - 1] == ' ') && name[at] >= '0' && name[at] <= '3' &&
      std::all_of(name.begin() + static_cast<std::ptrdiff_t>(at), name.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$';
      });
  return is_guid ? name.substr(0, at - 1) : name;
}

/// `is_unique`: no other row has this name without its identifier.
ListRow row_of(const SceneObjects::Entry& entry, const std::string& name, bool is_unique) {
  const std::string number = std::to_string(entry.node);
  const bool has_guid = name != entry.name;
  ListRow row{printable(is_unique ? name : entry.name),
              box_part + number,
              {},
              entry.is_open,
              entry.depth,
              box_of(entry.hidden),
              has_guid};
  if (entry.is_group) {
    row.text += fmt::format(" ({})", entry.objects);
    row.opens = arrow_part + number;
  }
  return row;
}

}  // namespace

Layers::Layers(Stage& stage, SceneGraph& scene, HiddenSpace& hidden, const osgRoam::Manipulator& roamer, News& news)
    : ListPanel(stage, roamer, news), scene_(scene), hidden_(hidden) {}

void Layers::add_to(Commands& commands, ListPanel& other) {
  commands.add("layers", [this, &other] { toggle_instead_of(other); });
}

void Layers::update() {
  std::shared_ptr<const SceneObjects::Flags> flags = scene_.objects().flags();
  rows_changed_ = rows_changed_ || flags != rows_flags_ || rows_pass_ != hidden_.passes();
  rows_flags_ = std::move(flags);
  rows_pass_ = hidden_.passes();
  note_vain_patterns(false);
}

void Layers::note_vain_patterns(bool at_end) {
  // Pages may bring further names.
  const bool all_known = scene_.report() && !scene_.is_paged();
  if (patterns_told_ || !(all_known || at_end)) return;
  patterns_told_ = true;
  for (const std::string& pattern : scene_.objects().unmatched()) {
    news_.note(fmt::format("No object's name{} matches '{}'; nothing was hidden.",
                           all_known ? "" : " that was read so far", printable(pattern)));
  }
}

graphics::HudList Layers::head() {
  if (std::exchange(rows_changed_, false)) {
    rows_.clear();
    rows_.push_back({"the body passes through what is hidden",
                     pass_row,
                     {},
                     false,
                     0,
                     rows_pass_ ? ListRow::Box::on : ListRow::Box::off});
    // Always there: rows must not move under the mouse.
    rows_.push_back({"show all", all_row, {}, false, 0, ListRow::Box::none});
    const std::vector<SceneObjects::Entry> entries = scene_.objects().entries(open_, search_);
    std::map<std::string, std::size_t> names;
    for (const SceneObjects::Entry& entry : entries) ++names[without_guid(entry.name)];
    for (const SceneObjects::Entry& entry : entries) {
      const std::string name = without_guid(entry.name);
      rows_.push_back(row_of(entry, name, names[name] == 1));
    }
  }
  const SceneObjects::Count count = scene_.objects().count();
  return {fmt::format("Objects: {}, hidden: {}", count.objects, count.hidden),
          search_.empty() ? "type to search" : "search: " + printable(search_) + "_   (click: ends)",
          {}};
}

void Layers::click(const std::string& part) {
  SceneObjects& objects = scene_.objects();
  if (part == graphics::Hud::list_search) return end_search();
  if (part == pass_row) return hidden_.pass_through(!hidden_.passes());
  if (part == all_row) return objects.show_all();
  SceneObjects::Number node = 0;
  if (part.size() < 2 || std::from_chars(part.data() + 1, part.data() + part.size(), node).ec != std::errc()) return;
  if (part[0] == arrow_part) {
    if (open_.erase(node) == 0) open_.insert(node);
    rows_changed_ = true;
    return;
  }
  const auto row = std::find_if(rows_.begin(), rows_.end(), [&](const ListRow& one) { return one.name == part; });
  if (row != rows_.end()) objects.set_hidden(node, row->box != ListRow::Box::off);
}

void Layers::end_search() {
  if (search_.empty()) return hint("Type a part of a name");
  search_.clear();
  rows_changed_ = true;
}

bool Layers::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) {
  using Adapter = osgGA::GUIEventAdapter;
  constexpr int other_keys = Adapter::MODKEY_CTRL | Adapter::MODKEY_ALT;
  const bool typed =
      event.getEventType() == Adapter::KEYDOWN && !event.getHandled() && (event.getModKeyMask() & other_keys) == 0;
  if (typed && takes_keys() && type(event.getKey())) return true;
  return ListPanel::handle(event, action);
}

/// Whether the key is one for the search.
bool Layers::type(int key) {
  constexpr std::size_t longest = 60;  // bytes
  std::string text = search_;
  if (key == osgGA::GUIEventAdapter::KEY_BackSpace) {
    remove_character(text);
  } else if (text.size() < longest && (key != ' ' || !text.empty())) {
    append_character(text, key);
  }
  if (text == search_) return false;
  search_ = text;
  scroll_to_top();
  rows_changed_ = true;
  return true;
}

}  // namespace roam::app
