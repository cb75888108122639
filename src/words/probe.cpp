#include "words/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/floating_point.h"
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
      return fmt::format("{} {} {}", to_string(limit.kind), metres(limit.size), extent(limit));
    case Kind::lintel:
      return fmt::format("lintel for a radius of {}", metres(0.5 * limit.size));
    case Kind::start:
    case Kind::target:
      return fmt::format("{} {} {}", end_name(limit.kind), metres(limit.size),
                         limit.too_low ? "below what is above it" : "from a wall");
    case Kind::height:
      return fmt::format("headroom {}", metres(limit.size));
    case Kind::edge:
      return fmt::format("edge of the floor, {} from a wall", metres(limit.size));
    case Kind::step:
      return fmt::format("step of {}", metres(limit.size));
    case Kind::apart:
      return "nearest approach";
  }
  return "";
}

namespace {

/// Metres. An end that was moved farther than this is mentioned, with both positions.
constexpr double moved_aside = 0.05;
constexpr double tall = 2.0;  ///< m: eyes are at most this far above the feet

std::string body_text(const ProbedSize& size) {
  if (size.height <= 2.0 * size.radius) return fmt::format("a sphere of radius {:.3g} m", size.radius);
  return fmt::format("a body of radius {:.3g} m and height {:.3g} m", size.radius, size.height);
}

/// "the narrowest place is ...", for a way that is wide enough.
std::string narrowest(const ProbeAnswer& answer) {
  const Passage& p = answer.passage;
  if (!answer.limit) return fmt::format("nothing on it leaves less than {}", metres(2.0 * p.radius));
  const ProbeLimit& limit = *answer.limit;
  const std::string where = fmt::format("at {}, {:.1f} m on the way", at(limit.point), limit.along);
  if (is_end(limit.kind)) {
    return fmt::format("nothing on it is narrower than the {} itself, which stands {} from a wall",
                       end_name(limit.kind), metres(limit.size));
  }
  if (limit.kind == Kind::edge)
    return fmt::format(
        "the narrowest place has a wall on one side, {} from the way, and the floor's end on the other, {}",
        metres(limit.size), where);
  if (limit.kind == Kind::lintel && answer.size.height > 2.0 * answer.size.radius)
    return fmt::format("the narrowest place lets a radius of {} under a lintel {}", metres(0.5 * limit.size), where);
  return fmt::format("the narrowest place is {} {} ({}) {}", metres(limit.size), extent(limit), to_string(limit.kind),
                     where);
}

/// No way was found for any size.
std::string no_way(const ProbeAnswer& answer) {
  const ProbedSize& size = answer.size;
  return fmt::format(
      "{}, not even for a radius of {}{}: what is reached from the start and what is reached from the target do not "
      "meet",
      is_shut(answer) ? "There is no way at all" : "No way was found", metres(answer.narrowest),
      size.height > 2.0 * size.radius ? fmt::format(" and a height of {:.3g} m", size.height) : "");
}

/// The obstacle that stops the body.
std::string stopped_by(const ProbeAnswer& answer) {
  const Passage& p = answer.passage;
  if (!answer.limit) {
    if (p.found) return fmt::format("No way leaves more than {}.", metres(2.0 * p.radius));
    std::string text = no_way(answer) + ", nor come near each other.";
    const double rise = answer.target.z - answer.start.z;
    if (std::abs(rise) > tall) {
      text += fmt::format(" The target lies {:.1f} m {}; no stairs or ramp join the two.", std::abs(rise),
                          rise > 0.0 ? "higher" : "lower");
    }
    return text;
  }
  const ProbeLimit& limit = *answer.limit;
  const std::string missing =
      answer.missing < 1e-3 ? "less than 1 mm is missing" : metres(answer.missing) + " are missing";
  switch (limit.kind) {
    case Kind::start:
    case Kind::target: {
      std::string text = limit.too_low
                             ? fmt::format("The {} is too low: at {} there are {} from the floor to what is above; {}.",
                                           end_name(limit.kind), at(limit.feet), metres(limit.size), missing)
                             : fmt::format("The {} stands {} from a wall, at {}; {}.", end_name(limit.kind),
                                           metres(limit.size), at(limit.feet), missing);
      if (answer.room) text += fmt::format(" The nearest place with room for it is {}.", at(*answer.room));
      return text;
    }
    case Kind::edge:
      return fmt::format(
          "At {} there is a wall on one side and the floor's end on the other: a way leads {} from the wall; {}.",
          at(limit.point), metres(limit.size), missing);
    case Kind::height: {
      std::string text =
          fmt::format("The body is too high: near {} one of that radius passes up to a height of {}; {}.",
                      at(limit.feet), metres(limit.size), missing);
      if (p.found) text += fmt::format(" At its whole height only a radius of {} passes.", metres(p.radius));
      return text;
    }
    case Kind::step:
      return fmt::format("A step stops it: at {} the floor {} by {} at once, and the body steps {}.", at(limit.point),
                         limit.feet.z < limit.point.z ? "rises" : "falls", metres(limit.size), metres(limit.needed));
    case Kind::apart:
      return no_way(answer) + fmt::format("; it breaks off at {}.", at(limit.point));
    case Kind::lintel:
      if (answer.size.height > 2.0 * answer.size.radius) {
        return fmt::format("The lintel at {} lets a radius of {} through at that height; {}.", at(limit.point),
                           metres(0.5 * limit.size), metres(0.5 * answer.missing) + " are missing");
      }
      break;
    case Kind::door:
    case Kind::gap:
      break;
  }
  return fmt::format("The {} at {} is {} {}; {}.", to_string(limit.kind), at(limit.point), metres(limit.size),
                     extent(limit), missing);
}

/// The search reached its limit of places.
std::string ended(const Passage& p) {
  return fmt::format(
      " the search ended after {} places, the most that are looked at. A wider spacing (--spacing) looks at fewer.",
      p.places);
}

/// The certified upper bound on the radius of ways, rounded up to millimetres.
std::string certified(const Passage& p) {
  return fmt::format("That none for a radius over {:.3f} m exists is certified", std::ceil(1e3 * p.bound - 1e-6) / 1e3);
}

/// How certain a "no" is.
std::string sureness(const ProbeQuestion& question, const ProbeAnswer& answer) {
  const Passage& p = answer.passage;
  if (answer.limit && (is_end(answer.limit->kind) || answer.limit->too_low)) return "";
  if (!p.complete && !answer.proven) return " A wider way may exist:" + ended(p);
  if (!p.complete) return fmt::format(" {}; of narrower ones not all were looked for:", certified(p)) + ended(p);
  if (is_shut(answer)) return " That is certified.";
  // The proof leaves an interval open, and the body's radius may lie in it.
  if (p.found && (answer.proven || p.proven)) return fmt::format(" {}.", certified(p));
  const double overlooked = 0.7 * question.spacing;
  if (answer.proven)
    return fmt::format(" {}; for smaller ones, openings under {:.2g} m may be overlooked.", certified(p), overlooked);
  return fmt::format(" None{} was found among places {:g} m apart; openings under {:.2g} m may be overlooked.",
                     p.found ? " wider" : "", question.spacing, overlooked);
}

/// The walker's last position, reported like all positions: of the feet when walking, of the centre when flying.
std::string walked_to(const ProbeQuestion& question, const ProbeAnswer& answer) {
  Vec3 place = answer.walk->at;
  if (question.mode == Mode::walk) place.z -= 0.5 * answer.size.height;
  return at(place);
}

/// Says that an end had to be moved.
std::string moved(const char* end, const Vec3& asked, const Vec3& stands, Mode mode) {
  const double aside = std::hypot(stands.x - asked.x, stands.y - asked.y), down = asked.z - stands.z;
  if (mode == Mode::fly ? glm::distance(asked, stands) > moved_aside : aside > moved_aside) {
    return fmt::format(" The {} has no room where it was asked for: {} was taken.", end, at(stands));
  }
  if (mode == Mode::walk && down > tall)
    return fmt::format(" The {} is {:.2f} m above the floor: {} was taken.", end, down, at(stands));
  if (mode == Mode::walk && std::abs(down) > moved_aside) return fmt::format(" The {}'s floor is {}.", end, at(stands));
  return "";
}

}  // namespace

