#pragma once
/// \file
/// What a probe found, in plain words: its sentences, and what they share with its table and its pictures.

#include <string>

#include "roam/probe.h"

namespace roam::words {

/// The answer in words: yes or no, by which way, or what stops the body, where, and how sure that is; one to four
/// sentences.
[[nodiscard]] std::string explain(const ProbeQuestion& question, const ProbeAnswer& answer);

/// What decides, in a few words, with its size: "door 0.520 m wide".
[[nodiscard]] std::string text_of(const ProbeLimit& limit);

/// Whether it is the start or the target that decides.
[[nodiscard]] bool is_end(ProbeLimit::Kind kind);
/// "start" or "target".
[[nodiscard]] const char* end_name(ProbeLimit::Kind kind);

/// That nobody who was looked for passes is certified.
[[nodiscard]] bool is_shut(const ProbeAnswer& answer);
/// The search ended before it came to an answer.
[[nodiscard]] bool is_unknown(const ProbeAnswer& answer);
/// Over the side of the scene one falls too.
[[nodiscard]] bool falls(const ProbeWalk& walk, Mode mode);

}  // namespace roam::words
