#pragma once
/// \file
/// What the numbers of options may be.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "roam/generate.h"

namespace roam::app {

/// A finite number greater than 0.
inline const CLI::Validator positive(
    [](const std::string& text) {
      double value = 0.0;
      const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
      return number && value > 0.0 ? std::string() : "'" + text + "' is not a number greater than 0";
    },
    "");

/// A number of this type from `least` to `most`.
template <class Number>
CLI::Validator from_to(Number least, Number most) {
  return {[=](std::string& text) {
            Number value{};
            const bool within = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return within ? std::string()
                          : "'" + text + "' is not a " + (std::is_integral_v<Number> ? "whole number" : "number") +
                                " from " + CLI::detail::to_string(least) + " to " + CLI::detail::to_string(most);
          },
          ""};
}

/// Of flights, queries and the like.
inline CLI::Validator at_least_one() { return from_to<std::int64_t>(1, 100'000'000); }

/// Takes 500000, 500k or 2M, as many as roam::generate makes, `least` at least.
inline CLI::Option* add_triangles(CLI::App& app, const std::string& name, std::uint64_t& triangles,
                                  const std::string& what, std::uint64_t least = generate::least_triangles) {
  return app.add_option(name, triangles, what + " (e.g. 500k or 20M)")
      ->transform(CLI::AsNumberWithUnit(std::map<std::string, std::uint64_t>{{"k", 1'000}, {"m", 1'000'000}}))
      ->check(from_to<std::uint64_t>(least, generate::most_triangles))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace roam::app
