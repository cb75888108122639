#include "probe_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "exit_status.h"
#include "roam/error.h"

namespace roam::app {
namespace {

/// Wider ways than this, metres, or than this many times the body, are not told apart.
constexpr double wide = 1.0;
constexpr double wide_times = 1.25;
/// The narrowest ways that are looked for, to name the opening that stops the body: metres, and parts of its radius.
constexpr double narrow = 0.05;
constexpr double narrow_part = 0.5;

bool is_sphere(const ProbedSize& size) { return size.height <= 2.0 * size.radius; }

/// The place of the way that is nearest to a point, seen from above on foot: how far along, where, and heading where.
struct OnWay {
  double along = 0.0;
  Vec3 place{0.0};
  Vec3 heading{0.0};
};
OnWay nearest_on(const std::vector<Vec3>& way, const Vec3& point, Mode mode) {
  OnWay best;
  double nearest = std::numeric_limits<double>::infinity(), along = 0.0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const Vec3 a = way[i], d = way[i + 1] - way[i];
    Vec3 flat = d, off = point - a;
    if (mode == Mode::walk) {
      flat.z = 0.0;
      // On another storey it is another place.
      off.z = off.z < 0.0 || off.z > 3.0 ? off.z : 0.0;
    }
    const double square = glm::dot(flat, flat);
    const double t = square > 0.0 ? std::clamp(glm::dot(off, flat) / square, 0.0, 1.0) : 0.0;
    const double distance = glm::length(off - t * flat);
    const double length = glm::length(d);
    if (distance < nearest) {
      nearest = distance;
      best = {along + t * length, a + t * d, length > 0.0 ? d / length : Vec3(0.0)};
    }
    along += length;
  }
  return best;
}

std::string at(const Vec3& p) { return fmt::format("({:.2f}, {:.2f}, {:.2f})", p.x, p.y, p.z); }

/// Millimetres where metres would show little of it.
std::string metres(double length) {
  return length >= 0.01 ? fmt::format("{:.3f} m", length) : fmt::format("{:.1f} mm", 1e3 * length);
}

std::string body_text(const ProbedSize& size) {
  if (is_sphere(size)) return fmt::format("a sphere of radius {:.3g} m", size.radius);
  return fmt::format("a body of radius {:.3g} m and height {:.3g} m", size.radius, size.height);
}

bool is_number(const std::string& text, double& value) {
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && after == end;
}

std::string across(const Opening& opening) {
  if (opening.kind == Opening::Kind::lintel) return "high";
  return "wide";
}

}  // namespace

std::vector<ProbedSize> parse_sizes(const std::string& text, const std::string& where) {
  std::vector<ProbedSize> sizes;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = text.find_first_not_of(", \t\r", i);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(text.find_first_of(", \t\r", begin), text.size());
    const std::string item = text.substr(begin, end - begin);
    const std::size_t cross = item.find('x');
    ProbedSize size;
    bool good = is_number(item.substr(0, cross), size.radius);
    size.height = 2.0 * size.radius;
    if (good && cross != std::string::npos) good = is_number(item.substr(cross + 1), size.height);
    if (!good) throw UsageError(fmt::format("{}: '{}' is no size: R or RxH, in metres, e.g. 0.3x1.9", where, item));
    sizes.push_back(size);
    i = end;
  }
  return sizes;
}

double climbed(const ProbeQuestion& question, const ProbedSize& size) {
  return std::min(question.step, is_sphere(size) ? size.radius : size.height - 2.0 * size.radius);
}

WalkerSettings settings_of(const ProbeQuestion& question, const ProbedSize& size) {
  WalkerSettings settings;
  settings.radius = size.radius;
  settings.height = size.height;
  settings.eye = std::min(settings.eye, settings.height);
  settings.step = std::min(question.step, 0.5 * settings.height);
  settings.slope_degrees = question.slope_degrees;
  settings.support_radius = question.support_radius;
  check(settings);
  return settings;
}

