#pragma once
/// \file
/// Sentences about the result of training.

#include <string>
#include <utility>
#include <vector>

#include "roam/train.h"

namespace roam::words {

/// The result of train() with `options` in a few sentences: which body serves, what decides its size, and what does not
/// count.
[[nodiscard]] std::string answer(const Training& training, const TrainOptions& options = {});

/// Names of the objects on both sides of each of Training::decisive; empty if unknown.
using TrainingNames = std::vector<std::pair<std::string, std::string>>;

/// The report: the answer in one line, and labelled lines. `profile`: the file that was written, or empty.
[[nodiscard]] std::string report(const Training& training, const TrainOptions& options, const TrainingNames& names,
                                 const std::string& profile);

/// "On path 3 a body with radius 0.300 m (the chosen body) should come through, but was blocked at (1.00, 2.00, 3.00)."
[[nodiscard]] std::string contradiction(const Contradiction& contradiction);

/// Why a part of the scene was left out, such as "on top of something"; empty if it was not left out.
[[nodiscard]] const char* why(LeftOut left_out);

/// The stage in words: "looking for places".
[[nodiscard]] const char* stage(TrainStage stage);

}  // namespace roam::words
