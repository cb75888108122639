#include "import/reader/tileset/feature_table.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "roam/error.h"

namespace roam::reader {
namespace {

constexpr int table_depth = 32;

template <class T>
T read(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

}  // namespace

FeatureTable::FeatureTable(std::string_view text, std::string_view binary, std::string place)
    : binary_(binary), place_(std::move(place)) {
  // The JSON is padded with blanks, by some exporters with zeros. An empty one is allowed.
  while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.remove_suffix(1);
  if (!text.empty()) json_ = parse_json(text, place_, table_depth);
}

std::optional<Vec3> FeatureTable::global_vector(const char* name) const {
  const Json& value = member(json_, name);
  if (value.is_null()) return std::nullopt;
  if (const auto three = three_numbers(value)) return three;
  const auto offset = whole_number(member(value, "byteOffset"));
  if (!offset || *offset > binary_.size() || binary_.size() - *offset < 3 * sizeof(float)) {
    throw Error(place_, fmt::format("{} in its feature table is not three numbers; the tile is damaged.", name));
  }
  Vec3 three;
  for (int k = 0; k < 3; ++k) {
    three[k] = static_cast<double>(read<float>(binary_, *offset + static_cast<std::size_t>(k) * sizeof(float)));
    if (!std::isfinite(three[k])) throw Error(place_, fmt::format("{} is not finite; the tile is damaged.", name));
  }
  return three;
}

std::uint64_t FeatureTable::global_count(const char* name) const {
  const Json& value = member(json_, name);
  if (const auto count = whole_number(value)) return *count;
  const auto offset = whole_number(member(value, "byteOffset"));
  if (!offset || *offset > binary_.size() || binary_.size() - *offset < sizeof(std::uint32_t)) return 0;
  return read<std::uint32_t>(binary_, *offset);
}

bool FeatureTable::global_flag(const char* name) const {
  const Json& value = member(json_, name);
  return value.is_boolean() && value.get<bool>();
}

std::optional<FeatureTable::Values> FeatureTable::each(const char* name, std::uint64_t count, unsigned components,
                                                       bool are_floats) const {
  const Json& value = member(json_, name);
  if (value.is_null()) return std::nullopt;
  const auto offset = whole_number(member(value, "byteOffset"));
  const std::uint64_t bytes = components * (are_floats ? sizeof(float) : sizeof(std::uint16_t));
  if (!offset || *offset > binary_.size() || count > (binary_.size() - *offset) / bytes) {
    throw Error(place_, fmt::format("{} in its feature table reaches beyond the tile; the tile is damaged.", name));
  }
  return Values{binary_.substr(*offset, count * bytes), components, are_floats};
}

double FeatureTable::Values::at(std::uint64_t i, unsigned component) const {
  const std::uint64_t number = i * components + component;
  if (are_floats) return static_cast<double>(read<float>(bytes, number * sizeof(float)));
  return read<std::uint16_t>(bytes, number * sizeof(std::uint16_t));
}

}  // namespace roam::reader