std::string explain(const ProbeQuestion& question, const ProbeAnswer& answer) {
  const DefaultFloatingPoint guard;
  const Passage& p = answer.passage;
  const std::string ways = fmt::format("from {} to {}", at(question.from), at(question.to));
  const std::string body = body_text(answer.size);
  std::string text;
  if (answer.passable) {
    text = fmt::format("Yes: {} gets {} on a way of {:.1f} m; {}.", body, ways, p.length, narrowest(answer));
  } else if (answer.walk && falls(*answer.walk, question.mode)) {
    text = fmt::format(
        "No: {} falls at {}, where the floor ends or has a gap: it needs a wider foot (a support radius, "
        "--support-radius), or a bridge. Else it would get {} on a way of {:.1f} m; {}.",
        body, walked_to(question, answer), ways, p.length, narrowest(answer));
  } else if (answer.walk) {
    const char* how = answer.walk->outcome == Outcome::left_scene ? "left the scene"
                      : answer.walk->outcome == Outcome::held     ? "was held"
                                                                  : "was blocked";
    text = fmt::format(
        "Not shown: the walker that was sent along the way {} at {}. By its measures {} gets {} on a way of {:.1f} m; "
        "{}.",
        how, walked_to(question, answer), body, ways, p.length, narrowest(answer));
  } else if (is_unknown(answer)) {
    text = fmt::format("Not known: no way was found on which {} gets {}, but", body, ways) + ended(p);
  } else if (!p.complete && !p.found && !answer.limit) {
    text = fmt::format("No: {} does not get {}.", body, ways) + sureness(question, answer);
  } else {
    text = fmt::format("No: {} does not get {}. {}", body, ways, stopped_by(answer)) + sureness(question, answer);
  }
  return text + moved("start", question.from, answer.start, question.mode) +
         moved("target", question.to, answer.target, question.mode);
}

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin);
}

