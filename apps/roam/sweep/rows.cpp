#include "sweep/rows.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "roam/error.h"
#include "text/printable.h"

namespace roam::app {
namespace {

constexpr std::array<std::string_view, 8> columns = {"x", "y", "z", "dx", "dy", "dz", "radius", "half_height"};
constexpr std::size_t needed_columns = 7;
constexpr std::string_view blanks = " \t\r";
constexpr const char* form = "a row is x,y,z,dx,dy,dz,radius[,half_height]";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// The fields of a row; more than `columns` are counted, not kept.
struct Fields {
  std::array<std::string_view, columns.size()> text;
  std::size_t count = 0;
};

Fields split(std::string_view row) {
  Fields fields;
  while (true) {
    const std::size_t comma = row.find(',');
    if (fields.count < fields.text.size()) fields.text[fields.count] = trimmed(row.substr(0, comma));
    ++fields.count;
    if (comma == std::string_view::npos) return fields;
    row.remove_prefix(comma + 1);
  }
}

std::string_view without_plus(std::string_view field) { return field.substr(field.starts_with('+') ? 1 : 0); }

double number(std::string_view field, std::string_view column) {
  double value = 0.0;
  const std::string_view digits = without_plus(field);
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (status == std::errc::invalid_argument || end != digits.data() + digits.size()) {
    throw Error(fmt::format("column {}: '{}' is no number; {}", column, excerpt(field), form));
  }
  if (status != std::errc() || !std::isfinite(value)) {
    throw Error(fmt::format("column {}: '{}' is not a finite number", column, excerpt(field)));
  }
  return value;
}

}  // namespace

bool is_blank(std::string_view row) { return trimmed(row).empty(); }

bool is_query_header(std::string_view row) {
  const Fields fields = split(row);
  // Numbers parse, also "nan" and "inf"; names of columns do not.
  for (std::size_t i = 0; i < std::min(fields.count, columns.size()); ++i) {
    double value = 0.0;
    const std::string_view text = without_plus(fields.text[i]);
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc::invalid_argument) return false;
  }
  bool known = fields.count == needed_columns || fields.count == columns.size();
  for (std::size_t i = 0; known && i < fields.count; ++i) known = fields.text[i] == columns[i];
  if (!known)
    throw Error(fmt::format("'{}' is neither a query nor the header of queries; {}", excerpt(trimmed(row)), form));
  return true;
}

SweepQuery parse_query(std::string_view row) {
  const Fields fields = split(row);
  if (fields.count != needed_columns && fields.count != columns.size()) {
    throw Error(fmt::format("found {} field{}; {}", fields.count, fields.count == 1 ? "" : "s", form));
  }
  std::array<double, columns.size()> v{};
  for (std::size_t i = 0; i < fields.count; ++i) v[i] = number(fields.text[i], columns[i]);
  for (std::size_t i : {std::size_t{6}, std::size_t{7}}) {
    if (v[i] < 0.0) throw Error(fmt::format("column {}: {} is negative; it is a length in metres", columns[i], v[i]));
  }
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7]}};
}

void append_answer(std::string& rows, const Impact& answer) {
  const auto out = std::back_inserter(rows);
  if (!answer.hit) {
    fmt::format_to(out, FMT_COMPILE("0,{:.17g},0,0,0,0,0,0,-1,none,{:.17g}\n"), answer.time, answer.distance);
    return;
  }
  fmt::format_to(out, FMT_COMPILE("1,{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{},{},{:.17g}\n"),
                 answer.time, answer.point.x, answer.point.y, answer.point.z, answer.normal.x, answer.normal.y,
                 answer.normal.z, static_cast<std::int64_t>(answer.unknown ? no_triangle : answer.triangle),
                 answer.unknown ? "unknown" : to_string(answer.feature), answer.distance);
}

}  // namespace roam::app
