#include "import/reader/gltf/elements.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "roam/error.h"

namespace roam::reader {
namespace {

enum ComponentType { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// Accessors without data are all zero: enough for what real files leave to an extension or to sparse elements.
constexpr std::uint64_t most_zeros = 1u << 24;

/// Bytes of a component; 0 for an unknown type.
unsigned bytes_of(int type) {
  switch (type) {
    case i8:
    case u8:
      return 1;
    case i16:
    case u16:
      return 2;
    case u32:
    case f32:
      return 4;
    default:
      return 0;
  }
}

unsigned components_of(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  return type == "VEC4" ? 4 : 0;
}

template <class T>
T read(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

/// A signed normalized integer reaches -1 twice.
double signed_unit(double value, double largest) { return std::max(value / largest, -1.0); }

}  // namespace

bool is_normalized(const Json& accessor) {
  const Json& normalized = member(accessor, "normalized");
  return normalized.is_boolean() && normalized.get<bool>();
}

Elements::Elements(std::vector<float> values, unsigned components) : own_(std::move(values)) {
  base_.type = f32;
  base_.components = components;
  base_.stride = components * sizeof(float);
  base_.bytes = std::as_bytes(std::span(own_));
  count_ = own_.size() / components;
}

Elements::Elements(std::vector<std::uint32_t> indices) : own_indices_(std::move(indices)) {
  base_.type = u32;
  base_.stride = sizeof(std::uint32_t);
  base_.bytes = std::as_bytes(std::span(own_indices_));
  count_ = own_indices_.size();
}

Elements::Elements(GltfFile& file, const Json& index) {
  const Json& accessor = file.item("accessors", index);
  const auto count = whole_number(member(accessor, "count"));
  base_.type = static_cast<int>(whole_number(member(accessor, "componentType")).value_or(0) & 0xffff);
  base_.components = components_of(text(member(accessor, "type")));
  base_.normalized = is_normalized(accessor);
  const unsigned element_bytes = bytes_of(base_.type) * base_.components;
  if (!count || element_bytes == 0 || *count > std::numeric_limits<std::uint32_t>::max()) {
    throw file.damaged("an accessor has no count, or an unknown type");
  }
  count_ = *count;
  if (const Json& view = member(accessor, "bufferView"); !view.is_null()) {
    base_.bytes = within(file, view, member(accessor, "byteOffset"), count_, element_bytes, base_.stride);
  } else if (count_ > most_zeros) {
    throw file.damaged("an accessor without data has too many elements");
  }
  if (const Json& sparse = member(accessor, "sparse"); sparse.is_object()) read_sparse(file, sparse);
}

std::span<const std::byte> Elements::within(GltfFile& file, const Json& view, const Json& offset, std::uint64_t count,
                                            std::uint64_t element_bytes, std::uint64_t& stride) {
  const auto index = whole_number(view);
  if (!index) throw file.damaged("an accessor names no buffer view");
  const Json& described = file.item("bufferViews", view);
  const std::span<const std::byte> bytes = file.view(*index);
  const auto begin = offset.is_null() ? std::optional<std::uint64_t>(0) : whole_number(offset);
  stride = whole_number(member(described, "byteStride")).value_or(0);
  if (stride == 0) stride = element_bytes;
  const bool fits = begin && *begin <= bytes.size() &&
                    (count == 0 || (bytes.size() - *begin >= element_bytes &&
                                    (bytes.size() - *begin - element_bytes) / stride >= count - 1));
  if (!fits) throw file.damaged("an accessor reaches beyond its buffer view");
  return count == 0 ? std::span<const std::byte>() : bytes.subspan(*begin);
}

void Elements::read_sparse(GltfFile& file, const Json& sparse) {
  const std::uint64_t count = whole_number(member(sparse, "count")).value_or(0);
  const Json& where = member(sparse, "indices");
  const Json& what = member(sparse, "values");
  Values indices;
  indices.type = static_cast<int>(whole_number(member(where, "componentType")).value_or(0) & 0xffff);
  if (count > count_ || bytes_of(indices.type) == 0) throw file.damaged("a sparse accessor has no indices");
  indices.bytes = within(file, member(where, "bufferView"), member(where, "byteOffset"), count, bytes_of(indices.type),
                         indices.stride);
  replacing_ = base_;
  replacing_.bytes = within(file, member(what, "bufferView"), member(what, "byteOffset"), count,
                            bytes_of(base_.type) * base_.components, replacing_.stride);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double element = indices.at(i, 0);
    if (!(element >= 0.0 && element < static_cast<double>(count_))) {
      throw file.damaged("a sparse accessor replaces an element that is not there");
    }
    replaced_[static_cast<std::uint64_t>(element)] = i;
  }
}

double Elements::Values::at(std::uint64_t element, unsigned component) const {
  if (bytes.empty() || component >= components) return 0.0;
  const std::byte* from = bytes.data() + element * stride + std::uint64_t{component} * bytes_of(type);
  switch (type) {
    case i8: {
      const double value = read<std::int8_t>(from);
      return normalized ? signed_unit(value, 127.0) : value;
    }
    case u8: {
      const double value = read<std::uint8_t>(from);
      return normalized ? value / 255.0 : value;
    }
    case i16: {
      const double value = read<std::int16_t>(from);
      return normalized ? signed_unit(value, 32767.0) : value;
    }
    case u16: {
      const double value = read<std::uint16_t>(from);
      return normalized ? value / 65535.0 : value;
    }
    case u32:
      return read<std::uint32_t>(from);
    default:
      return static_cast<double>(read<float>(from));
  }
}

bool Elements::are_floats() const { return base_.type == f32; }

double Elements::at(std::uint64_t element, unsigned component) const {
  if (element >= count_) return 0.0;
  if (!replaced_.empty()) {
    if (const auto other = replaced_.find(element); other != replaced_.end()) {
      return replacing_.at(other->second, component);
    }
  }
  return base_.at(element, component);
}

std::uint32_t Elements::index(std::uint64_t element) const {
  const double value = at(element, 0);
  return value >= 0.0 && value < 4294967295.0 ? static_cast<std::uint32_t>(value)
                                              : std::numeric_limits<std::uint32_t>::max();
}

}  // namespace roam::reader
