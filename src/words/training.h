#pragma once
/// \file
/// What training found, in plain words.

#include <string>

#include "roam/train.h"

namespace roam::words {

/// The answer to what was asked by `options`: which body serves, what decides, and what does not count; one to some
/// sentences.
[[nodiscard]] std::string answer(const Training& training, const TrainOptions& options = {});

/// "On path 3 a body with radius 0.300 m (the chosen body) should come through, but was blocked at (1.00, 2.00, 3.00)."
[[nodiscard]] std::string contradiction(const Contradiction& contradiction);

/// Why a part of the scene was left out: "on top of something"; empty where it was not.
[[nodiscard]] const char* why(LeftOut left_out);

/// "looking for places".
[[nodiscard]] const char* stage(TrainStage stage);

}  // namespace roam::words
