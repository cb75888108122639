#include "words/verification.h"

#include <fmt/format.h>

#include "words/measures.h"

namespace roam::words {

std::string checked(const verification::Verification& found, std::uint64_t triangles) {
  if (found.violations > 0) {
    return fmt::format("FAILED: in {} steps the body was inside a surface", grouped(found.violations));
  }
  if (found.pieces == 0) return "nothing: the body made no move";
  if (!found.unread.empty()) return "not everywhere: no violation was found, but not all triangles could be read";
  return fmt::format("every move against all {} triangles: 0 violations", grouped(triangles));
}

}  // namespace roam::words
