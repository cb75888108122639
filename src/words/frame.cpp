#include "words/frame.h"

#include <fmt/format.h>

namespace roam::words {

std::string likely_up(const std::string& scene, UpAxis axis) {
  return fmt::format("{} is read with z up, but its floors seem to face {}: if it lies on its side, add --up={}", scene,
                     to_string(axis), to_string(axis));
}

}  // namespace roam::words
