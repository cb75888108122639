#pragma once
/// \file
/// Times of several things as bars, one group below the other.

#include <string>
#include <vector>

namespace roam::bench {

/// One thing that was timed.
struct Bar {
  std::string name;
  double p50 = 0.0, p99 = 0.0;  ///< microseconds; 0 draws nothing
  std::string note;             ///< behind the figures, e.g. "12 wrong"
  bool stressed = false;        ///< drawn in the colour of what the picture is about
};

struct BarGroup {
  std::string title;
  std::vector<Bar> bars;
};

/// An SVG file: dark up to the median, light up to p99, on a logarithmic axis. Throws roam::Error when the file cannot
/// be written.
void write_bars(const std::string& file, const std::string& title, const std::vector<BarGroup>& groups);

}  // namespace roam::bench
