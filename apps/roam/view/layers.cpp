#include "view/layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "osgroam/pointer.h"
#include "text/printable.h"
#include "view/patterns.h"

namespace roam::app {
namespace {

using Adapter = osgGA::GUIEventAdapter;
using graphics::ListRow;

// Names of the list's parts, besides those of nodes: a letter and a number.
constexpr const char* pass_row = "pass";
constexpr const char* all_row = "all";
constexpr char box_part = 'b', arrow_part = 'a';

constexpr double notch_rows = 3.0;

/// A world without some objects, which keeps it.
struct Reduced {
  Reduced(std::shared_ptr<const World> whole, std::span<const ObjectId> without)
      : world(std::move(whole)), space(*world) {
    space.ignore_only(without);
  }
  std::shared_ptr<const World> world;
  Filtered space;
};

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

Layers::Layers(Stage& stage, SceneGraph& scene, const Arrival& arrival, osgRoam::Manipulator& roamer, Prompt& prompt,
               News& news, bool may_pass)
    : stage_(stage),
      scene_(scene),
      arrival_(arrival),
      roamer_(roamer),
      prompt_(prompt),
      news_(news),
      may_pass_(may_pass) {}

void Layers::add_to(Commands& commands) {
  commands.add("layers", [this] { shown_ = !shown_; });
}

void Layers::update() {
  follow();
  note_vain_patterns(false);
  show_list();
}

/// Makes the spaces match what is hidden.
void Layers::follow() {
  if (passes_ && arrival_.pager() != nullptr) {
    passes_ = false;
    rows_changed_ = true;
    tell_of_store();
  }
  std::shared_ptr<const SceneObjects::Flags> flags = scene_.objects().flags();
  std::shared_ptr<const World> world = arrival_.world();
  if (flags == flags_ && world == world_) return;
  rows_changed_ = rows_changed_ || flags != flags_;
  flags_ = std::move(flags);
  names_ = scene_.objects().hidden_names();
  if (world != world_) {
    world_ = std::move(world);
    ids_.clear();
    passes_ = passes_ && world_ != nullptr;
    if (world_ != nullptr) {
      const std::vector<std::string>& names = arrival_.object_names();
      for (ObjectId id = 0; id < names.size(); ++id) ids_.emplace(names[id], id);
    }
  }
  std::vector<ObjectId> without;
  for (const auto& [name, objects] : names_.names) {
    const auto [begin, end] = ids_.equal_range(name);
    // The body meets what its world has by another name.
    if (begin == end && world_ != nullptr) names_.left_over += objects;
    for (auto at = begin; at != end; ++at) without.push_back(at->second);
  }
  visible_.reset();
  if (world_ != nullptr && !without.empty()) {
    const auto reduced = std::make_shared<const Reduced>(world_, without);
    visible_ = std::shared_ptr<const Space>(reduced, &reduced->space);
  }
  if (passes_) pass_through(true);
}

void Layers::pass_through(bool passes) {
  if (passes && arrival_.pager() != nullptr) return tell_of_store();
  if (passes && !may_pass_) {
    news_.tell("objects stay walls while all moves are verified, or follow a path");
    return;
  }
  passes_ = passes;
  rows_changed_ = true;
  // While the walls are being loaded, the wish waits for them.
  if (world_ == nullptr) return;
  const std::shared_ptr<const Space> space = passes && visible_ != nullptr ? visible_ : world_;
  if (roamer_.space() != space) roamer_.setSpace(space);
}

void Layers::tell_of_store() { news_.tell("a store keeps its objects: build one with --ignore to leave some out"); }

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

void Layers::show_list() {
  graphics::Hud& hud = stage_.hud();
  if (!shown_) {
    hud.set_list(std::nullopt);
    return;
  }
  const SceneObjects::Count count = scene_.objects().count();
  if (std::exchange(rows_changed_, false)) {
    rows_.clear();
    rows_.push_back({"the body passes through what is hidden",
                     pass_row,
                     {},
                     false,
                     0,
                     passes_ ? ListRow::Box::on : ListRow::Box::off});
    // Always there: rows must not move under the mouse.
    rows_.push_back({"show all", all_row, {}, false, 0, ListRow::Box::none});
    for (const SceneObjects::Entry& entry : scene_.objects().entries(open_, search_)) rows_.push_back(row_of(entry));
  }
  const std::size_t room = std::max<std::size_t>(1, hud.list_rows());
  first_ = std::min(first_, rows_.size() - std::min(rows_.size(), room));
  const std::size_t end = std::min(rows_.size(), first_ + room);
  graphics::HudList list;
  list.title = fmt::format("Objects: {}, hidden: {}", count.objects, count.hidden);
  if (rows_.size() > room) list.title += fmt::format("   {} %", 100 * end / rows_.size());
  list.search = search_.empty() ? "search" : "search: " + printable(search_) + "   (click: ends)";
  list.rows.assign(rows_.begin() + static_cast<std::ptrdiff_t>(first_),
                   rows_.begin() + static_cast<std::ptrdiff_t>(end));
  hud.set_list(std::move(list));
}

bool Layers::handle(const Adapter& event, osgGA::GUIActionAdapter& /*action*/) {
  graphics::Hud& hud = stage_.hud();
  // A button that was pressed here belongs to the list until its release, even if the list was closed meanwhile.
  if (event.getEventType() == Adapter::RELEASE) return std::exchange(is_down_, false);
  if (event.getEventType() == Adapter::PUSH) is_down_ = false;
  if (event.getHandled() || !shown_ || roamer_.mouseGrab() || hud.help_shown()) return false;
  const double x = event.getXnormalized(), y = event.getYnormalized();
  const bool here = hud.list_covers(x, y);
  switch (event.getEventType()) {
    case Adapter::PUSH:
    case Adapter::DOUBLECLICK:
      if (!here || event.getButton() == 0) return here;
      is_down_ = true;
      click(hud.list_at(x, y));
      return true;
    case Adapter::DRAG:
      return is_down_;
    case Adapter::MOVE:
      hud.set_list_focus(hud.list_at(x, y));
      return here;
    case Adapter::SCROLL:
      if (here) scroll(osgRoam::notches_of(event));
      return here;
    default:
      return false;
  }
}

void Layers::scroll(double notches) {
  const double first = static_cast<double>(first_) - std::round(notch_rows * notches);
  first_ = static_cast<std::size_t>(std::clamp(first, 0.0, static_cast<double>(rows_.size())));
}

void Layers::click(const std::string& part) {
  SceneObjects& objects = scene_.objects();
  if (part == graphics::Hud::list_search) return search();
  if (part == pass_row) return pass_through(!passes_);
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
    first_ = 0;
    rows_changed_ = true;
  });
}

std::vector<std::string> Layers::passed() const {
  std::vector<std::string> patterns;
  if (!passes_) return patterns;
  for (const auto& [name, objects] : names_.names) {
    if (ids_.contains(name)) patterns.push_back(pattern_of(name));
  }
  return patterns;
}

void Layers::fill(Status& status) const {
  const SceneObjects::Count count = scene_.objects().count();
  if (count.hidden == 0) return;
  status.hidden = fmt::format("{} of {} objects; ", count.hidden, count.objects);
  if (!passes_) {
    status.hidden += "the body meets them";
  } else if (names_.left_over == 0) {
    status.hidden += "the body passes through";
  } else {
    status.hidden +=
        fmt::format("the body passes through, except {} that it cannot tell by their names", names_.left_over);
  }
}

void Layers::fill(ViewReport& report) const {
  report.hidden_objects = scene_.objects().count().hidden;
  report.passes_hidden = passes_;
}

}  // namespace roam::app