const char* shortfall(const ProbeLimit& limit) {
  if (limit.kind == Kind::height || limit.too_low || std::abs(limit.direction.z) > 0.7) return "too low";
  return limit.kind == Kind::step                         ? "too high"
         : is_end(limit.kind) || limit.kind == Kind::edge ? "too near"
                                                          : "too narrow";
}

/// "door 0.750 m wide between "a" and "b" at (1.00, 2.00, 3.00)".
std::string obstacle(const ProbeLimit& limit, const ProbeDetails& details) {
  std::string text = text_of(limit);
  if (is_end(limit.kind)) {
    const std::string& name = details.left.empty() ? details.right : details.left;
    return fmt::format("{} is {} {} {}, at {}", limit.kind == Kind::start ? "A" : "B", metres(limit.size),
                       limit.too_low ? "below" : "from", name.empty() ? "the next surface" : quoted(name),
                       at(limit.feet));
  }
  const std::string objects = between(details.left, details.right);
  return fmt::format("{}{} at {}", text, objects.empty() ? "" : " " + objects, at(limit.point));
}

std::string stop_line(const ProbeQuestion& question, const ProbeAnswer& answer, const ProbeDetails& details) {
  if (answer.walk && falls(*answer.walk, question.mode)) {
    return fmt::format(
        "a fall at {}: the floor ends there, or has a gap. A wider foot (--support-radius) may carry the body",
        walked_to(question, answer));
  }
  if (answer.walk) {
    return fmt::format("the walker that was sent along the way ended at {}: {}. By its measures the body passes",
                       walked_to(question, answer), to_string(answer.walk->outcome));
  }
  if (is_unknown(answer)) return trimmed(ended(answer.passage));
  if (!answer.limit || answer.limit->kind == Kind::apart) return stopped_by(answer);
  const double missing = answer.limit->kind == Kind::lintel ? 0.5 * answer.missing : answer.missing;
  std::string text = obstacle(*answer.limit, details);
  if (answer.limit->kind == Kind::step) {
    text += fmt::format("; the body steps {}", metres(answer.limit->needed));
  } else {
    text += missing < 1e-3 ? ": less than 1 mm " : fmt::format(": {} ", metres(missing));
    text += shortfall(*answer.limit);
  }
  return answer.room ? text + fmt::format("; the nearest place with room is {}", at(*answer.room)) : text;
}

