// The report of `roam train`: the answer in one line, and labelled lines.
#include <algorithm>
#include <cmath>
#include <set>

#include "text/printable.h"
#include "words/lines.h"
#include "words/measures.h"
#include "words/training.h"

namespace roam::words {
namespace {

constexpr std::size_t most_regions = 3;

std::string body_of(const Training& t) {
  return (t.mode == Mode::fly ? "a flying body " : "a body ") + size_of(t.radius, t.height);
}

std::size_t served(const Training& t) {
  return static_cast<std::size_t>(std::count_if(t.paths.begin(), t.paths.end(), [&](const TrainedPath& path) {
    return !path.largest || *path.largest >= t.radius;
  }));
}

std::string headline(const Training& t) {
  if (t.nowhere || t.places == 0) return "NO PLACE: no body can be anywhere in this scene.";
  if (!t.complete) return "INTERRUPTED: this is the best known so far.";
  if (t.paths.empty()) return "NO PATH: there is room to stand, but no way to go.";
  const bool has_disc = t.support_radius > t.radius;
  const std::string all = t.paths.size() == 1 ? "the path" : fmt::format("all {}", counted(t.paths.size(), "path"));
  const std::string wider =
      t.largest && *t.largest > t.radius ? fmt::format(" Up to {:.2f} m wide would.", 2.0 * *t.largest) : std::string();
  if (t.paper || (!t.feasible && t.contradictions.empty() && has_disc && served(t) == t.paths.size())) {
    if (!t.paper) return fmt::format("PASSES WITH A SUPPORT DISC: {} passes {}.{}", body_of(t), all, wider);
    return fmt::format("{}: {}.", t.feasible ? "PASSES" : "DOES NOT PASS", body_of(t));
  }
  if (t.feasible) return fmt::format("PASSES: {} passes {}.{}", body_of(t), all, wider);
  if (served(t) < t.paths.size())
    return fmt::format("PASSES IN PART: {} passes {} of {}.", body_of(t), served(t), counted(t.paths.size(), "path"));
  return fmt::format("DOES NOT PASS: {} did not come through on {}.", body_of(t), all);
}

std::string narrowest(const Training& t, const TrainingNames& names) {
  if (t.narrowest) {
    const std::string objects = names.empty() ? std::string() : between(names[0].first, names[0].second);
    return fmt::format("{:.3f} m wide opening{} at {}", t.narrowest->width, objects.empty() ? "" : " " + objects,
                       at(t.narrowest->point));
  }
  return t.paths.empty() ? "" : "no opening limits the width";
}

std::string gaps(const Training& t) {
  if (t.mode == Mode::fly || t.paths.empty()) return {};
  std::size_t cracks = 0, drops = 0;
  const Crack* widest = nullptr;  // they are sorted, widest first
  for (const Crack& c : t.cracks) {
    if (c.kind == Crack::Kind::open_drop) ++drops;
    if (c.kind != Crack::Kind::crack) continue;
    ++cracks;
    if (widest == nullptr) widest = &c;
  }
  std::string text = widest == nullptr
                         ? t.all_cracks ? "none" : "none found; not all were looked for"
                         : fmt::format("{}; widest {:.2f} m at {}", cracks, 2.0 * widest->radius, at(widest->point));
  if (drops > 0) text += "; besides " + counted(drops, "open drop");
  if (t.support_radius > t.radius)
    text += fmt::format(". A support disc {:.2f} m wide carries the body over them", 2.0 * t.support_radius);
  return text;
}

std::string tested(const Training& t) {
  std::size_t walks = 0, stopped = 0;
  for (const TrainedPath& path : t.paths) {
    walks += path.trials.size();
    stopped += static_cast<std::size_t>(std::count_if(
        path.trials.begin(), path.trials.end(), [](const Trial& trial) { return trial.outcome != Outcome::reached; }));
  }
  if (walks == 0) return {};
  std::string text =
      fmt::format("{}, {} {}", counted(t.paths.size(), "path"), walks, t.mode == Mode::fly ? "flights" : "walks");
  if (!t.contradictions.empty())
    return text + fmt::format("; {} ended otherwise than predicted: please report that", t.contradictions.size());
  if (t.paper) return text;
  text += ", all as predicted";
  if (stopped > 0)
    text += fmt::format(" ({} bodies made too wide or too narrow were stopped or fell, as they should)", stopped);
  return text;
}

/// Parts of the scene that no path leads through.
std::string left_out(const Training& t) {
  double area = 0.0;
  std::size_t count = 0;
  std::set<std::string> reasons;
  for (const ConnectedPart& part : t.parts) {
    if (part.trained) continue;
    area += part.area;
    ++count;
    reasons.insert(why(part.left_out));
  }
  if (count == 0) return {};
  std::string text = counted(count, "part");
  if (area > 0.0) text += fmt::format(" with {} m2 of floor", grouped(static_cast<std::uint64_t>(std::llround(area))));
  text += ":";
  for (const std::string& reason : reasons) text += (reason == *reasons.begin() ? " " : "; ") + reason;
  return text + " (--stats lists them)";
}

std::string separate(const Training& t) {
  if (t.separate <= 1) return {};
  const auto planned = static_cast<std::size_t>(
      std::count_if(t.parts.begin(), t.parts.end(), [](const ConnectedPart& part) { return part.trained; }));
  return fmt::format("{} parts of the scene have no way between them; paths were planned in {}", t.separate,
                     planned == t.separate ? "each" : fmt::format("{} of them", planned));
}

std::string not_reached(const Training& t) {
  if (t.unwalked.empty()) return {};
  const UnwalkedPath& first = t.unwalked.front();
  const std::size_t count = t.unwalked.size();
  return fmt::format("{}: from {} to {} a walker stopped at {}",
                     count == 1 ? "1 planned end, which does not count"
                                : fmt::format("{} planned ends, which do not count; the first", count),
                     at(first.from), at(first.to), at(first.at));
}

}  // namespace

std::string report(const Training& t, const TrainOptions& options, const TrainingNames& names,
                   const std::string& profile, bool is_beside) {
  Lines lines(headline(t));
  const bool is_plain = t.complete && !t.paper && !t.paths.empty() && !t.nowhere && t.contradictions.empty();
  if (!is_plain || (!t.feasible && t.support_radius <= t.radius)) lines.add("why", answer(t, options));
  if (t.paths.empty() && !t.nowhere) lines.add("body", body_of(t));
  lines.add("narrowest", narrowest(t, names));
  lines.add("floor gaps", gaps(t));
  std::size_t listed = 0;
  for (const SizeRegion& r : t.regions) {
    if (++listed > most_regions) continue;
    lines.add(listed == 1 ? "elsewhere" : "",
              fmt::format("{:.2f} m wide about {}: {}", 2.0 * r.radius, at(r.bounds.center()), printable(r.why)));
  }
  if (listed > most_regions) lines.add("", fmt::format("and {} more places of another width", listed - most_regions));
  lines.add("tested", tested(t));
  lines.add("separate", separate(t));
  lines.add("not reached", not_reached(t));
  lines.add("left out", left_out(t));
  lines.add("saved", profile.empty()
                         ? "nothing, so walk and view do not know this body"
                         : printable(profile, longest_sentence) +
                               (is_beside ? ": walk and view use this body from now on (--no-profile: they do not)"
                                          : ": walk and view do not read it, only the one beside the scene"));
  return lines.text();
}

}  // namespace roam::words
