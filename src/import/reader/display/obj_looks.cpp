#include "import/reader/display/obj_looks.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include "import/reader/display/image_file.h"
#include "import/reader/numbers.h"

namespace roam::reader {
namespace {

/// Parses numbers until `numbers` is full. Returns how many there were.
template <std::size_t n>
std::size_t take_numbers(std::string_view rest, std::array<double, n>& numbers) {
  for (std::size_t i = 0; i < n; ++i) {
    if (!parse(take_word(rest), numbers[i])) return i;
  }
  return n;
}

/// The element of a corner's index: from 1 on, or backwards from -1.
template <class T>
const T* indexed(const std::vector<T>& elements, std::string_view word) {
  std::int64_t index = 0;
  if (!parse(word, index)) return nullptr;
  const auto count = static_cast<std::int64_t>(elements.size());
  if (index == 0 || index > count || index < -count) return nullptr;
  return &elements[static_cast<std::size_t>(index > 0 ? index - 1 : count + index)];
}

}  // namespace

void ObjLooks::take_line(std::string_view keyword, std::string_view rest) {
  std::array<double, 3> numbers{};
  if (keyword == "vt") {
    take_numbers(rest, numbers);
    coordinates_.emplace_back(numbers[0], numbers[1]);
  } else if (keyword == "vn") {
    take_numbers(rest, numbers);
    normals_.emplace_back(numbers[0], numbers[1], numbers[2]);
  } else if (keyword == "mtllib") {
    read_libraries(trimmed(rest));
  } else if (keyword == "usemtl") {
    use_material(std::string(trimmed(rest)));
  }
}

void ObjLooks::take_vertex_colour(std::string_view rest) {
  std::array<double, 4> numbers{};
  ++vertices_;
  const std::size_t count = take_numbers(rest, numbers);
  // One number is a weight, which polygons do not have. Of four numbers the first is a weight.
  if (count < 3) return;
  const std::size_t first = count - 3;
  colours_.resize(vertices_ - 1, white);
  colours_.push_back(
      {colour_byte(numbers[first]), colour_byte(numbers[first + 1]), colour_byte(numbers[first + 2]), 255});
}

VertexLook ObjLooks::of(std::uint64_t vertex, std::string_view corner) const {
  VertexLook look;
  look.colour = vertex < colours_.size() ? material_ * colours_[vertex] : material_;
  const auto first = corner.find('/');
  if (first == std::string_view::npos) return look;
  const auto second = corner.find('/', first + 1);
  const std::string_view coordinate =
      corner.substr(first + 1, second == std::string_view::npos ? second : second - first - 1);
  if (const auto* found = indexed(coordinates_, coordinate)) look.texture = *found;
  if (second == std::string_view::npos) return look;
  if (const auto* found = indexed(normals_, corner.substr(second + 1))) look.normal = *found;
  return look;
}

void ObjLooks::read_libraries(std::string_view names) {
  SceneFiles& files = sink_.parts()->textures().files();
  const auto is_there = [&](const std::string& name) { return !find_image_file(files, folder_, name).empty(); };
  std::vector<std::string> several;
  for (std::string_view rest = names; !trimmed(rest).empty();) several.emplace_back(take_word(rest));
  // Names are apart by blanks, and may have blanks.
  const std::string one(names);
  if (is_there(one) || std::none_of(several.begin(), several.end(), is_there)) several.assign(1, one);
  for (const std::string& name : several) read_materials(name);
}

void ObjLooks::read_materials(const std::string& name) {
  // The search for images applies: by the name, and by its last part if the path is of another machine.
  SceneFiles& files = sink_.parts()->textures().files();
  const std::filesystem::path file = find_image_file(files, folder_, name);
  if (file.empty()) {
    return sink_.report_note_once(fmt::format("{}: this file of materials is not there; what uses it is shown white.",
                                              (folder_ / name).string()));
  }
  std::istringstream stream(image_bytes(files, file));
  std::map<std::string, int> numbers;
  std::vector<tinyobj::material_t> read;
  std::string warning, error;
  tinyobj::LoadMtl(&numbers, &read, &stream, &warning, &error);
  for (const tinyobj::material_t& one : read) {
    Material material;
    const double opacity = one.dissolve > 0.0f ? one.dissolve : 1.0;
    material.colour = {255, 255, 255, colour_byte(opacity)};
    if (one.diffuse_texname.empty()) {
      for (std::size_t k = 0; k < 3; ++k) material.colour[k] = colour_byte(one.diffuse[k]);
    } else {
      const auto wrap = one.diffuse_texopt.clamp ? DisplayWrap::clamp : DisplayWrap::repeat;
      material.look.texture = sink_.parts()->textures().add_file(file.parent_path(), one.diffuse_texname, {wrap, wrap});
    }
    material.look.transparency = material.colour[3] < 255 ? Transparency::blend : Transparency::by_texture;
    materials_[one.name] = material;
  }
}

void ObjLooks::use_material(const std::string& name) {
  const auto found = materials_.find(name);
  material_ = found == materials_.end() ? white : found->second.colour;
  sink_.set_look(found == materials_.end() ? Look{} : found->second.look);
}

}  // namespace roam::reader
