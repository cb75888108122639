#pragma once
/// \file
/// Sentences about the result of a probe, and words that its table and pictures share.

#include <string>

#include "roam/probe.h"

namespace roam::words {

/// The result in one to four sentences: yes or no, along which way, or what stops the body, where, and how certain that
/// is.
[[nodiscard]] std::string explain(const ProbeQuestion& question, const ProbeAnswer& answer);

/// The decisive obstacle and its size in a few words: "door 0.520 m wide".
[[nodiscard]] std::string text_of(const ProbeLimit& limit);

/// True if the start or the target is the decisive place.
[[nodiscard]] bool is_end(ProbeLimit::Kind kind);
/// "start" or "target".
[[nodiscard]] const char* end_name(ProbeLimit::Kind kind);

/// True if it is certified that no body of the sizes searched for can pass.
[[nodiscard]] bool is_shut(const ProbeAnswer& answer);
/// True if the search ended without a result.
[[nodiscard]] bool is_unknown(const ProbeAnswer& answer);
/// True if the body falls; in a walk, leaving the side of the scene counts as a fall.
[[nodiscard]] bool falls(const ProbeWalk& walk, Mode mode);

}  // namespace roam::words
