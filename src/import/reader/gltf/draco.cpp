#include "import/reader/gltf/draco.h"

#include <draco/compression/decode.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace roam::reader {

DracoMesh::DracoMesh(std::span<const std::byte> bytes) {
  const auto* begin = reinterpret_cast<const char*>(bytes.data());
  draco::DecoderBuffer buffer;
  buffer.Init(begin, bytes.size());
  const auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
  if (!type.ok() || type.value() != draco::TRIANGULAR_MESH) return;
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (decoded.ok()) mesh_ = std::move(decoded).value();
}

DracoMesh::~DracoMesh() = default;

std::optional<Elements> DracoMesh::attribute(std::uint64_t id, bool normalized) const {
  if (id > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  const std::int32_t number = mesh_->GetAttributeIdByUniqueId(static_cast<std::uint32_t>(id));
  if (number < 0) return std::nullopt;
  draco::PointAttribute* from = mesh_->attribute(number);
  // Some encoders leave this out of their attributes, because the glTF file says it.
  const bool is_unit = draco::IsDataTypeIntegral(from->data_type()) && (normalized || from->normalized());
  from->set_normalized(is_unit);
  constexpr int most_components = 4;
  const int components = std::clamp<int>(from->num_components(), 1, most_components);
  std::vector<float> values(std::size_t{mesh_->num_points()} * static_cast<std::size_t>(components));
  float* to = values.data();
  for (draco::PointIndex i(0); i < mesh_->num_points(); ++i, to += components) {
    const draco::AttributeValueIndex value = from->mapped_index(i);
    if (value.value() >= from->size() || !from->ConvertValue<float>(value, static_cast<std::int8_t>(components), to)) {
      std::fill(to, to + components, std::numeric_limits<float>::quiet_NaN());
    }
  }
  // A signed normalized integer reaches -1 twice.
  for (std::size_t i = 0; is_unit && i < values.size(); ++i) values[i] = std::max(values[i], -1.0f);
  return Elements(std::move(values), static_cast<unsigned>(components));
}

Elements DracoMesh::indices() const {
  std::vector<std::uint32_t> corners;
  corners.reserve(std::size_t{mesh_->num_faces()} * 3);
  for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh_->face(f)) corners.push_back(corner.value());
  }
  return Elements(std::move(corners));
}

}  // namespace roam::reader
