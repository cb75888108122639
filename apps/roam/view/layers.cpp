#include "view/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "text/printable.h"
#include "view/patterns.h"

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

ListRow row_of(const SceneObjects::Entry& entry) {
  const std::string number = std::to_string(entry.node);
  ListRow row{printable(entry.name), box_part + number, {}, entry.is_open, entry.depth, box_of(entry.hidden)};
  if (entry.is_group) {
    row.text += fmt::format(" ({})", entry.objects);
    row.opens = arrow_part + number;
  }
  return row;
}

}  // namespace

Layers::Layers(Stage& stage, SceneGraph& scene, HiddenSpace& hidden, const osgRoam::Manipulator& roamer, Prompt& prompt,
               News& news)
    : ListPanel(stage, roamer), scene_(scene), hidden_(hidden), prompt_(prompt), news_(news) {}

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
    for (const SceneObjects::Entry& entry : scene_.objects().entries(open_, search_)) rows_.push_back(row_of(entry));
  }
  const SceneObjects::Count count = scene_.objects().count();
  return {fmt::format("Objects: {}, hidden: {}", count.objects, count.hidden),
          search_.empty() ? "search" : "search: " + printable(search_) + "   (click: ends)",
          {}};
}

void Layers::click(const std::string& part) {
  SceneObjects& objects = scene_.objects();
  if (part == graphics::Hud::list_search) return search();
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

void Layers::search() {
  if (!search_.empty()) {
    search_.clear();
    rows_changed_ = true;
    return;
  }
  prompt_.ask("Objects with", {}, [this](const std::string& text) {
    search_ = text;
    scroll_to_top();
    rows_changed_ = true;
  });
}

}  // namespace roam::app
