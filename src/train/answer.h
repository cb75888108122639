#pragma once
/// \file
/// What training found, in plain words.

#include <string>
#include <vector>

#include "roam/train.h"
#include "train/cracks/cracks.h"
#include "train/layout.h"
#include "train/paper.h"

namespace roam::training {

struct Evidence;

/// "(1.00, 2.00, 3.00)".
[[nodiscard]] std::string at(const Vec3& place);

/// "a radius of 0.3 m", and the foot, where there is one.
[[nodiscard]] std::string body_words(double radius, double support_radius);

/// Why nothing could be trained: no triangle, no floor, no free place, none but on top of rooms that are too low.
[[nodiscard]] std::string nothing_to_train(const Survey& survey, const TrainOptions& options,
                                           const std::vector<ConnectedPart>& parts);

/// Of Method::interval. Whether it was ended before all was done.
[[nodiscard]] std::string interval_answer(const Layout& layout, const Training& training, const Evidence& evidence,
                                          bool ended);

/// Of a trench that the body sinks into and no foot helps over.
[[nodiscard]] std::string shallow_words(const FoundCrack& trench);

/// Of Method::paper.
[[nodiscard]] std::string paper_answer(const PaperResult& result, const Training& training);

/// What is said besides where training ended early, during `stage`.
[[nodiscard]] std::string ended_early(const std::string& stage);

}  // namespace roam::training
