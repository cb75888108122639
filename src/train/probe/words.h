#pragma once
/// \file
/// The words of probing that its sentences, its table and its pictures share.

#include <string>

#include "roam/probe.h"

namespace roam::training {

/// Millimetres where metres would show little of it.
[[nodiscard]] std::string metres(double length);
/// "start" or "target".
[[nodiscard]] const char* end_name(ProbeLimit::Kind kind);
/// What decides, in a few words, with its size: "door 0.520 m wide".
[[nodiscard]] std::string text_of(const ProbeLimit& limit);
/// That nobody who was looked for passes is certified.
[[nodiscard]] bool is_shut(const ProbeAnswer& answer);
/// The search ended before it came to an answer.
[[nodiscard]] bool is_unknown(const ProbeAnswer& answer);
/// Over the side of the scene one falls too.
[[nodiscard]] bool falls(const ProbeWalk& walk, Mode mode);

}  // namespace roam::training
