#pragma once
/// \file
/// The report of a probe, and words that its table and pictures share.

#include <optional>
#include <string>
#include <vector>

#include "measure/along.h"
#include "measure/slope.h"
#include "roam/probe.h"
#include "words/lines.h"

namespace roam::words {

/// The ground on which an end stands.
struct Ground {
  std::string object;  ///< empty: unknown
  double above = 0.0;  ///< m: of the floor around; 0: it is that floor
};

/// What a report says besides the answer. Names are empty if unknown.
struct ProbeDetails {
  /// A place narrower than wanted, and the names of the objects on both sides.
  struct Narrow {
    measure::NarrowPlace place;
    std::string left, right;
  };
  std::string left, right;              ///< names of the objects at both ends of the measured distance
  std::string other_left, other_right;  ///< likewise for ProbeAnswer::other
  Ground start, target;                 ///< walking
  std::optional<measure::Slope> slope;  ///< of the way, walking
  double narrower = 0.0;                ///< m: `narrow` lists the places narrower than this; 0: none are wanted
  std::vector<Narrow> narrow;
};

/// A marked place of a probe, in pictures and in the window.
struct ProbeMark {
  Vec3 place{0.0};
  std::string text;   ///< "door 0.520 m wide", "one way: down 0.450 m", "walker blocked"
  bool good = false;  ///< the body passes there
};
[[nodiscard]] std::vector<ProbeMark> marks_of(const ProbeAnswer& answer);

/// The report: yes or no; then along which way, or what stops the body, where, and how certain that is.
[[nodiscard]] Lines report(const ProbeQuestion& question, const ProbeAnswer& answer, const ProbeDetails& details = {});

/// The decisive obstacle and its size in a few words: "door 0.520 m wide".
[[nodiscard]] std::string text_of(const ProbeLimit& limit);

/// True if the start or the target is the decisive place.
[[nodiscard]] bool is_end(ProbeLimit::Kind kind);
/// "start" or "target", and "A" or "B".
[[nodiscard]] const char* end_name(ProbeLimit::Kind kind);
[[nodiscard]] const char* end_letter(ProbeLimit::Kind kind);

/// True if it is certified that no body of the sizes searched for can pass.
[[nodiscard]] bool is_shut(const ProbeAnswer& answer);
/// True if the search ended without a result.
[[nodiscard]] bool is_unknown(const ProbeAnswer& answer);
/// True if the body falls; in a walk, leaving the side of the scene counts as a fall.
[[nodiscard]] bool falls(const ProbeWalk& walk, Mode mode);

}  // namespace roam::words