std::vector<ProbeAnswer> probe(const Survey& survey, const ProbeQuestion& question, std::span<const ProbedSize> sizes,
                               const std::function<bool(std::uint64_t)>& progress) {
  // Bodies that are measured alike, each with its largest and smallest radius.
  struct Group {
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    Passage passage;
  };
  using Kind = std::pair<double, double>;  // height, or 0 for spheres; step
  const auto kind_of = [&](const ProbedSize& size) {
    if (question.mode == Mode::fly) return Kind{0.0, 0.0};
    return Kind{is_sphere(size) ? 0.0 : size.height, climbed(question, size)};
  };
  std::map<Kind, Group> groups;
  for (const ProbedSize& size : sizes) {
    Group& group = groups[kind_of(size)];
    group.least = std::min(group.least, size.radius);
    group.most = std::max(group.most, size.radius);
  }
  for (auto& [kind, group] : groups) {
    PassageOptions options;
    options.mode = question.mode;
    options.height = kind.first;
    options.step = kind.second;
    options.spacing = question.spacing;
    options.widest = std::max(wide, wide_times * group.most);
    options.narrowest = std::min(narrow, narrow_part * group.least);
    bool wanted = true;
    options.progress = [&](std::uint64_t places) { return wanted = progress(places); };
    group.passage = widest_way(survey, question.from, question.to, options);
    if (!wanted) throw Cancelled();
  }
  std::vector<ProbeAnswer> answers;
  for (const ProbedSize& size : sizes) {
    ProbeAnswer answer;
    answer.size = size;
    answer.passage = groups[kind_of(size)].passage;
    const Passage& p = answer.passage;
    answer.passable = p.found && p.radius >= size.radius;
    answer.proven = p.proven || (!answer.passable && p.bound < size.radius);
    if (p.opening) {
      answer.along = nearest_on(p.way, p.opening->point, question.mode).along;
      if (!answer.passable) answer.missing = std::max(0.0, 2.0 * size.radius - p.opening->width);
    }
    answers.push_back(std::move(answer));
  }
  return answers;
}

std::vector<Vec3> centres(const ProbeQuestion& question, const ProbeAnswer& answer) {
  std::vector<Vec3> path = answer.passage.way;
  if (question.mode == Mode::fly) return path;
  for (Vec3& place : path) place.z += 0.5 * answer.size.height;
  return path;
}

ProbeWalk walk_way(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer) {
  const std::vector<Vec3> path = centres(question, answer);
  Walker walker(survey.world(), settings_of(question, answer.size), question.mode, path.front());
  const RouteResult result = follow(walker, path);
  ProbeWalk walk{result.outcome, result.end};
  if (result.outcome != Outcome::fell) return walk;
  // Where the ground ended, not how deep it was then.
  for (const RouteEvent& e : result.events) {
    if (e.event.kind == EventKind::airborne) walk.at = e.event.point;
    if (e.event.kind == EventKind::fell) break;
  }
  return walk;
}

std::string explain(const ProbeQuestion& question, const ProbeAnswer& answer) {
  const Passage& p = answer.passage;
  const std::string ways = fmt::format("from {} to {}", at(question.from), at(question.to));
  if (answer.passable) {
    std::string text = fmt::format("Yes: {} gets {} on a way of {:.1f} m; ", body_text(answer.size), ways, p.length);
    if (p.limited && p.opening) {
      text += fmt::format("the narrowest place is {} {} ({}) at {}, {:.1f} m on the way.", metres(p.opening->width),
                          across(*p.opening), name(p.opening->kind), at(p.opening->point), answer.along);
    } else {
      text += fmt::format("nothing on it leaves less than {}.", metres(2.0 * p.radius));
    }
    if (answer.walk && answer.walk->outcome == Outcome::fell) {
      text += fmt::format(
          " But near {} the floor has a gap into which it falls: it needs a wider foot (--support-radius), or a "
          "bridge.",
          at(answer.walk->at));
    }
    return text;
  }
  std::string text = fmt::format("No: {} does not get {}. ", body_text(answer.size), ways);
  if (p.found && p.opening) {
    text += fmt::format("The {} at {} is {} {}; {} are missing.", name(p.opening->kind), at(p.opening->point),
                        metres(p.opening->width), across(*p.opening), metres(answer.missing));
  } else if (p.found) {
    text += fmt::format("No way leaves more than {}.", metres(2.0 * p.radius));
  } else if (p.opening) {
    text += fmt::format("There is no way at all: it breaks off at {}.", at(p.opening->point));
  } else {
    text += "There is no way at all.";
  }
  if (!p.complete) {
    text += " The search was ended early: a wider way may exist.";
  } else if (answer.proven) {
    text += p.found ? " That none wider exists is certified." : " That is certified.";
  } else {
    text += fmt::format(" None{} was found among places {:g} m apart; openings under {:.2g} m may be overlooked.",
                        p.found ? " wider" : "", question.spacing, 0.7 * question.spacing);
  }
  return text;
}

