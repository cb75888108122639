#include "cli/values.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "cli/usage.h"

namespace roam::app {
namespace {

/// A number with a unit k, M, G or T, the powers of `step`. None unless the product is whole.
std::optional<std::uint64_t> with_unit(std::string_view text, double step, bool of_bytes) {
  const char* const end = text.data() + text.size();
  double number = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc()) return std::nullopt;
  std::string unit(rest, end);
  unit.erase(0, unit.find_first_not_of(' '));
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr std::string_view units = "kmgt";
  const std::size_t power = unit.empty() ? std::string_view::npos : units.find(unit.front());
  if (power != std::string_view::npos) {
    number *= std::pow(step, static_cast<double>(power + 1));
    unit.erase(0, 1);
    if (of_bytes && unit == "ib") unit.clear();
  }
  if (of_bytes && unit == "b") unit.clear();
  // 4.1 is no exact double, so 4.1 × 10⁶ is not computed as a whole number.
  constexpr double most = 1e18, rounding = 1e-15;
  const double whole = std::round(number);
  if (!unit.empty() || !(number >= 0.0) || number > most || std::abs(number - whole) > rounding * number)
    return std::nullopt;
  return static_cast<std::uint64_t>(whole);
}

constexpr std::string_view choices_prefix = "one of ";

CLI::Validator rewritten(double step, bool of_bytes, const char* what) {
  return {[=](std::string& text) {
            const auto value = with_unit(text, step, of_bytes);
            if (!value) return fmt::format("'{}' is not {}", text, what);
            text = std::to_string(*value);
            return std::string();
          },
          ""};
}

}  // namespace

CLI::Option* add_place(CLI::App& app, const std::string& name, std::vector<double>& place, const std::string& what) {
  return app.add_option(name, place, what)->expected(3)->delimiter(',')->allow_extra_args(false)->type_name("X,Y,Z");
}

CLI::Validator positive() {
  return {[](std::string& text) {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            return number && value > 0.0 ? std::string() : fmt::format("'{}' is not a number greater than 0", text);
          },
          ""};
}

CLI::Validator one_of(std::vector<std::string> words) {
  // The name is where choices_of finds the words.
  std::string name = fmt::format("{}{}", choices_prefix, fmt::join(words, "|"));
  return {[words = std::move(words)](std::string& text) {
            const bool known = std::find(words.begin(), words.end(), text) != words.end();
            return known ? std::string() : fmt::format("'{}' is not {}", text, one_of_text(words));
          },
          "", std::move(name)};
}

std::vector<std::string> choices_of(const CLI::Option& option) {
  // CLI11 lets only a changeable option list its validators, and throws after the last.
  auto& listed = const_cast<CLI::Option&>(option);
  try {
    for (int i = 0;; ++i) {
      const std::string& name = listed.get_validator(i)->get_name();
      if (name.starts_with(choices_prefix)) return CLI::detail::split(name.substr(choices_prefix.size()), '|');
    }
  } catch (const CLI::OptionNotFound&) {
    return {};
  }
}

CLI::Validator counted() { return rewritten(1000.0, false, "a whole number such as 5000, 500k or 20M"); }

CLI::Validator bytes() { return rewritten(1024.0, true, "a size such as 64M or 8G"); }

}  // namespace roam::app
