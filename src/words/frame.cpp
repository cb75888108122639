#include "words/frame.h"

#include <fmt/format.h>

namespace roam::words {

std::string likely_up(const std::string& scene, UpAxis axis) {
  return fmt::format("{} is read with z up, but its floors seem to face {}: if it lies on its side, add --up={}", scene,
                     to_string(axis), to_string(axis));
}

std::string high_ceilings(const std::string& scene, double metres) {
  return fmt::format(
      "{} is read in metres, but its ceilings are {:.0f} m high: if it is too large, add --unit=cm, mm, "
      "ft or in",
      scene, metres);
}

}  // namespace roam::words
