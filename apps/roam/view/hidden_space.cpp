#include "view/hidden_space.h"

#include <fmt/format.h>

#include <utility>

#include "view/patterns.h"

namespace roam::app {
namespace {

/// Metres beyond which a triangle lies as a whole, so that nothing of it is seen, as the file has it: stored corners
/// are up to 2 mm off.
constexpr double margin = 5e-3;

/// A world without some objects and half spaces, which keeps it.
struct Reduced {
  Reduced(std::shared_ptr<const World> whole, std::span<const ObjectId> without, std::vector<HalfSpace> beyond)
      : world(std::move(whole)), space(*world) {
    for (HalfSpace& half : beyond) half.distance += margin;
    space.ignore_only(without);
    space.ignore_beyond(beyond);
  }
  std::shared_ptr<const World> world;
  Filtered space;
};

/// "a box and 2 planes"
std::string text_of(const SectionShape& section) {
  const std::size_t planes = section.planes.size();
  std::string text = section.box ? "a box" : "";
  if (planes > 0) text += fmt::format("{}{}", text.empty() ? "" : " and ", planes == 1 ? "a plane" : "");
  if (planes > 1) text += fmt::format("{} planes", planes);
  return text;
}

}  // namespace

HiddenSpace::HiddenSpace(SceneGraph& scene, const Arrival& arrival, osgRoam::Manipulator& roamer, News& news,
                         bool may_pass)
    : scene_(scene), arrival_(arrival), roamer_(roamer), news_(news), may_pass_(may_pass) {}

void HiddenSpace::add_to(Commands& commands) {
  commands.add("pass_hidden", [this] { pass_through(!passes_); });
}

/// Makes the spaces match what is hidden.
void HiddenSpace::update(const SectionShape& section) {
  if (passes_ && arrival_.pager() != nullptr) {
    passes_ = false;
    tell_of_store();
  }
  std::shared_ptr<const SceneObjects::Flags> flags = scene_.objects().flags();
  std::shared_ptr<const World> world = arrival_.world();
  std::vector<HalfSpace> hidden = section.hidden();
  if (flags == flags_ && world == world_ && hidden == section_) return;
  flags_ = std::move(flags);
  section_ = std::move(hidden);
  section_text_ = text_of(section);
  if (world != world_) use_world(std::move(world));
  const std::vector<ObjectId> without = hidden_objects();
  visible_.reset();
  if (world_ != nullptr && !(without.empty() && section_.empty())) {
    const auto reduced = std::make_shared<const Reduced>(world_, without, section_);
    visible_ = std::shared_ptr<const Space>(reduced, &reduced->space);
  }
  if (passes_) give_to_body();
}

void HiddenSpace::use_world(std::shared_ptr<const World> world) {
  world_ = std::move(world);
  ids_.clear();
  passes_ = passes_ && world_ != nullptr;
  if (world_ == nullptr) return;
  const std::vector<std::string>& names = arrival_.object_names();
  for (ObjectId id = 0; id < names.size(); ++id) ids_.emplace(names[id], id);
}

std::vector<ObjectId> HiddenSpace::hidden_objects() {
  std::vector<ObjectId> all;
  names_ = scene_.objects().hidden_names();
  for (const auto& [name, objects] : names_.names) {
    const auto [begin, end] = ids_.equal_range(name);
    // The body meets what its world has by another name.
    if (begin == end && world_ != nullptr) names_.left_over += objects;
    for (auto at = begin; at != end; ++at) all.push_back(at->second);
  }
  return all;
}

void HiddenSpace::pass_through(bool passes) {
  if (passes && arrival_.pager() != nullptr) return tell_of_store();
  if (passes && !may_pass_) {
    news_.tell("what is hidden stays a wall while all moves are verified, or follow a path");
    return;
  }
  if (passes_ == passes) return;
  passes_ = passes;
  if (passes) {
    news_.note("The body passes through what is hidden.");
  } else {
    news_.tell("The body meets what is hidden.");
  }
  give_to_body();
}

void HiddenSpace::give_to_body() {
  // While the walls are being loaded, the wish waits for them.
  if (world_ == nullptr) return;
  const std::shared_ptr<const Space> space = passes_ && visible_ != nullptr ? visible_ : world_;
  if (roamer_.space() != space) roamer_.setSpace(space);
}

void HiddenSpace::tell_of_store() {
  news_.note("With a store, the body meets what is hidden. Build one with --ignore to leave objects out.");
}

std::vector<std::string> HiddenSpace::passed() const {
  std::vector<std::string> patterns;
  if (!passes_) return patterns;
  for (const auto& [name, objects] : names_.names) {
    if (ids_.contains(name)) patterns.push_back(pattern_of(name));
  }
  return patterns;
}

void HiddenSpace::fill(Status& status) const {
  if (!section_.empty()) {
    status.section = section_text_ +
                     (passes_ ? "; the body passes through what is hidden whole" : "; the body meets what is hidden");
  }
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

void HiddenSpace::fill(ViewReport& report) const {
  report.hidden_objects = scene_.objects().count().hidden;
  report.passes_hidden = passes_;
}

}  // namespace roam::app
