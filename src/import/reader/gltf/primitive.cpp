#include "import/reader/gltf/primitive.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "import/reader/gltf/draco.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

std::uint64_t mode_of(const Json& primitive) {
  const Json& mode = member(primitive, "mode");
  return mode.is_null() ? Primitive::triangles : whole_number(mode).value_or(0);
}

}  // namespace

bool has_triangles(const Json& primitive) {
  const std::uint64_t mode = mode_of(primitive);
  return mode >= Primitive::triangles && mode <= Primitive::triangle_fan;
}

void Primitive::each_triangle(const std::function<void(const std::array<std::uint32_t, 3>&)>& take) const {
  const std::uint64_t corners = indices ? indices->count() : positions.count();
  const auto corner = [&](std::uint64_t i) { return indices ? indices->index(i) : static_cast<std::uint32_t>(i); };
  if (mode == triangles) {
    for (std::uint64_t i = 0; i + 2 < corners; i += 3) take({corner(i), corner(i + 1), corner(i + 2)});
    return;
  }
  for (std::uint64_t i = 0; i + 2 < corners; ++i) {
    if (mode == triangle_fan) {
      take({corner(0), corner(i + 1), corner(i + 2)});
    } else {
      // The winding of a strip changes from triangle to triangle.
      take({corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2)});
    }
  }
}

std::optional<Primitive> read_primitive(GltfFile& file, const Json& primitive, bool looks, std::uint64_t set) {
  const Json& attributes = member(primitive, "attributes");
  const Json& compressed = member(primitive, "extensions", "KHR_draco_mesh_compression");
  std::optional<DracoMesh> mesh;
  if (compressed.is_object()) {
    const auto view = whole_number(member(compressed, "bufferView"));
    if (!view) throw file.damaged("a Draco primitive names no buffer view");
    mesh.emplace(file.view(*view));
    if (!mesh->is_whole()) throw file.damaged(fmt::format("Draco cannot decode its buffer view {}", *view));
  }
  const auto attribute = [&](const std::string& name) -> std::optional<Elements> {
    const Json& accessor = member(attributes, name.c_str());
    if (mesh) {
      if (const auto id = whole_number(member(member(compressed, "attributes"), name.c_str())))
        return mesh->attribute(*id, !accessor.is_null() && is_normalized(file.item("accessors", accessor)));
    }
    if (accessor.is_null()) return std::nullopt;
    return Elements(file, accessor);
  };
  std::optional<Elements> positions = attribute("POSITION");
  if (!positions) return std::nullopt;
  if (positions->components() != 3) throw file.damaged("positions have no three coordinates");
  Primitive read{std::move(*positions), {}, {}, {}, {}, mode_of(primitive)};
  if (mesh) {
    read.indices = mesh->indices();
    read.mode = Primitive::triangles;
  } else if (const Json& indices = member(primitive, "indices"); !indices.is_null()) {
    read.indices.emplace(file, indices);
  }
  if (!looks) return read;
  const auto look = [&](const std::string& name) -> std::optional<Elements> {
    try {
      return attribute(name);
    } catch (const Error&) {
      read.damaged_looks = name;
      return std::nullopt;
    }
  };
  read.normals = look("NORMAL");
  read.colours = look("COLOR_0");
  read.coordinates = look("TEXCOORD_" + std::to_string(set));
  for (std::optional<Elements>* one : {&read.normals, &read.colours, &read.coordinates}) {
    if (*one && (*one)->count() < read.positions.count()) one->reset();
  }
  return read;
}

}  // namespace roam::reader
