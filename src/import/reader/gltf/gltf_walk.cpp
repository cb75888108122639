#include "import/reader/gltf/gltf_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <string_view>
#include <utility>

#include "roam/error.h"
#include "text/printable.h"

namespace roam::reader {
namespace {

/// Limit of nesting. A deeper file is damaged, and would exhaust the stack.
constexpr std::size_t depth_limit = 2000;

constexpr std::uint32_t not_added = std::numeric_limits<std::uint32_t>::max();

/// Extensions that a body does not feel, by the beginning of their names, and those that are read.
constexpr std::array<std::string_view, 15> known_extensions{"KHR_draco_mesh_compression",
                                                            "KHR_node_visibility",
                                                            "EXT_meshopt_compression",
                                                            "KHR_mesh_quantization",
                                                            "EXT_mesh_gpu_instancing",
                                                            "CESIUM_RTC",
                                                            "KHR_materials_",
                                                            "KHR_texture_",
                                                            "EXT_texture_",
                                                            "EXT_mesh_features",
                                                            "EXT_structural_",
                                                            "EXT_feature_",
                                                            "EXT_instance_features",
                                                            "KHR_lights_",
                                                            "MSFT_texture_dds"};

const glm::dquat no_rotation(1, 0, 0, 0);

glm::dmat4 from_parts(const Vec3& translation, const glm::dquat& rotation, const Vec3& scale) {
  glm::dmat4 matrix = glm::mat4_cast(rotation);
  for (int axis = 0; axis < 3; ++axis) matrix[axis] *= scale[axis];
  matrix[3] = glm::dvec4(translation, 1.0);
  return matrix;
}

glm::dquat rotation_of(double x, double y, double z, double w) {
  const glm::dquat rotation(w, x, y, z);
  const double length = glm::length(rotation);
  // Quantized rotations are not quite of unit length.
  return length > 0.0 ? rotation / length : no_rotation;
}

glm::dmat4 transform_of(const Json& node) {
  if (const auto m = numbers(member(node, "matrix"), 16)) {
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = (*m)[static_cast<std::size_t>(i)];
    return matrix;
  }
  const auto r = numbers(member(node, "rotation"), 4);
  return from_parts(three_numbers(member(node, "translation")).value_or(Vec3(0.0)),
                    r ? rotation_of((*r)[0], (*r)[1], (*r)[2], (*r)[3]) : no_rotation,
                    three_numbers(member(node, "scale")).value_or(Vec3(1.0)));
}

/// Metres. Objects that meet have the same corners, although their nodes' matrices round differently: otherwise floors
/// would have cracks there. It is the tolerance of worlds.
constexpr double grid = 0x1p-20;

Vec3 on_grid(const Vec3& position) { return grid * glm::round(position / grid); }

}  // namespace

GltfWalk::GltfWalk(GltfFile& file, std::string stem, MeshSink& sink)
    : file_(file), stem_(std::move(stem)), sink_(sink) {
  if (sink_.parts() != nullptr) looks_.emplace(file_, sink_);
  say_what_is_unknown();
}

void GltfWalk::say_what_is_unknown() {
  for (const Json& required : member(file_.json(), "extensionsRequired")) {
    const std::string name = text(required);
    const bool known = std::any_of(known_extensions.begin(), known_extensions.end(),
                                   [&](std::string_view start) { return name.starts_with(start); });
    if (known || name.empty()) continue;
    sink_.report_note_once(fmt::format("{}: it needs the extension {}, which is not read; some of it may be missing.",
                                       file_.path().string(), printable(name)));
  }
}

void GltfWalk::walk(const glm::dmat4& outer, const glm::dmat4& inner) {
  try {
    walk_scene(outer, inner);
  } catch (const Error&) {
    // The reading may go on with other files, but the images of these parts are in this one.
    finish();
    throw;
  }
}

void GltfWalk::walk_scene(const glm::dmat4& outer, const glm::dmat4& inner) {
  const Json& json = file_.json();
  const Json& nodes = member(json, "nodes");
  visited_.assign(nodes.is_array() ? nodes.size() : 0, false);
  names_.clear();
  const auto center = three_numbers(member(member(json, "extensions", "CESIUM_RTC"), "center"));
  const glm::dmat4 matrix = center ? outer * from_parts(*center, no_rotation, Vec3(1.0)) * inner : outer * inner;
  const Json& scenes = member(json, "scenes");
  if (scenes.is_array() && !scenes.empty()) {
    const Json& index = member(json, "scene");
    const Json& scene = index.is_null() ? scenes[0] : file_.item("scenes", index);
    for (const Json& node : member(scene, "nodes")) walk_node(whole_number(node).value_or(visited_.size()), matrix);
    return;
  }
  // Without a scene, all nodes that are no children.
  std::vector<bool> is_child(visited_.size(), false);
  for (const Json& node : nodes) {
    for (const Json& child : member(node, "children")) {
      if (const auto index = whole_number(child); index && *index < is_child.size()) is_child[*index] = true;
    }
  }
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) walk_node(i, matrix);
  }
}

