#pragma once
/// \file
/// Looks of an OBJ file: normals, texture coordinates, vertex colours, materials.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "import/reader/display/look.h"
#include "import/reader/mesh_sink.h"

namespace roam::reader {

class ObjLooks {
 public:
  /// `sink` must have parts.
  ObjLooks(const std::filesystem::path& file, MeshSink& sink) : folder_(file.parent_path()), sink_(sink) {}

  /// Takes a line with keyword vt, vn, mtllib or usemtl; ignores others. Ignores malformed lines too, because they
  /// affect no surface.
  void take_line(std::string_view keyword, std::string_view rest);
  /// Takes the rest of a vertex line after the three coordinates, which may be a colour.
  void take_vertex_colour(std::string_view rest);

  /// The look of a corner such as 7, 7/2, 7//3 or 7/2/3. Its vertex has the number `vertex`, counted from 0.
  [[nodiscard]] VertexLook of(std::uint64_t vertex, std::string_view corner) const;

 private:
  struct Material {
    Look look;
    Colour colour = white;
  };

  void read_libraries(std::string_view names);
  void read_materials(const std::string& name);
  void use_material(const std::string& name);

  std::filesystem::path folder_;
  MeshSink& sink_;
  std::vector<glm::vec2> coordinates_;
  std::vector<glm::vec3> normals_;
  std::vector<Colour> colours_;
  std::uint64_t vertices_ = 0;
  std::map<std::string, Material> materials_;
  Colour material_ = white;
};

}  // namespace roam::reader
