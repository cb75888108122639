#include "import/reader/display/ply_looks.h"

#include <array>
#include <string_view>

namespace roam::reader {
namespace {

Look look_of(const std::filesystem::path& file, const std::string& image, MeshSink& sink) {
  Look look;
  look.texture = sink.parts()->textures().add_file(file.parent_path(), image, {});
  look.transparency = Transparency::by_texture;
  return look;
}

}  // namespace

PlyLooks::PlyLooks(const PlyElement& vertex, const PlyHeader& header, const std::filesystem::path& file, MeshSink& sink)
    : roles_(vertex.properties.size(), none), one_(vertex.properties.size(), 1.0) {
  if (sink.parts() == nullptr) return;
  struct Named {
    std::string_view name;
    Role role;
  };
  constexpr std::array<Named, 17> names{{{"nx", normal_x},
                                         {"ny", normal_y},
                                         {"nz", normal_z},
                                         {"red", red},
                                         {"green", green},
                                         {"blue", blue},
                                         {"diffuse_red", red},
                                         {"diffuse_green", green},
                                         {"diffuse_blue", blue},
                                         {"s", across},
                                         {"t", up},
                                         {"u", across},
                                         {"v", up},
                                         {"texture_u", across},
                                         {"texture_v", up},
                                         {"texture_s", across},
                                         {"texture_t", up}}};
  bool has_coordinates = false;
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    const PlyProperty& property = vertex.properties[i];
    if (property.list) continue;
    for (const Named& named : names) {
      if (property.name == named.name) roles_[i] = named.role;
    }
    has_coordinates = has_coordinates || roles_[i] == across;
    if (property.type == PlyType::uint8) one_[i] = 255.0;
    if (property.type == PlyType::uint16) one_[i] = 65535.0;
  }
  const bool textured = has_coordinates && !header.texture_files.empty();
  sink.set_look(textured ? look_of(file, header.texture_files.front(), sink) : Look{});
}

void PlyLooks::take(std::size_t property, double value, VertexLook& look) const {
  const int role = roles_[property];
  if (role < red) {
    look.normal[role] = static_cast<float>(value);
  } else if (role < across) {
    look.colour[static_cast<std::size_t>(role - red)] = colour_byte(value / one_[property]);
  } else if (role < none) {
    look.texture[role - across] = static_cast<float>(value);
  }
}

PlyWedges::PlyWedges(const PlyHeader& header, const std::filesystem::path& file, MeshSink& sink) : sink_(sink) {
  if (sink.parts() == nullptr) return;
  bool any = false;
  for (const PlyElement& element : header.elements) {
    // Strips share vertices by index.
    if (element.name == "tristrips") return;
    for (const PlyProperty& property : element.properties) {
      any = any || (element.name == "face" && is_coordinates(property));
    }
  }
  if (!any) return;
  for (const std::string& image : header.texture_files) looks_.push_back(look_of(file, image, sink));
}

bool PlyWedges::is_coordinates(const PlyProperty& property) const {
  return property.list && property.name == "texcoord";
}

bool PlyWedges::is_image(const PlyProperty& property) const {
  return !property.list && is_integer(property.type) && property.name == "texnumber";
}

void PlyWedges::add_face(std::span<const std::uint32_t> corners, std::span<const double> coordinates,
                         std::int64_t image) {
  const bool textured =
      coordinates.size() == 2 * corners.size() && image >= 0 && image < static_cast<std::int64_t>(looks_.size());
  sink_.set_look(textured ? looks_[static_cast<std::size_t>(image)] : Look{});
  std::uint32_t first = 0, before = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Vertex vertex = vertices_[corners[i]];
    if (textured) vertex.look.texture = {coordinates[2 * i], coordinates[2 * i + 1]};
    const std::uint32_t corner = sink_.add_shared_vertex(vertex.place, vertex.look);
    if (i == 0) first = corner;
    if (i >= 2) sink_.add_triangle(first, before, corner);
    before = corner;
  }
}

}  // namespace roam::reader
