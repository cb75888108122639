#include "words/walk.h"

#include <fmt/format.h>

#include <algorithm>

#include "text/printable.h"
#include "words/measures.h"

namespace roam::words {
namespace {

std::string explain_blocked(const EndedWalk& walk) {
  const RouteResult& result = walk.result;
  if (!result.blocked_at) return fmt::format("it came no nearer to the next waypoint at {}", exactly_at(result.end));
  const Blockage& blockage = *result.blocked_at;
  std::string text = fmt::format("at {} by {} (triangle {}), touched at {}", exactly_at(result.end),
                                 quoted(walk.object), blockage.triangle, exactly_at(blockage.point));
  if (blockage.opening) {
    const Body body = walk.body.value_or(Body::capsule(walk.settings.radius, walk.settings.height));
    text += fmt::format("; the opening there is {:.3f} m, the body needs {:.3f} m across and {:.3f} m in height",
                        *blockage.opening, 2.0 * body.radius, body.height());
  } else if (walk.mode == Mode::walk && blockage.normal.z < 0.5) {
    text += "; there is no opening: lead the path around it";
  }
  return text;
}

/// Why a body did not go on though no wall was in its way.
std::string explain_wait(const EndedWalk& walk) {
  const RouteResult& result = walk.result;
  if (!result.blocked_at) {
    return fmt::format(
        "at {} the space ahead is not loaded fast enough; go slower, or read it from a faster disk or server",
        exactly_at(result.end));
  }
  return fmt::format("at {} the space ahead is solid until it is read, from {} on: {}", exactly_at(result.end),
                     exactly_at(result.blocked_at->point),
                     walk.object.empty() ? "not loaded yet" : printable(walk.object, longest_sentence));
}

std::string spans(const Box& box) { return fmt::format("{} to {}", exactly_at(box.lower), exactly_at(box.upper)); }

/// Whether the body has been held since it was put where it starts.
bool held_since_start(const RouteResult& result) {
  if (result.steps == 0) return true;
  const auto last = std::find_if(result.events.rbegin(), result.events.rend(),
                                 [](const RouteEvent& e) { return e.event.kind == EventKind::held; });
  return last != result.events.rend() && last->step == 0;
}

std::string explain_left(const EndedWalk& walk) {
  const RouteResult& result = walk.result;
  const std::string scene = walk.bounds.empty() ? "" : ", which spans " + spans(walk.bounds);
  if (walk.waypoints > 0) {
    return fmt::format("nothing of the scene{} lies ahead any more at {}; is the path in the scene's frame?",
                       scene.empty() ? "" : scene + ",", exactly_at(result.end));
  }
  if (result.steps == 0) {
    return fmt::format("its start, {} (--from), is outside the scene{}", exactly_at(result.end), scene);
  }
  return fmt::format("at {} it has wandered out of the scene{}", exactly_at(result.end), scene);
}

/// Whether the body met unknown space, or slowed down before it.
bool lacked_space(const RouteResult& result) {
  return first(result, EventKind::met_unknown) || first(result, EventKind::slowed);
}

std::string explain_held(const EndedWalk& walk) {
  const RouteResult& result = walk.result;
  const bool wanders = walk.waypoints == 0;
  if (held_since_start(result) && lacked_space(result)) {
    return fmt::format("the space around its start, {}, cannot be read, or not in time", exactly_at(result.end));
  }
  if (held_since_start(result)) {
    return fmt::format(
        "it does not fit where it starts, {}: it is inside a wall or too near to one, and no free place is close "
        "by; {} or take a smaller radius",
        exactly_at(result.end), wanders ? "start elsewhere (--from)" : "move the first waypoint");
  }
  if (!first(result, EventKind::put_back) && lacked_space(result)) return explain_wait(walk);
  return fmt::format("at {} there is no ground below to stand on; {}, or fly", exactly_at(result.end),
                     wanders ? "start elsewhere (--from)" : "move the waypoint onto the ground");
}

}  // namespace

std::optional<Vec3> first(const RouteResult& result, EventKind kind) {
  const auto found = std::find_if(result.events.begin(), result.events.end(),
                                  [kind](const RouteEvent& e) { return e.event.kind == kind; });
  if (found == result.events.end()) return std::nullopt;
  return found->event.point;
}

bool knows_clearance(const EndedWalk& walk) {
  return walk.mode != Mode::ghost && walk.result.least_axis_clearance > 0.0;
}

std::string note_on_size(const WalkerSettings& body, const Box& scene) {
  if (scene.empty()) return {};
  const Vec3 size = scene.size();
  const double across = 2.0 * body.radius;
  if (std::max(across, body.height) <= std::max({size.x, size.y, size.z})) return {};
  return fmt::format(
      "the body, {:g} m across and {:g} m high, is larger than the scene, {:.3g} x {:.3g} x {:.3g} m: are --radius, "
      "--height and --unit right?",
      across, body.height, size.x, size.y, size.z);
}

bool is_too_steep(const std::optional<double>& slope, const WalkerSettings& body) {
  constexpr double wall = 80.0;  // degrees: the side of a crack
  return slope && *slope > body.slope_degrees && *slope < wall;
}

const char* outcome(const EndedWalk& walk) { return walk.interrupted ? "interrupted" : to_string(walk.result.outcome); }

namespace {

/// What ended a walk before its end, in a few words.
std::string stopped(const EndedWalk& walk) {
  const RouteResult& result = walk.result;
  switch (result.outcome) {
    case Outcome::reached:
      break;
    case Outcome::blocked:
      return result.blocked_at ? "blocked by " + quoted(walk.object) : "blocked";
    case Outcome::left_scene:
      return result.steps == 0 ? "starts outside the scene" : "left the scene";
    case Outcome::fell:
      return "fell";
    case Outcome::held:
      return held_since_start(result) && !lacked_space(result)             ? "does not fit where it starts"
             : first(result, EventKind::put_back) || !lacked_space(result) ? "no ground below"
                                                                           : "the space ahead is not loaded";
  }
  return {};
}

}  // namespace

std::string headline(const EndedWalk& walk) {
  const RouteResult& result = walk.result;
  const bool wanders = walk.waypoints == 0;
  const std::string way = fmt::format("{:.1f} m in {:.1f} s", result.length, result.simulated);
  if (walk.interrupted) return "INTERRUPTED after " + way;
  if (result.outcome == Outcome::reached && wanders) return "FINISHED: wandered " + way;
  if (result.outcome == Outcome::reached) {
    return fmt::format("REACHED: {} of {} waypoints, {}", result.waypoints, walk.waypoints, way);
  }
  std::string text = (wanders ? "STOPPED: " : "NOT REACHED: ") + stopped(walk);
  if (result.length > 0.0) text += " after " + way;
  if (!wanders) text += fmt::format(", {} of {} waypoints", result.waypoints, walk.waypoints);
  return text;
}

std::string narrowest_place(const EndedWalk& walk) {
  if (walk.mode == Mode::ghost || walk.reach <= 0.0 || walk.result.length <= 0.0) return {};
  if (!walk.narrowest) return fmt::format("none: nowhere was there a wall within {:.1f} m on both sides", walk.reach);
  const measure::NarrowPlace& n = *walk.narrowest;
  const std::string objects = between(walk.left, walk.right);
  return fmt::format("{:.3f} m clear{} at {:.1f} m, {}: {}", n.width, objects.empty() ? "" : " " + objects, n.along,
                     at(n.centre), spare_words(n.spare()));
}

std::string headroom(const EndedWalk& walk) {
  if (walk.mode != Mode::walk || walk.reach <= 0.0 || walk.result.length <= 0.0) return {};
  const std::string ducked = walk.ducked > 0 ? "ducked " + times(walk.ducked) + "; " : "";
  if (!walk.lowest) return ducked + "open above";
  const measure::LowPlace& low = *walk.lowest;
  return fmt::format("{}{} at the lowest, at {:.1f} m, {}", ducked, metres(low.height), low.along, at(low.centre));
}

std::string explain(const EndedWalk& walk) {
  const RouteResult& result = walk.result;
  if (walk.interrupted) {
    return fmt::format("a signal ended it at {} after {:.2f} m in {:.1f} s, {} steps", exactly_at(result.end),
                       result.length, result.simulated, result.steps);
  }
  switch (result.outcome) {
    case Outcome::reached:
      if (walk.waypoints == 0) return fmt::format("the end of its time, having wandered to {}", exactly_at(result.end));
      return fmt::format("came to the last of {} waypoints at {}", walk.waypoints, exactly_at(result.end));
    case Outcome::blocked:
      return explain_blocked(walk);
    case Outcome::left_scene:
      return explain_left(walk);
    case Outcome::fell: {
      const Vec3 from = first(result, EventKind::fell).value_or(result.end);
      const WalkerSettings& s = walk.settings;
      if (is_too_steep(walk.slope, s)) {
        return fmt::format(
            "at {} the ground is too steep to stand on: {:.0f} degrees, more than {:g}; lead the path around it, or "
            "allow more (--slope)",
            exactly_at(from), *walk.slope, s.slope_degrees);
      }
      const bool disc = s.support_radius > s.radius;
      return fmt::format("at {} the ground ends, or has a crack that a {} of {:g} m does not bridge; a larger one may",
                         exactly_at(from), disc ? "support radius" : "radius", disc ? s.support_radius : s.radius);
    }
    case Outcome::held:
      return explain_held(walk);
  }
  return {};
}

}  // namespace roam::words
