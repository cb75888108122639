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

/// The opening or crack that decides an end of the interval.
struct Decisive {
  bool split = false;  ///< of the lower end: Training::widest; else Training::narrowest
  Vec3 point{0.0};
  double width = 0.0;
  Vec3 direction{0.0};  ///< unit, across
  [[nodiscard]] const char* kind() const { return split ? "split" : "opening"; }
};
/// First those of the upper end, then those of the lower; may be empty.
[[nodiscard]] std::vector<Decisive> decisive(const Training& training);

/// Names of the objects on both sides of each of decisive(); empty if unknown.
using TrainingNames = std::vector<std::pair<std::string, std::string>>;

/// The report: the answer in one line, and labelled lines. `profile`: the file that was written, or empty.
/// `is_beside`: whether other verbs find it beside the scene.
[[nodiscard]] std::string report(const Training& training, const TrainOptions& options, const TrainingNames& names,
                                 const std::string& profile, bool is_beside);

/// "On path 3 a body with radius 0.300 m (the chosen body) should come through, but was blocked at (1.00, 2.00, 3.00)."
[[nodiscard]] std::string contradiction(const Contradiction& contradiction);

/// Why a part of the scene was left out, such as "on top of something"; empty if it was not left out.
[[nodiscard]] const char* why(LeftOut left_out);

/// The stage in words: "looking for places".
[[nodiscard]] const char* stage(TrainStage stage);

}  // namespace roam::words
