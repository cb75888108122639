#include "view/hidden_space.h"

#include <fmt/format.h>

#include <utility>

#include "view/patterns.h"

namespace roam::app {
namespace {

/// Metres beyond which a triangle lies as a whole, so that nothing of it is seen, as the file has it: stored corners
/// are up to 2 mm off.
constexpr double margin = 5e-3;

/// A filter that keeps its space.
template <class Kept>
std::shared_ptr<Filtered> filter_of(std::shared_ptr<Kept> space) {
  struct Both {
    explicit Both(std::shared_ptr<Kept> space) : kept(std::move(space)), filtered(*kept) {}
    std::shared_ptr<Kept> kept;
    Filtered filtered;
  };
  const auto both = std::make_shared<Both>(std::move(space));
  return {both, &both->filtered};
}

/// "a box of 8.00 x 5.20 x 2.50 m and 2 planes, the last at z = 2.40 m"
std::string text_of(const SectionShape& section) {
  const std::size_t planes = section.planes.size();
  std::string text = section.box ? "a box of " + size_text(*section.box) : "";
  if (planes == 0) return text;
  if (section.box) text += " and ";
  text += planes == 1 ? "a plane at " : fmt::format("{} planes, the last at ", planes);
  return text + place_text(section.planes.back());
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
  std::shared_ptr<const SceneObjects::Flags> flags = scene_.objects().flags();
  std::shared_ptr<const World> world = arrival_.world();
  const std::shared_ptr<Pager>& pager = arrival_.pager();
  std::vector<HalfSpace> hidden = section.hidden();
  if (flags == flags_ && world == world_ && pager == pager_ && hidden == section_) return;
  flags_ = std::move(flags);
  section_ = std::move(hidden);
  section_text_ = text_of(section);
  beyond_ = section_;
  for (HalfSpace& half : beyond_) half.distance += margin;
  if (world != world_ || pager != pager_) use(std::move(world), pager);
  without_ = hidden_objects();
  visible_.reset();
  if (world_ != nullptr && !(without_.empty() && beyond_.empty())) {
    const std::shared_ptr<Filtered> visible = filter_of(world_);
    visible->ignore_only(without_);
    visible->ignore_beyond(beyond_);
    visible_ = visible;
  }
  if (passes_) give_to_body();
  tell_of_store();
}

void HiddenSpace::use(std::shared_ptr<const World> world, std::shared_ptr<Pager> pager) {
  world_ = std::move(world);
  pager_ = std::move(pager);
  open_.reset();
  ids_.clear();
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
  tell_of_store();
}

/// Lets the body pass, or meet everything.
void HiddenSpace::give_to_body() {
  // While the walls are being loaded, the wish waits for them.
  if (world_ == nullptr && pager_ == nullptr) return;
  if (!passes_) {
    if (open_ == nullptr || roamer_.space() != open_) return;
    if (pager_) return roamer_.setSpace(pager_);
    return roamer_.setSpace(std::shared_ptr<const Space>(world_));
  }
  if (open_ == nullptr) open_ = pager_ ? filter_of(pager_) : filter_of(world_);
  open_->ignore_only(without_);
  open_->ignore_beyond(beyond_);
  // A new space would put the body to rest.
  if (roamer_.space() != open_) roamer_.setSpace(open_);
}

HiddenSpace::Met HiddenSpace::met() const {
  if (open_ == nullptr || roamer_.space() != open_) return {roamer_.space(), {}};
  if (pager_) return {pager_, beyond_};
  return {visible_ != nullptr ? visible_ : world_, {}};
}

/// Once for each time that it begins to be so.
void HiddenSpace::tell_of_store() {
  if (std::exchange(told_of_store_, keeps_objects()) || !told_of_store_) return;
  news_.note("With a store, the body meets hidden objects. Build one with --ignore to leave objects out.");
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
  if (!passes_ || keeps_objects()) {
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
  report.passes_objects = passes_ && pager_ == nullptr;
  report.passes_section = is_section_open();
}

}  // namespace roam::app
