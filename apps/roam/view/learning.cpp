#include "view/learning.h"

#include <fmt/format.h>

#include <utility>

#include "roam/error.h"

namespace roam::app {
namespace {

/// Seconds after which nobody who went on wants what was offered any more.
constexpr double offer_lasts = 3.0;

/// "opening 0.71 m wide: a body of 0.34 m here".
std::string text_of(const Lesson& lesson) {
  if (lesson.kind == Lesson::Kind::narrower)
    return fmt::format("{}: a body of {:.2f} m here", lesson.region.why, lesson.region.radius);
  return fmt::format("gap of the floor {:.2f} m wide: a foot of {:.2f} m", lesson.width, lesson.support_radius);
}

}  // namespace

Learning::Learning(Profile known, std::filesystem::path file, bool takes)
    : learner_(std::move(known)), file_(std::move(file)), takes_(takes) {}

void Learning::watch(const Walker& walker, const Vec3& wish, double seconds) {
  if (std::optional<Lesson> lesson = learner_.watch(walker, wish, seconds)) {
    lesson_ = std::move(lesson);
    seconds_free_ = 0.0;
  } else if (lesson_ && !walker.report().blocked) {
    seconds_free_ += seconds;
    if (seconds_free_ > offer_lasts) lesson_.reset();
  }
}

std::string Learning::offer(const std::string& key) const {
  if (!lesson_ || takes_ || key.empty()) return {};
  return fmt::format("{} takes it: {}", key, text_of(*lesson_));
}

std::optional<Learning::Taken> Learning::take(Walker& walker, bool asked) {
  if (!lesson_ || !(takes_ || asked)) return std::nullopt;
  const Lesson lesson = *std::exchange(lesson_, std::nullopt);
  learner_.take(walker, lesson);
  ++taken_;
  Taken taken{{text_of(lesson), false}, lesson.kind == Lesson::Kind::support};
  if (file_.empty()) return taken;
  try {
    save_profile(learner_.profile(), file_);
    learner_.saved();
  } catch (const Error& error) {
    taken.told = {fmt::format("{}; it could not be kept: {}", text_of(lesson), error.what()), true};
  }
  return taken;
}

std::string size_reason(const Walker& walker) {
  for (const SizeRegion& region : walker.regions()) {
    if (region.radius != walker.body().radius) continue;
    if (region.bounds.holds(walker.position()) || region.bounds.holds(walker.feet())) return region.why;
  }
  return {};
}

}  // namespace roam::app
