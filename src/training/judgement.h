#pragma once
/// \file
/// The result of a trial as the paper classifies it.

#include <cstdint>

#include "roam/route.h"

namespace roam::training {

/// The three results that the paper's two rules distinguish.
enum class Judgement : std::uint8_t {
  passed,
  cannot_enter,  ///< blocked or held: the radius goes down
  flies_off,     ///< fell or left the scene: the radius goes up
};

[[nodiscard]] constexpr Judgement judged(Outcome outcome) {
  switch (outcome) {
    case Outcome::reached:
      return Judgement::passed;
    case Outcome::blocked:
    case Outcome::held:
      return Judgement::cannot_enter;
    case Outcome::left_scene:
    case Outcome::fell:
      return Judgement::flies_off;
  }
  return Judgement::cannot_enter;
}

}  // namespace roam::training
