#pragma once
/// \file
/// Checks of the values of options. Every check states the error in one clause: "'abc' is not a number".

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include "roam/generate.h"

namespace roam::app {

/// A finite number greater than 0.
[[nodiscard]] CLI::Validator positive();

/// A number of this type from `least` to `most`.
template <class Number>
[[nodiscard]] CLI::Validator from_to(Number least, Number most) {
  return {[=](std::string& text) {
            Number value{};
            bool within = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            if constexpr (std::is_integral_v<Number>) {  // CLI11 clamps numbers that do not fit
              const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
              within = within && read.ec != std::errc::result_out_of_range;
            }
            return within ? std::string()
                          : fmt::format("'{}' is not a {} from {} to {}", text,
                                        std::is_integral_v<Number> ? "whole number" : "number", least, most);
          },
          ""};
}

/// A seed.
[[nodiscard]] inline CLI::Validator seed() {
  return from_to<std::int64_t>(0, std::numeric_limits<std::int64_t>::max());
}

/// A number of threads.
[[nodiscard]] inline CLI::Validator thread_count() { return from_to(1, 4096); }

/// A number of flights, queries and the like.
[[nodiscard]] inline CLI::Validator at_least_one() { return from_to<std::int64_t>(1, 100'000'000); }

/// One of these words.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> words);
/// These words, of an option that is checked by one_of; else empty.
[[nodiscard]] std::vector<std::string> choices_of(const CLI::Option& option);

/// Rewrites 500k or 20M as 500000 or 20000000.
[[nodiscard]] CLI::Validator counted();

/// Rewrites 64M or 8G as bytes. K, M, G and T are powers of 1024; B or iB may follow.
[[nodiscard]] CLI::Validator bytes();

/// An option for a place: three numbers, as 1,2,3 or 1 2 3. No later argument counts as a fourth.
CLI::Option* add_place(CLI::App& app, const std::string& name, std::vector<double>& place, const std::string& what);

/// An option for a number of triangles, within roam::generate's limits, at least `least`.
inline CLI::Option* add_triangles(CLI::App& app, const std::string& name, std::uint64_t& triangles,
                                  const std::string& what, std::uint64_t least = generate::least_triangles) {
  return app.add_option(name, triangles, what + " (e.g. 500k or 20M)")
      ->transform(counted())
      ->check(from_to<std::uint64_t>(least, generate::most_triangles))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace roam::app
