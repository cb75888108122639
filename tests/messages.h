#pragma once
/// What a program or a function says, for the tests of its words.

#include <stdexcept>
#include <string>

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// What is thrown; empty when nothing is.
template <class Run>
std::string error_of(const Run& run) {
  try {
    run();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}