/// The sizes that would pass.
std::string would_pass(const ProbeAnswer& answer) {
  const Passage& p = answer.passage;
  if (answer.wide_enough || is_unknown(answer)) return {};
  std::string text;
  if (answer.limit && answer.limit->kind == Kind::height)
    text = fmt::format("a body of that width up to {:.3f} m high", answer.limit->size);
  if (p.found) text += fmt::format("{}up to {:.3f} m wide", text.empty() ? "" : ", or of that height ", 2.0 * p.radius);
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
  if (!answer.limit) return fmt::format("nothing leaves less than {}", metres(2.0 * answer.passage.radius));
  const ProbeLimit& limit = *answer.limit;
  std::string text = obstacle(limit, details);
  if (!is_end(limit.kind)) text += fmt::format(", {:.1f} m on the way", limit.along);
  if (limit.kind == Kind::door || limit.kind == Kind::gap)
    text += ": " + spare_words(0.5 * (limit.size - limit.needed));
  return text;
}

std::string end_line(const Vec3& asked, const Vec3& stands, Mode mode) {
  const std::string place = at(stands);
  if (mode == Mode::fly)
    return glm::distance(asked, stands) > moved_aside ? place + ", moved: there is no room at " + at(asked) : place;
  const double aside = std::hypot(stands.x - asked.x, stands.y - asked.y), down = asked.z - stands.z;
  if (aside > moved_aside) return fmt::format("on the floor at {}, moved: there is no room at {}", place, at(asked));
  if (down > tall) return fmt::format("on the floor at {}, {:.2f} m below {}", place, down, at(asked));
  return "on the floor at " + place;
}

std::string certainty(const ProbeQuestion& question, const ProbeAnswer& answer) {
  if (answer.passable) return "a walker of that size has gone the way from A to B";
  if (answer.wide_enough) return {};
  const std::string text = trimmed(sureness(question, answer));
  return answer.passage.complete && !answer.proven && !text.empty() ? text + " This is no proof." : text;
}

}  // namespace

std::string report(const ProbeQuestion& question, const ProbeAnswer& answer, const ProbeDetails& details) {
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
    const bool is_named = answer.limit && answer.limit->kind != Kind::apart && !answer.walk && !is_unknown(answer);
    lines.add(is_named ? "stopped by" : "why", stop_line(question, answer, details));
    lines.add("would pass", would_pass(answer));
  }
  if (answer.passage.found) lines.add(answer.wide_enough ? "way" : "widest way", way_line(answer.passage, details));
  if (answer.wide_enough) lines.add("narrowest", narrowest_line(answer, details));
  if (details.narrower > 0.0 && answer.passage.found) {
    lines.add("narrower",
              fmt::format("{} than {:g} m on this way",
                          details.narrow.empty()       ? "nothing is narrower"
                          : details.narrow.size() == 1 ? "1 place is narrower"
                                                       : fmt::format("{} places are narrower", details.narrow.size()),
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
  lines.add("A", end_line(question.from, answer.start, question.mode));
  lines.add("B", end_line(question.to, answer.target, question.mode));
  lines.add("certainty", certainty(question, answer));
  return lines.text();
}

}  // namespace roam::words
