#pragma once
/// \file
/// Sentences about the result of --verify.

#include <cstdint>
#include <string>

#include "verify/verification.h"

namespace roam::words {

/// "every move against all 499,936 triangles: 0 violations". `triangles`: of the
/// scene.
[[nodiscard]] std::string checked(const verification::Verification& found, std::uint64_t triangles);

}  // namespace roam::words
