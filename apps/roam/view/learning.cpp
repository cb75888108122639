#include "view/learning.h"

#include <fmt/format.h>

#include <utility>

#include "roam/error.h"
#include "scenes/frame.h"
#include "view/commands.h"

namespace roam::app {
namespace {

/// Seconds of free movement after which an offer expires.
constexpr double offer_lasts = 3.0;

/// "opening 0.71 m wide: a body of 0.34 m here".
std::string text_of(const Lesson& lesson) {
  if (lesson.kind == Lesson::Kind::narrower)
    return fmt::format("{}: a body of {:.2f} m here", lesson.region.why, lesson.region.radius);
  return fmt::format("crack {:.2f} m wide: a support disc of {:.2f} m", lesson.width, lesson.support_radius);
}

Profile known_of(const ViewOptions& options, const ViewPlan& plan, const SceneIdentity& scene,
                 const WalkerSettings& body) {
  if (plan.profile) return plan.profile->profile;
  Profile known;
  known.scene = scene;
  known.frame = frame_to_keep(options.scene);
  known.radius = body.radius;
  known.height = body.height;
  known.support_radius = body.support_radius;
  known.step = body.step;
  known.slope_degrees = body.slope_degrees;
  return known;
}

/// Whether the scene's profile has a body; true if it cannot be read.
bool has_body(const SceneOptions& scene) {
  try {
    return find_profile(scene.scenes).has_value();
  } catch (const Error&) {
    return true;
  }
}

/// The file for sizes; empty: they are not saved.
std::filesystem::path file_for(const ViewOptions& options, const ViewPlan& plan) {
  if (plan.profile) return plan.profile->file;
  std::filesystem::path file = profile_path(options.scene.scenes);
  // An existing body is another one and is not overwritten.
  if (options.scene.no_profile || has_body(options.scene)) file.clear();
  return file;
}

}  // namespace

Learning::Learning(const ViewOptions& options, const ViewPlan& plan, const SceneIdentity& scene,
                   osgRoam::Manipulator& roamer, News& news)
    : roamer_(roamer),
      news_(news),
      learner_(known_of(options, plan, scene, roamer.settings())),
      file_(file_for(options, plan)),
      takes_(options.adapt) {
  roamer_.setRegions(learner_.profile().regions);
}

void Learning::watch(const Vec3& wish, double seconds) {
  const Walker& walker = *roamer_.walker();
  if (std::optional<Lesson> lesson = learner_.watch(walker, wish, seconds)) {
    lesson_ = std::move(lesson);
    seconds_free_ = 0.0;
  } else if (lesson_ && !walker.report().blocked) {
    seconds_free_ += seconds;
    if (seconds_free_ > offer_lasts) lesson_.reset();
  }
}

bool Learning::update() {
  const bool wanted = std::exchange(accepted_, false) || takes_;
  if (!wanted || !lesson_ || roamer_.walker() == nullptr) return false;
  take(*std::exchange(lesson_, std::nullopt));
  return true;
}

void Learning::take(const Lesson& lesson) {
  learner_.take(*roamer_.walker(), lesson);
  ++taken_;
  roamer_.setRegions(learner_.profile().regions);
  // The learner has placed the body elsewhere.
  if (lesson.kind == Lesson::Kind::support) roamer_.placed();
  try {
    if (!file_.empty()) {
      save_profile(learner_.profile(), file_);
      learner_.saved();
    }
    news_.tell(text_of(lesson));
  } catch (const Error& error) {
    news_.note(fmt::format("{}; it could not be kept: {}", text_of(lesson), error.what()));
  }
}

void Learning::resize() {
  if (taken_ == 0 || roamer_.walker() == nullptr) return;
  roamer_.walker()->resize(learner_.profile().radius, learner_.profile().support_radius);
}

void Learning::fill(Status& status) const {
  const std::string key = key_of(roamer_.controls(), "adapt");
  if (!lesson_ || takes_ || key.empty()) return;
  std::string& text = status.hold.text;
  text += fmt::format("{}{} takes it: {}", text.empty() ? "" : "\n", key, text_of(*lesson_));
}

std::string size_reason(const Walker& walker) {
  for (const SizeRegion& region : walker.regions()) {
    if (region.radius != walker.body().radius) continue;
    if (region.bounds.holds(walker.position()) || region.bounds.holds(walker.feet())) return region.why;
  }
  return {};
}

}  // namespace roam::app
