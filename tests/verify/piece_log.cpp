// The moves of a walk of any length, in a file where they do not fit.
#include "verify/piece_log.h"

#include <gtest/gtest.h>

namespace {

using roam::Vec3;
using roam::verification::Piece;

TEST(PieceLog, HandsOutWhatItTookWithTheStepsWhole) {
  roam::verification::PieceLog log;
  std::uint64_t count = 0;
  for (std::uint64_t step = 0; count < 3 * roam::verification::PieceLog::held + 17; ++step) {
    for (std::uint64_t k = 0; k <= step % 3; ++k, ++count) {
      log.add({step, Vec3(double(count), 0.0, 0.0), Vec3(0.0), {}, 0.25});
    }
  }
  EXPECT_EQ(log.size(), count);
  for (const std::size_t most :
       {std::size_t{1}, std::size_t{3}, std::size_t{1000}, 2 * roam::verification::PieceLog::held}) {
    std::uint64_t seen = 0, last = 0;
    log.each(most, [&](std::span<const Piece> pieces) {
      ASSERT_LE(pieces.size(), most);
      if (most >= 3 && seen > 0) {
        EXPECT_NE(pieces.front().step, last) << "a step was divided";
      }
      for (const Piece& piece : pieces) {
        EXPECT_EQ(piece.from.x, double(seen++));
        EXPECT_EQ(piece.clearance, 0.25);
      }
      last = pieces.back().step;
    });
    EXPECT_EQ(seen, count);
  }
}

}  // namespace
