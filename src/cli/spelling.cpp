#include "cli/spelling.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace roam::app {
namespace {

/// Optimal string alignment: a letter inserted, left out or replaced, or two neighbours swapped, counts 1.
std::size_t distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> cost((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return cost[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        at(i, j) = i + j;
        continue;
      }
      const std::size_t replaced = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  }
  return cost.back();
}

std::string_view without_dashes(std::string_view word) {
  return word.substr(std::min(word.find_first_not_of('-'), word.size()));
}

}  // namespace

std::string likely_meant(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t longest_word = 64;  // the cost grows with the square
  constexpr std::size_t least_prefix = 3;
  const std::string_view typed = without_dashes(word);
  if (typed.empty() || typed.size() > longest_word) return {};
  std::string best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : candidates) {
    const std::string_view name = without_dashes(candidate);
    if (name.size() < 2) continue;
    const std::size_t errors = distance(typed, name);
    const std::size_t most = std::max<std::size_t>(1, typed.size() / 3);
    if (errors > most || errors >= least) continue;
    least = errors;
    best = candidate;
  }
  if (!best.empty() || typed.size() < least_prefix) return best;
  const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const std::string& candidate) {
    return without_dashes(candidate).starts_with(typed);
  });
  return found == candidates.end() ? std::string() : *found;
}

}  // namespace roam::app
