#include "words/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/floating_point.h"
#include "math/level_distance.h"
#include "text/number.h"
#include "words/lines.h"
#include "words/measures.h"

namespace roam::words {

using Kind = ProbeLimit::Kind;

namespace {

/// The measured extent: the height if `direction` is steep, else the width.
const char* extent(const ProbeLimit& limit) { return std::abs(limit.direction.z) > 0.7 ? "high" : "wide"; }

}  // namespace

bool is_end(Kind kind) { return kind == Kind::start || kind == Kind::target; }

const char* end_name(Kind kind) { return kind == Kind::start ? "start" : "target"; }

const char* end_letter(Kind kind) { return kind == Kind::start ? "A" : "B"; }

bool is_shut(const ProbeAnswer& answer) {
  const Passage& p = answer.passage;
  return !p.found && p.complete && answer.proven && p.bound <= answer.narrowest;
}

bool is_unknown(const ProbeAnswer& answer) {
  return !answer.wide_enough && !answer.passage.found && !answer.passage.complete && !answer.proven;
}

bool falls(const ProbeWalk& walk, Mode mode) {
  return walk.outcome == Outcome::fell || (mode == Mode::walk && walk.outcome == Outcome::left_scene);
}

std::string text_of(const ProbeLimit& limit) {
  switch (limit.kind) {
    case Kind::door:
    case Kind::gap:
      return fmt::format("{} {} {}", limit.kind == Kind::door && limit.has_head ? "door" : "gap", metres(limit.size),
                         extent(limit));
    case Kind::lintel:
      return fmt::format("lintel, {} wide", metres(limit.size));
    case Kind::start:
    case Kind::target:
      return fmt::format("{}: {} {}", end_letter(limit.kind), metres(limit.size),
                         limit.too_low ? "below what is above it" : "free beside it");
    case Kind::height:
      return fmt::format("headroom {}", metres(limit.size));
    case Kind::edge:
      return fmt::format("floor only {} wide", metres(limit.size));
    case Kind::step:
      return fmt::format("step of {}", metres(limit.size));
    case Kind::apart:
      return "nearest approach";
  }
  return "";
}

std::vector<ProbeMark> marks_of(const ProbeAnswer& answer) {
  std::vector<ProbeMark> marks;
  if (answer.limit) marks.push_back({answer.limit->point, text_of(*answer.limit), answer.wide_enough});
  if (answer.other) marks.push_back({answer.other->point, text_of(*answer.other), false});
  for (const ProbeDrop& drop : answer.drops)
    marks.push_back({drop.rim, "one way: down " + metres(drop.height()), true});
  if (answer.walk && !answer.passable)
    marks.push_back({answer.walk->at, std::string("walker ") + to_string(answer.walk->outcome), false});
  return marks;
}

namespace {

/// Metres. An end that was moved farther than this is mentioned, with both positions.
constexpr double moved_aside = 0.005;
constexpr double tall = 2.0;  ///< m: eyes are at most this far above the feet

/// ""SofaC_01", 0.79 m above the floor".
std::string standing_on(const Ground& ground) {
  const std::string above = fixed_text(ground.above, 2) + " m above the floor";
  return ground.object.empty() ? above : fmt::format("on {}, {}", quoted(ground.object), above);
}

/// No way was found for any size. For Kind::apart, `limit` is where the two sides come nearest.
std::string no_way(const ProbeAnswer& answer) {
  const ProbedSize& size = answer.size;
  std::string text = fmt::format("{} for a body {}: the places reached from A and those reached from B do not meet",
                                 is_shut(answer) ? "there is no way, even" : "no way was found, even",
                                 size_of(answer.narrowest, std::max(size.height, 2.0 * answer.narrowest)));
  if (answer.limit) return text + fmt::format("; they are nearest at {}", at(answer.limit->point));
  const double rise = answer.target.z - answer.start.z;
  if (std::abs(rise) <= tall) return text;
  return text + fmt::format(". B lies {:.1f} m {}; no stairs or ramp join the two", std::abs(rise),
                            rise > 0.0 ? "higher" : "lower");
}

/// The search reached a limit, of places or of drops.
std::string ended(const Passage& p) {
  return fmt::format("the search ended at a limit after {} places. A wider spacing (--spacing) needs fewer",
                     grouped(p.places));
}

/// The certified upper bound on the width of ways.
std::string certified(const Passage& p) {
  return fmt::format("it is proven that nothing wider than {:.3f} m passes", up_to_mm(2.0 * p.bound));
}

/// How certain a "no" is.
std::string certainty(const ProbeQuestion& question, const ProbeAnswer& answer) {
  const Passage& p = answer.passage;
  if (answer.passable) return "a walker of that size has gone the way from A to B";
  if (answer.wide_enough || is_unknown(answer)) return {};
  if (answer.limit && (is_end(answer.limit->kind) || answer.limit->too_low)) return {};
  if (!p.complete && !answer.proven) return "no proof: " + ended(p);
  if (!p.complete) return fmt::format("{}; for narrower bodies {}", certified(p), ended(p));
  if (is_shut(answer)) return "it is proven that there is no way";
  // The proof leaves an interval open, and the body's radius may lie in it.
  if (p.found && (answer.proven || p.proven)) return certified(p);
  const std::string missed = fmt::format("openings under {:.2g} m may have been missed", 0.7 * question.spacing);
  if (answer.proven) return fmt::format("{}; for narrower bodies {}", certified(p), missed);
  return fmt::format("no proof: the search looked at places {:g} m apart; {}", question.spacing, missed);
}

/// The walker's last position, reported like all positions: of the feet when walking, of the centre when flying.
std::string walked_to(const ProbeQuestion& question, const ProbeAnswer& answer) {
  Vec3 place = answer.walk->at;
  if (question.mode == Mode::walk) place.z -= 0.5 * answer.size.height;
  return at(place);
}

const char* shortfall(const ProbeLimit& limit) {
  if (limit.kind == Kind::height || limit.too_low || std::abs(limit.direction.z) > 0.7) return "too low";
  return limit.kind == Kind::step ? "too high" : is_end(limit.kind) ? "too near" : "too narrow";
}

/// "the body at (1.00, 2.00, 3.00) is 0.318 m from "a"".
std::string end_words(const ProbeLimit& limit, const std::string& name) {
  return fmt::format("the {} at {} is {} {} {}", limit.too_low ? "floor" : "body", at(limit.feet), metres(limit.size),
                     limit.too_low ? "below" : "from", name.empty() ? "the next surface" : quoted(name));
}

/// "door 0.750 m wide between "a" and "b" at (1.00, 2.00, 3.00)".
std::string obstacle(const ProbeLimit& limit, const std::string& left, const std::string& right) {
  const std::string& name = left.empty() ? right : left;
  if (is_end(limit.kind)) return end_words(limit, name);
  if (limit.kind == Kind::edge) {
    return fmt::format("floor only {} wide beside {} at {}", metres(limit.size), name.empty() ? "a wall" : quoted(name),
                       at(limit.point));
  }
  const std::string objects = between(left, right);
  return fmt::format("{}{} at {}", text_of(limit), objects.empty() ? "" : " " + objects, at(limit.point));
}

/// ": 0.150 m too narrow".
std::string short_by(const ProbeLimit& limit) {
  const double missing = std::abs(limit.needed - limit.size);
  return fmt::format("{} {} {}", is_end(limit.kind) ? "," : ":", missing < 1e-3 ? "less than 1 mm" : metres(missing),
                     shortfall(limit));
}

std::string stop_line(const ProbeQuestion& question, const ProbeAnswer& answer, const ProbeDetails& details) {
  if (answer.walk && falls(*answer.walk, question.mode)) {
    return fmt::format(
        "a fall at {}: the floor ends there, or has a crack. A wider support disc (--support-radius) may carry the "
        "body",
        walked_to(question, answer));
  }
  if (answer.walk) {
    const Outcome outcome = answer.walk->outcome;
    const std::string step = answer.walk->step > 0.0
                                 ? fmt::format(": a step there is {} high, and the body steps {}",
                                               metres(answer.walk->step), metres(climbed(question, answer.size)))
                                 : "";
    return fmt::format("a walker sent along the way {} at {}, although the measured way is wide enough{}",
                       outcome == Outcome::left_scene ? "left the scene"
                       : outcome == Outcome::held     ? "was held"
                                                      : "was blocked",
                       walked_to(question, answer), step);
  }
  if (is_unknown(answer)) return ended(answer.passage);
  if (!answer.limit && !answer.passage.found && !answer.passage.complete) return {};  // certainty() says it
  if (!answer.limit && answer.passage.found)
    return fmt::format("no way leaves more than {}", metres(2.0 * answer.passage.radius));
  if (!answer.limit || answer.limit->kind == Kind::apart) return no_way(answer);
  std::string text = obstacle(*answer.limit, details.left, details.right);
  if (is_end(answer.limit->kind)) text = fmt::format("no room at {}: {}", end_letter(answer.limit->kind), text);
  if (answer.limit->kind == Kind::step) {
    text += fmt::format("; the body steps {}", metres(answer.limit->needed));
  } else {
    text += short_by(*answer.limit);
  }
  return answer.room ? text + fmt::format("; the nearest place with room is {}", at(*answer.room)) : text;
}

/// The sizes that would pass.
std::string would_pass(const ProbeAnswer& answer) {
  if (answer.wide_enough || is_unknown(answer)) return {};
  std::string text;
  if (answer.limit && answer.limit->kind == Kind::height && !answer.other)
    text = fmt::format("a body of that width up to {:.3f} m high", down_to_mm(answer.limit->size));
  if (answer.passing > 0.0)
    text += fmt::format("{}up to {:.3f} m wide", text.empty() ? "" : ", or of that height ", 2.0 * answer.passing);
  return text;
}

std::string way_line(const Passage& p, const ProbeDetails& details) {
  std::string text = fmt::format("{:.1f} m long", p.length);
  if (!details.slope) return text;
  const measure::Slope& s = *details.slope;
  if (s.degrees < 0.5) return text + ", level";
  return text + fmt::format(", up {:.2f} m and down {:.2f} m; steepest {:.0f} degrees, at {}", s.rise, s.fall,
                            s.degrees, at(s.place));
}

std::string narrowest_line(const ProbeAnswer& answer, const ProbeDetails& details) {
  if (!answer.limit) return fmt::format("nothing leaves less than {}", metres_down(2.0 * answer.passage.radius));
  const ProbeLimit& limit = *answer.limit;
  std::string text = obstacle(limit, details.left, details.right);
  text = is_end(limit.kind) ? fmt::format("at {}: {}", end_letter(limit.kind), text)
                            : fmt::format("{}, {:.1f} m on the way", text, limit.along);
  if (limit.kind == Kind::door || limit.kind == Kind::gap)
    text += ": " + spare_words(0.5 * (limit.size - limit.needed));
  return text;
}

/// "(1.00, 2.00, 0.00), moved by 0.30 m: there is no room at (1.00, 2.30, 0.05)".
std::string end_line(const Vec3& asked, const Vec3& stands, Mode mode, const Ground& ground) {
  std::string text = at(stands);
  if (mode == Mode::walk) text = (ground.above > 0.0 ? standing_on(ground) + ", at " : "on the floor at ") + text;
  const double aside = mode == Mode::walk ? level_distance(stands, asked) : glm::distance(stands, asked);
  if (aside > moved_aside) return fmt::format("{}, moved by {:.2f} m: there is no room at {}", text, aside, at(asked));
  const double down = asked.z - stands.z;
  return down > tall ? fmt::format("{}, {:.2f} m below {}", text, down, at(asked)) : text;
}

}  // namespace

Lines report(const ProbeQuestion& question, const ProbeAnswer& answer, const ProbeDetails& details) {
  const DefaultFloatingPoint guard;
  const bool contradicts = answer.walk && !answer.passable && !falls(*answer.walk, question.mode);
  const char* const word = answer.passable      ? "YES"
                           : contradicts        ? "NOT SHOWN"
                           : is_unknown(answer) ? "NOT KNOWN"
                                                : "NO";
  const char* const gets = answer.passable                     ? "gets"
                           : contradicts || is_unknown(answer) ? "may or may not get"
                                                               : "does not get";
  Lines lines(
      fmt::format("{}: a body {} {} from A to B.", word, size_of(answer.size.radius, answer.size.height), gets));
  if (!answer.passable) {
    const bool is_named = answer.limit && answer.limit->kind != Kind::apart && !is_end(answer.limit->kind) &&
                          !answer.walk && !is_unknown(answer);
    lines.add(is_named ? "stopped by" : "why", stop_line(question, answer, details));
    if (answer.other)
      lines.add("and by", obstacle(*answer.other, details.other_left, details.other_right) + short_by(*answer.other));
    lines.add("would pass", would_pass(answer));
  }
  if (answer.passage.found) lines.add(answer.wide_enough ? "way" : "widest way", way_line(answer.passage, details));
  if (answer.wide_enough) lines.add("narrowest", narrowest_line(answer, details));
  for (const ProbeDrop& drop : answer.drops) {
    lines.add("one way", fmt::format("down {} at {}: the body cannot climb back", metres(drop.height()), at(drop.rim)));
  }
  if (details.narrower > 0.0 && answer.passage.found) {
    lines.add("narrower", fmt::format("{} than {:g} m on this way",
                                      details.narrow.empty()
                                          ? "nothing is narrower"
                                          : fmt::format("{} {} narrower", counted(details.narrow.size(), "place"),
                                                        details.narrow.size() == 1 ? "is" : "are"),
                                      details.narrower));
    for (const ProbeDetails::Narrow& n : details.narrow) {
      const std::string objects = between(n.left, n.right);
      std::string text = fmt::format("{:.3f} m wide{} at {}, {:.1f} m on the way", n.place.width,
                                     objects.empty() ? "" : " " + objects, at(n.place.centre), n.place.along);
      if (n.place.to - n.place.from > 2.0 * n.place.body.radius)
        text += fmt::format(", for {:.1f} m", n.place.to - n.place.from);
      lines.add("", text);
    }
  }
  lines.add("A", end_line(question.from, answer.start, question.mode, details.start));
  lines.add("B", end_line(question.to, answer.target, question.mode, details.target));
  lines.add("certainty", certainty(question, answer));
  return lines;
}

}  // namespace roam::words