void GltfWalk::walk_node(std::uint64_t index, const glm::dmat4& parent) {
  if (index >= visited_.size()) throw file_.damaged("it refers to one of its 'nodes' that is not there");
  if (visited_[index]) throw file_.damaged(fmt::format("its node {} is reached twice", index));
  if (names_.size() >= depth_limit)
    throw file_.damaged(fmt::format("its nodes are nested more than {} deep", depth_limit));
  visited_[index] = true;
  const Json& node = member(file_.json(), "nodes")[index];
  // A hidden node hides its children.
  if (member(member(node, "extensions", "KHR_node_visibility"), "visible") == Json(false)) return;
  const glm::dmat4 matrix = parent * transform_of(node);
  names_.push_back(text(member(node, "name")));
  if (!member(node, "mesh").is_null()) add_mesh(node, matrix);
  for (const Json& child : member(node, "children")) walk_node(whole_number(child).value_or(visited_.size()), matrix);
  names_.pop_back();
}

void GltfWalk::add_mesh(const Json& node, const glm::dmat4& to_sink) {
  const Json& mesh = file_.item("meshes", member(node, "mesh"));
  const std::uint64_t number = *whole_number(member(node, "mesh"));
  // People name the node; several nodes may share its mesh.
  names_.insert(names_.end() - 1, text(member(mesh, "name")));
  sink_.begin_object(names_, stem_);
  const std::vector<glm::dmat4> places = instances(node);
  const Json& primitives = member(mesh, "primitives");
  for (const glm::dmat4& place : places) {
    for (std::uint64_t i = 0; primitives.is_array() && i < primitives.size(); ++i) {
      const Primitive* read = primitive(number, i, primitives[i]);
      if (read != nullptr) add(primitives[i], *read, to_sink * place);
    }
  }
  names_.erase(names_.end() - 2);
}

const Primitive* GltfWalk::primitive(std::uint64_t mesh, std::uint64_t index, const Json& described) {
  if (!has_triangles(described)) {
    sink_.report_note_once(
        fmt::format("{}: points and lines have no surface; they are left out.", file_.path().string()));
    return nullptr;
  }
  const auto [at, is_new] = primitives_.try_emplace({mesh, index});
  if (is_new) {
    at->second = read_primitive(file_, described, looks_.has_value(), looks_ ? looks_->coordinate_set(described) : 0);
    if (at->second && !at->second->damaged_looks.empty()) {
      sink_.report_note_once(fmt::format("{}: {} of its vertices is damaged; surfaces are shown without it.",
                                         file_.path().string(), at->second->damaged_looks));
    }
  }
  return at->second ? &*at->second : nullptr;
}

void GltfWalk::add(const Json& described, const Primitive& primitive, const glm::dmat4& to_sink) {
  const Elements& positions = primitive.positions;
  if (looks_) looks_->begin(described, primitive, glm::dmat3(to_sink));
  index_.assign(positions.count(), not_added);
  const double scale = std::max({glm::length(to_sink[0]), glm::length(to_sink[1]), glm::length(to_sink[2])});
  const auto added = [&](std::uint32_t vertex) {
    if (vertex >= positions.count()) return not_added;
    std::uint32_t& index = index_[vertex];
    if (index == not_added) {
      const Vec3 position = positions.vector(vertex);
      for (int k = 0; k < 3 && positions.are_floats(); ++k) sink_.note_rounded(scale * position[k]);
      index = sink_.add_shared_vertex(on_grid(Vec3(to_sink * glm::dvec4(position, 1.0))),
                                      looks_ ? looks_->of(vertex) : VertexLook{});
    }
    return index;
  };
  primitive.each_triangle([&](const std::array<std::uint32_t, 3>& corners) {
    // Vertices are added in the order of the corners.
    const std::uint32_t a = added(corners[0]), b = added(corners[1]), c = added(corners[2]);
    sink_.add_triangle(a, b, c);
  });
}

std::vector<glm::dmat4> GltfWalk::instances(const Json& node) {
  const Json& extension = member(node, "extensions", "EXT_mesh_gpu_instancing");
  if (!extension.is_object()) return {glm::dmat4(1.0)};
  const Json& attributes = member(extension, "attributes");
  std::optional<Elements> translations, rotations, scales;
  std::optional<std::uint64_t> all;
  for (const auto& [name, to] :
       {std::pair{"TRANSLATION", &translations}, {"ROTATION", &rotations}, {"SCALE", &scales}}) {
    const Json& accessor = member(attributes, name);
    if (accessor.is_null()) continue;
    to->emplace(file_, accessor);
    if (all.value_or((*to)->count()) != (*to)->count()) {
      throw file_.damaged("its attributes of instances differ in number");
    }
    all = (*to)->count();
  }
  const std::uint64_t count = all.value_or(0);
  std::vector<glm::dmat4> places;
  for (std::uint64_t i = 0; i < count; ++i) {
    const glm::dquat rotation =
        rotations ? rotation_of(rotations->at(i, 0), rotations->at(i, 1), rotations->at(i, 2), rotations->at(i, 3))
                  : no_rotation;
    places.push_back(from_parts(translations ? translations->vector(i) : Vec3(0.0), rotation,
                                scales ? scales->vector(i) : Vec3(1.0)));
  }
  return places;
}

}  // namespace roam::reader
