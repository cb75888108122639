#pragma once
/// \file
/// Charts of times, on logarithmic axes with as many powers of ten as the times need.

#include <cstdint>
#include <string>
#include <vector>

#include "draw/sheet.h"

namespace roam::bench {

/// One timed thing.
struct Bar {
  std::string name;
  double p50 = 0.0, p99 = 0.0;  ///< microseconds; 0 draws nothing
  std::string note;             ///< behind the figures, e.g. "12 wrong"
  bool stressed = false;        ///< drawn in the colour of emphasis
};

struct BarGroup {
  std::string title;
  std::vector<Bar> bars;
};

/// Groups one below the other: dark up to the median, light up to p99.
[[nodiscard]] draw::Sheet bar_chart(const std::string& title, const std::vector<BarGroup>& groups);

/// The times of one flight's steps.
struct StepTimes {
  std::uint64_t triangles;
  double median_us, p99_us;
};

/// Step times by the size of the scene. `times` must not be empty.
[[nodiscard]] draw::Sheet step_chart(const std::vector<StepTimes>& times);

}  // namespace roam::bench
