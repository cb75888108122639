#pragma once
/// \file
/// The way cut into pieces that are short enough for the frame of one traversal.

#include <algorithm>
#include <cmath>

#include "index/margin.h"
#include "index/traverse.h"
#include "math/largest.h"
#include "world/query.h"

namespace roam::query {

class Pieces {
 public:
  explicit Pieces(const Way& way)
      : way_(way),
        span_(way.end - way.begin),
        count_(std::max(1, static_cast<int>(std::ceil(span_ * largest(way.motion) / index::kLongestPiece)))) {
    // Starts of later pieces are rounded: three roundings of coordinates no larger than this. Where the pieces cover
    // only a part of the way, ten.
    const double reach = largest(way.from) + largest(way.motion);
    if (span_ != 1.0) {
      way_.body.radius += 0x1p-48 * reach;
    } else if (count_ > 1) {
      way_.body.radius += 0x1p-50 * reach;
    }
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] index::Piece operator[](int i) const {
    if (count_ == 1 && span_ == 1.0) return {way_.body, way_.from, way_.motion};
    return {way_.body, way_.from + way_.motion * (way_.begin + span_ * (double(i) / count_)),
            way_.motion * span_ / double(count_)};
  }
  /// The time of the whole motion, rounded down.
  [[nodiscard]] double time(int i, double piece_time) const {
    if (span_ != 1.0) return std::max(0.0, (way_.begin + span_ * ((i + piece_time) / count_)) * (1.0 - 0x1p-49));
    return count_ == 1 ? piece_time : std::max(0.0, (i + piece_time) / count_ * (1.0 - 0x1p-51));
  }

 private:
  Way way_;
  double span_;
  int count_;
};

}  // namespace roam::query
