#pragma once
/// \file
/// Step times by the size of the scene, as a picture.

#include <cstdint>
#include <string>
#include <vector>

namespace roam::bench {

/// Of the steps of one flight.
struct StepTimes {
  std::uint64_t triangles;
  double median_us, p99_us;
};

/// Both axes in powers of ten, as many as the times need; there is one at least. Throws roam::Error when the file
/// cannot be written.
void write_picture(const std::string& file, const std::vector<StepTimes>& times);

}  // namespace roam::bench
