#include "import/reader/display/ply_looks.h"

#include <array>
#include <filesystem>
#include <string_view>

namespace roam::reader {

PlyLooks::PlyLooks(const PlyElement& vertex, const PlyHeader& header, const std::filesystem::path& file, MeshSink& sink)
    : roles_(vertex.properties.size(), Role::none), one_(vertex.properties.size(), 1.0) {
  if (sink.parts() == nullptr) return;
  struct Named {
    std::string_view name;
    Role role;
  };
  constexpr std::array<Named, 17> names{{{"nx", Role::normal_x},
                                         {"ny", Role::normal_y},
                                         {"nz", Role::normal_z},
                                         {"red", Role::red},
                                         {"green", Role::green},
                                         {"blue", Role::blue},
                                         {"diffuse_red", Role::red},
                                         {"diffuse_green", Role::green},
                                         {"diffuse_blue", Role::blue},
                                         {"s", Role::across},
                                         {"t", Role::up},
                                         {"u", Role::across},
                                         {"v", Role::up},
                                         {"texture_u", Role::across},
                                         {"texture_v", Role::up},
                                         {"texture_s", Role::across},
                                         {"texture_t", Role::up}}};
  bool has_coordinates = false;
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    const PlyProperty& property = vertex.properties[i];
    if (property.list) continue;
    for (const Named& named : names) {
      if (property.name == named.name) roles_[i] = named.role;
    }
    has_coordinates = has_coordinates || roles_[i] == Role::across;
    if (property.type == PlyType::uint8) one_[i] = 255.0;
    if (property.type == PlyType::uint16) one_[i] = 65535.0;
  }
  Look look;
  if (has_coordinates && !header.texture_file.empty()) {
    look.texture = sink.parts()->textures().add_file(file.parent_path(), header.texture_file, {});
    look.transparency = Transparency::by_texture;
  }
  sink.set_look(look);
}

void PlyLooks::take(std::size_t property, double value, VertexLook& look) const {
  const double part = value / one_[property];
  switch (roles_[property]) {
    case Role::normal_x:
      look.normal.x = static_cast<float>(value);
      break;
    case Role::normal_y:
      look.normal.y = static_cast<float>(value);
      break;
    case Role::normal_z:
      look.normal.z = static_cast<float>(value);
      break;
    case Role::red:
      look.colour[0] = colour_byte(part);
      break;
    case Role::green:
      look.colour[1] = colour_byte(part);
      break;
    case Role::blue:
      look.colour[2] = colour_byte(part);
      break;
    case Role::across:
      look.texture.x = static_cast<float>(value);
      break;
    case Role::up:
      look.texture.y = static_cast<float>(value);
      break;
    case Role::none:
      break;
  }
}

}  // namespace roam::reader
