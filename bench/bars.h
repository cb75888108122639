#pragma once
/// \file
/// A bar chart of times, in groups one below the other.

#include <string>
#include <vector>

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

/// Writes an SVG file: dark up to the median, light up to p99, on a logarithmic axis. Throws roam::Error if the file
/// cannot be written.
void write_bars(const std::string& file, const std::string& title, const std::vector<BarGroup>& groups);

}  // namespace roam::bench
