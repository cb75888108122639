#include "view/hold.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "measure/room.h"
#include "measure/slope.h"
#include "roam/opening.h"
#include "text/printable.h"
#include "words/walk.h"

namespace roam::app {
namespace {

constexpr double news_seconds = 4.0;      // to read a sentence
constexpr double slowed_seconds = 0.5;    // s: as long as states that change from step to step are shown
constexpr double calm_seconds = 0.25;     // s: a shorter touch is no blockage, a shorter break does not end one
constexpr double measuring_period = 0.5;  // s
constexpr double level_cosine = 0.7071;   // 45 degrees: a wall, or a floor or ceiling

std::string describe(const Walker& walker, const Contact& contact, const Vec3& wish) {
  const std::string object = walker.space().object_name(contact.triangle);
  std::string text = !object.empty()                    ? printable(object)
                     : contact.normal.z > level_cosine  ? "the floor"
                     : contact.normal.z < -level_cosine ? "a ceiling"
                                                        : "a wall";
  const double length = glm::length(wish);
  if (length <= 0.0) return text;
  const auto opening = measure_opening(walker, wish / length);
  if (!opening) return text;
  const bool is_low = opening->kind == Opening::Kind::lintel;
  const double needed = is_low ? walker.body().height() : 2.0 * walker.settings().radius;
  text += fmt::format(": opening {:.2f} m {}for a body of {:.2f} m", opening->width, is_low ? "high " : "", needed);
  return text;
}

}  // namespace

void Hold::take(const Walker& walker, const Vec3& wish, double seconds, bool failing) {
  now_ += seconds;
  held_ = walker.held();
  if (!held_) nothing_below_ = false;
  note_unknown(walker, failing);
  note_events(walker);
  look_at_blockage(walker, wish, seconds);
  look_above(walker);
  level_ = walker.stance().level.value_or(level_);
}

void Hold::note_unknown(const Walker& walker, bool failing) {
  const StepReport& report = walker.report();
  if (report.has(EventKind::slowed)) slowed_at_ = now_;
  waiting_ = report.met_unknown;
  if (!waiting_ || !failing) {
    reason_.clear();
    return;
  }
  for (const Contact& contact : report.contacts) {
    if (!contact.unknown) continue;
    const std::string reason = walker.space().object_name(contact.triangle);
    // Another thread finds the reason; poll it in every step.
    if (!reason.empty()) reason_ = printable(reason);
    return;
  }
}

void Hold::note_events(const Walker& walker) {
  const auto tell = [&](std::string text, bool warning) {
    news_ = {std::move(text), warning};
    news_at_ = now_;
  };
  for (const Event& event : walker.report().events) {
    switch (event.kind) {
      case EventKind::fell:
        tell(words::is_too_steep(measure::slope_below(walker.space(), walker.body(), walker.position()),
                                 walker.settings())
                 ? "fell: the ground is too steep to stand on"
                 : "fell: the ground ends, or has a crack wider than the body bridges",
             true);
        break;
      case EventKind::landed:
        if (const double drop = level_ - walker.feet().z; drop > walker.fall_limit()) {
          tell(fmt::format("fell {:.1f} m", drop), true);
        }
        break;
      case EventKind::freed:
        tell("freed: the body did not fit there, and was put to the nearest free place", true);
        break;
      case EventKind::returned:
        tell("returned: no ghost any more, and put to the nearest free place", false);
        break;
      case EventKind::put_back:
        nothing_below_ = true;
        tell("put back: there is nothing below to stand on", true);
        break;
      default:
        break;
    }
  }
}

void Hold::look_at_blockage(const Walker& walker, const Vec3& wish, double seconds) {
  const StepReport& report = walker.report();
  const bool wished = glm::dot(wish, wish) > 0.0;
  if (report.blocked && wished && !report.contacts.empty()) {
    // A short break does not restart the count: a body that rattles along a wall is blocked too.
    blocked_for_ = now_ - blocked_at_ <= calm_seconds ? blocked_for_ + seconds : 0.0;
    blocked_at_ = now_;
    if (blocked_for_ < calm_seconds || now_ - measured_at_ < measuring_period) return;
    measured_at_ = now_;
    const Contact& contact = *most_against(report, wish);
    blockage_ = contact.unknown ? std::string() : describe(walker, contact, wish);
  } else if (now_ - blocked_at_ > calm_seconds || !wished) {
    blocked_for_ = 0.0;
    measured_at_ = -measuring_period;
    blockage_.clear();
  }
}

void Hold::look_above(const Walker& walker) {
  if (!walker.crouched() || held_ || waiting_) {
    looked_above_at_ = -measuring_period;
    above_.clear();
    return;
  }
  if (now_ - looked_above_at_ < measuring_period) return;
  looked_above_at_ = now_;
  above_.clear();
  const WalkerSettings settings = walker.settings();
  const measure::Room room(walker.space(), settings, walker.mode());
  const measure::Free above = room.headroom(walker.body(), walker.position());
  if (!above.bounded || above.distance >= settings.height) return;
  const std::string object = walker.space().object_name(above.triangle);
  above_ = fmt::format("crouched{}: the headroom is {:.2f} m, and the body {:.2f} m high",
                       object.empty() ? std::string() : " under " + printable(object), above.distance, settings.height);
}

Told Hold::told(const std::string& coming) const {
  const std::string ahead = coming.empty() ? "loading ahead" : coming;
  if (waiting_) return {"waiting: " + (reason_.empty() ? ahead : reason_), true};
  if (held_)
    return {nothing_below_ ? "held: there is nothing below to stand on" : "held: the body does not fit here", true};
  if (!blockage_.empty()) return {"blocked by " + blockage_, true};
  if (now_ - news_at_ <= news_seconds) return news_;
  if (!above_.empty()) return {above_, false};
  if (now_ - slowed_at_ <= slowed_seconds) return {"slowed: " + ahead, false};
  return {};
}

}  // namespace roam::app
