#pragma once
/// \file
/// What the numbers of options may be.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace roam::app {

/// A finite number greater than 0.
inline const CLI::Validator positive(
    [](const std::string& text) {
      double value = 0.0;
      const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
      return number && value > 0.0 ? std::string() : "'" + text + "' is not a number greater than 0";
    },
    "");

/// A number from `least` to `most`.
inline CLI::Validator number_within(double least, double most) {
  return {[=](std::string& text) {
            double value = 0.0;
            const bool within = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return within ? std::string() : fmt::format("'{}' is not a number from {:g} to {:g}", text, least, most);
          },
          ""};
}

}  // namespace roam::app
