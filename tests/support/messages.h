#pragma once
/// Output and errors of a program or a function, for tests of their wording.

#include <stdexcept>
#include <string>

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The message of the exception thrown; empty if there is none.
template <class Run>
std::string error_of(const Run& run) {
  try {
    run();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}
