#pragma once
/// \file
/// A picture of step times by the size of the scene.

#include <cstdint>
#include <string>
#include <vector>

namespace roam::bench {

/// The times of one flight's steps.
struct StepTimes {
  std::uint64_t triangles;
  double median_us, p99_us;
};

/// Both axes are logarithmic, with as many powers of ten as the times need. `times` must not be empty. Throws
/// roam::Error if the file cannot be written.
void write_picture(const std::string& file, const std::vector<StepTimes>& times);

}  // namespace roam::bench
