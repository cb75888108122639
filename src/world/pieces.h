#pragma once
/// \file
/// Division of a motion into pieces short enough for the frame of one traversal.

#include <algorithm>
#include <cmath>

#include "index/margin.h"
#include "index/traverse.h"
#include "math/largest.h"
#include "world/query.h"

namespace roam::query {

class Pieces {
 public:
  /// The query must outlive this object.
  Pieces(const Query& way, const Part& part) : way_(way), begin_(part.begin), span_(part.end - part.begin) {
    const double length = span_ * largest(way.motion);
    if (length > index::longest_piece) count_ = static_cast<int>(std::ceil(length / index::longest_piece));
    is_whole_ = count_ == 1 && span_ == 1.0;
    if (is_whole_) return;
    // The starts of later pieces are rounded: three roundings of coordinates no larger than this. If the pieces cover
    // only a part of the motion, ten.
    const double reach = largest(way.from) + largest(way.motion);
    grown_ = (span_ != 1.0 ? 0x1p-48 : 0x1p-50) * reach;
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] index::Piece operator[](int i) const {
    // Number by number: callers have just stored them so, and a wider load would wait for the stores to end.
    const Vec3 &from = way_.from, &motion = way_.motion;
    if (is_whole_) {
      return {{way_.body.radius, way_.body.half_height}, {from.x, from.y, from.z}, {motion.x, motion.y, motion.z}};
    }
    return {{way_.body.radius + grown_, way_.body.half_height},
            way_.from + way_.motion * (begin_ + span_ * (double(i) / count_)),
            way_.motion * span_ / double(count_)};
  }
  /// The corresponding time of the whole motion, rounded down.
  [[nodiscard]] double time(int i, double piece_time) const {
    if (is_whole_) return piece_time;
    if (span_ != 1.0) return std::max(0.0, (begin_ + span_ * ((i + piece_time) / count_)) * (1.0 - 0x1p-49));
    return std::max(0.0, (i + piece_time) / count_ * (1.0 - 0x1p-51));
  }

 private:
  const Query& way_;
  double begin_, span_, grown_ = 0.0;
  int count_ = 1;
  bool is_whole_;
};

}  // namespace roam::query
