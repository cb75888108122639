#pragma once
/// \file
/// Guesses at misspelt words.

#include <span>
#include <string>
#include <string_view>

namespace roam::app {

/// The candidate that a misspelt `word` most likely means: the nearest by letters inserted, left out, replaced or
/// swapped, at most one in three; else the first that begins with the word. Empty if there is none. Leading dashes do
/// not count.
[[nodiscard]] std::string likely_meant(std::string_view word, std::span<const std::string> candidates);

}  // namespace roam::app