std::optional<picture::OpeningView> view_of(const Survey& survey, const ProbeQuestion& question,
                                            const ProbeAnswer& answer) {
  const Passage& p = answer.passage;
  if (!p.opening) return std::nullopt;
  const Opening& opening = *p.opening;
  const WalkerSettings body = settings_of(question, answer.size);
  picture::OpeningView view;
  std::string kind = name(opening.kind);
  kind.front() = static_cast<char>(kind.front() - 'a' + 'A');
  view.heading = opening.width > 0.0
                     ? fmt::format("{} {} {} at {}", kind, metres(opening.width), across(opening), at(opening.point))
                     : fmt::format("No way at {}", at(opening.point));
  view.text = explain(question, answer);
  view.point = opening.point;
  view.direction = opening.direction;
  view.width = opening.width;
  view.mode = question.mode;
  view.radius = body.radius;
  view.height = body.height;
  view.step = body.step;
  view.support_radius = question.mode == Mode::walk ? body.support_radius : 0.0;
  view.fits = answer.passable;
  const OnWay near = nearest_on(p.way, opening.point, question.mode);
  view.heading_to = near.heading;
  if (question.mode == Mode::fly) {
    view.height = 2.0 * body.radius;
    view.floor = opening.point.z - body.radius;
  } else if (!p.way.empty()) {
    view.floor = near.place.z;
  } else {
    const Impact down = survey.world().ray(opening.point, {0.0, 0.0, -2.0 * body.height});
    view.floor = down.hit ? down.point.z : opening.point.z;
  }
  return view;
}

Json json_report(const ProbeAnswer& answer, bool with_way) {
  const Passage& p = answer.passage;
  Json json = {{"radius", answer.size.radius},
               {"height", answer.size.height},
               {"passable", answer.passable},
               {"clearance_m", p.radius},
               {"limited", p.limited}};
  if (with_way) {
    Json way = Json::array();
    for (const Vec3& place : p.way) way.push_back(to_json(place));
    json["way"] = std::move(way);
    json["length_m"] = p.length;
  }
  json["opening"] = nullptr;
  if (p.opening) {
    json["opening"] = {{"point", to_json(p.opening->point)}, {"width_m", p.opening->width},
                       {"missing_m", answer.missing},        {"direction", to_json(p.opening->direction)},
                       {"kind", name(p.opening->kind)},      {"along_m", answer.along}};
  }
  json["proven"] = answer.proven;
  json["bound_m"] = std::isfinite(p.bound) ? Json(p.bound) : Json(nullptr);
  json["complete"] = p.complete;
  json["places"] = p.places;
  if (with_way) {
    json["walked"] = nullptr;
    if (answer.walk) json["walked"] = {{"outcome", name(answer.walk->outcome)}, {"at", to_json(answer.walk->at)}};
  }
  return json;
}

std::string table(std::span<const ProbeAnswer> answers) {
  std::string text =
      fmt::format("{:>8}  {:>8}  {:<4}  {:>10}  {:>10}  {}\n", "radius", "height", "", "narrowest", "missing", "where");
  for (const ProbeAnswer& answer : answers) {
    const Passage& p = answer.passage;
    const std::string width = p.found ? metres(2.0 * p.radius) : "no way";
    const std::string where = p.opening ? fmt::format("{} at {}", name(p.opening->kind), at(p.opening->point)) : "";
    text += fmt::format("{:>6.3f} m  {:>6.3f} m  {:<4}  {:>10}  {:>10}  {}\n", answer.size.radius, answer.size.height,
                        answer.passable ? "yes" : "no", p.found && !p.limited ? ">= " + width : width,
                        answer.passable ? std::string() : metres(answer.missing), where);
  }
  return text;
}

}  // namespace roam::app
