#include "import/part_format.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "import/stream_receiver.h"
#include "roam/mesh.h"

namespace roam::reader {
namespace {

using StreamDamaged = StreamReceiver::StreamDamaged;

class Writer : public PayloadWriter {
 public:
  /// Values must have no padding.
  template <class List>
  void add_list(const List& list) {
    add(std::uint64_t{list.size()});
    append(std::as_bytes(std::span(list)));
  }
};

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, std::uint64_t most_node_bytes)
      : rest_(bytes), node_bytes_left_(most_node_bytes) {}

  template <class T>
  T take() {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    std::memcpy(&value, next(1, sizeof(T)).data(), sizeof(T));
    return value;
  }
  template <class Enumeration>
  Enumeration take(Enumeration last) {
    const auto value = take<std::uint8_t>();
    if (value > static_cast<std::uint8_t>(last)) throw StreamDamaged{"a value of no meaning"};
    return static_cast<Enumeration>(value);
  }
  Vec3 take_place() {
    Vec3 v;
    for (int k = 0; k < 3; ++k) v[k] = take<double>();
    return v;
  }
  template <class List>
  void take_list(List& list, std::uint64_t limit = ~std::uint64_t{0}) {
    constexpr std::size_t size = sizeof(*list.data());
    const auto count = take<std::uint64_t>();
    if (count > limit) throw StreamDamaged{"a list that is too long"};
    const auto from = next(count, size);
    list.resize(count);
    if (count > 0) std::memcpy(static_cast<void*>(list.data()), from.data(), from.size());
  }
  /// The length of a list whose elements take at least `size` bytes each.
  std::uint64_t take_count(std::size_t size) {
    const auto count = take<std::uint64_t>();
    if (count > rest_.size() / size) throw StreamDamaged{"a list that is not there"};
    return count;
  }
  /// The same; then makes room for the elements, each of which takes so much in the display.
  template <class List>
  std::uint64_t take_count(List& list, std::size_t size, std::uint64_t cost) {
    const std::uint64_t count = take_count(size);
    take_nodes(count, cost);
    list.reserve(count);
    return count;
  }
  void take_nodes(std::uint64_t count, std::uint64_t cost) {
    if (count > node_bytes_left_ / cost) throw StreamReceiver::ContentTooLarge{};
    node_bytes_left_ -= count * cost;
  }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  std::span<const std::byte> next(std::uint64_t count, std::size_t size) {
    if (count > rest_.size() / size) throw StreamDamaged{"a list that is not there"};
    const auto taken = rest_.first(static_cast<std::size_t>(count) * size);
    rest_ = rest_.subspan(taken.size());
    return taken;
  }

  std::span<const std::byte> rest_;
  std::uint64_t node_bytes_left_;
};

/// Bound of a position: both ends of a scene, its origin, and rounding.
constexpr double place_limit = 4.0 * coordinate_limit;

void check_place(const Vec3& v) {
  // False for a NaN too.
  if (!(std::abs(v.x) <= place_limit && std::abs(v.y) <= place_limit && std::abs(v.z) <= place_limit)) {
    throw StreamDamaged{"a place beyond all scenes"};
  }
}

template <class Vector>
void check_finite(const std::vector<Vector>& vectors) {
  for (const Vector& v : vectors) {
    for (int k = 0; k < Vector::length(); ++k) {
      if (!std::isfinite(v[k])) throw StreamDamaged{"a number that is none"};
    }
  }
}

DisplayTexture take_texture(Reader& from) {
  DisplayTexture texture;
  texture.width = from.take<std::uint32_t>();
  texture.height = from.take<std::uint32_t>();
  texture.levels = from.take<std::uint32_t>();
  texture.texels = from.take(DisplayTexels::dxt5);
  texture.across = from.take(DisplayWrap::mirror);
  texture.up = from.take(DisplayWrap::mirror);
  for (const std::uint32_t side : {texture.width, texture.height}) {
    if (side == 0 || side > DisplayTexture::side_limit) throw StreamDamaged{"an image of no size"};
  }
  if (texture.levels != 1 && texture.levels != DisplayTexture::all_levels(texture.width, texture.height)) {
    throw StreamDamaged{"an image of other levels"};
  }
  from.take_list(texture.bytes);
  if (texture.bytes.size() != DisplayTexture::bytes_of(texture.texels, texture.width, texture.height, texture.levels)) {
    throw StreamDamaged{"an image of another size"};
  }
  return texture;
}

DisplayLook take_look(Reader& from, const DisplayPart& part) {
  DisplayLook look;
  look.texture = from.take<std::uint32_t>();
  look.cover = from.take(DisplayCover::cut);
  look.cutoff = from.take<float>();
  look.roughness = from.take<float>();
  look.metalness = from.take<float>();
  look.gloss_texture = from.take<std::uint32_t>();
  for (std::uint8_t& c : look.emission) c = from.take<std::uint8_t>();
  look.emission_texture = from.take<std::uint32_t>();
  for (const std::uint32_t image : {look.texture, look.gloss_texture, look.emission_texture}) {
    if (image != DisplayLook::no_texture && image >= part.textures.size()) {
      throw StreamDamaged{"a look without its image"};
    }
  }
  for (const float share : {look.cutoff, look.roughness, look.metalness}) {
    if (!(share >= 0.0f && share <= 1.0f)) throw StreamDamaged{"a value of no meaning"};
  }
  return look;
}

DisplayGeometry take_geometry(Reader& from, const DisplayPart& part) {
  DisplayGeometry g;
  g.group = from.take<std::uint32_t>();
  g.look = from.take<std::uint32_t>();
  g.cell = from.take_place();
  constexpr std::uint64_t most = 1u << 16;
  from.take_list(g.positions, most);
  from.take_list(g.colours, most);
  from.take_list(g.normals, most);
  from.take_list(g.coordinates, most);
  from.take_list(g.indices, 3 * most);
  from.take_list(g.runs, most);
  if (g.group >= part.groups || g.look >= part.looks.size()) throw StreamDamaged{"a geometry without a place"};
  check_place(g.cell);
  for (const glm::vec3& p : g.positions) check_place(g.cell + Vec3(p));
  check_finite(g.normals);
  check_finite(g.coordinates);
  const std::size_t n = g.positions.size();
  const bool textured = part.looks[g.look].has_image();
  if (n == 0 || g.indices.empty() || g.indices.size() % 3 != 0 || g.colours.size() != n ||
      (!g.normals.empty() && g.normals.size() != n) || g.coordinates.size() != (textured ? n : 0)) {
    throw StreamDamaged{"a geometry that is not whole"};
  }
  for (const std::uint16_t i : g.indices) {
    if (i >= n) throw StreamDamaged{"a triangle of vertices that are not there"};
  }
  std::uint64_t in_runs = 0;
  for (const DisplayRun& run : g.runs) {
    if (run.object >= part.objects.size()) throw StreamDamaged{"triangles of no object"};
    in_runs += run.triangles;
  }
  if (!g.runs.empty() && 3 * in_runs != g.indices.size()) throw StreamDamaged{"triangles of no object"};
  return g;
}

/// Most levels within levels; the display recurses into each.
constexpr std::uint32_t depth_limit = 64;
constexpr std::uint32_t not_shown = std::numeric_limits<std::uint32_t>::max();

/// `depth`: the depth of each group that is already a level.
DisplayPages take_pages(Reader& from, const DisplayPart& part, std::vector<std::uint32_t>& depth) {
  DisplayPages pages;
  pages.group = from.take<std::uint32_t>();
  pages.center = from.take_place();
  pages.radius = from.take<float>();
  pages.measure = from.take(DisplayMeasure::error);
  pages.error = from.take<float>();
  for (int k = 0; k < 3; ++k) pages.half[k] = from.take<float>();
  if (pages.group >= part.groups || depth[pages.group] >= depth_limit) throw StreamDamaged{"pages without a place"};
  check_place(pages.center);
  if (!(pages.radius >= 0.0f && static_cast<double>(pages.radius) <= place_limit)) {
    throw StreamDamaged{"pages without a size"};
  }
  const auto is_length = [](float length) { return length >= 0.0f && static_cast<double>(length) <= place_limit; };
  if (!is_length(pages.error) || !is_length(pages.half.x) || !is_length(pages.half.y) || !is_length(pages.half.z)) {
    throw StreamDamaged{"pages without a size"};
  }
  constexpr std::size_t least_level_bytes = 20;
  const std::uint64_t count = from.take_count(pages.levels, least_level_bytes, DisplayPart::node_cost);
  bool paged = false;
  for (std::uint64_t i = 0; i < count; ++i) {
    DisplayLevel level;
    level.from = from.take<float>();
    level.to = from.take<float>();
    level.group = from.take<std::uint32_t>();
    from.take_list(level.page, DisplayLevel::page_limit);
    if (std::isnan(level.from) || std::isnan(level.to)) throw StreamDamaged{"a number that is none"};
    paged = paged || level.group == 0;
    if (paged == level.page.empty() || paged != (level.group == 0)) throw StreamDamaged{"a level of nothing"};
    if (!paged) {
      if (level.group >= part.groups || depth[level.group] != not_shown) throw StreamDamaged{"groups that are no tree"};
      depth[level.group] = depth[pages.group] + 1;
    }
    pages.levels.push_back(std::move(level));
  }
  return pages;
}

}  // namespace

std::vector<std::byte> encode(const DisplayPart& part) {
  Writer to;
  to.add(part.groups);
  to.add(std::uint64_t{part.textures.size()});
  for (const DisplayTexture& texture : part.textures) {
    to.add(texture.width);
    to.add(texture.height);
    to.add(texture.levels);
    to.add(texture.texels);
    to.add(texture.across);
    to.add(texture.up);
    to.add_list(texture.bytes);
  }
  to.add(std::uint64_t{part.looks.size()});
  for (const DisplayLook& look : part.looks) {
    to.add(look.texture);
    to.add(look.cover);
    to.add(look.cutoff);
    to.add(look.roughness);
    to.add(look.metalness);
    to.add(look.gloss_texture);
    for (const std::uint8_t c : look.emission) to.add(c);
    to.add(look.emission_texture);
  }
  to.add(std::uint64_t{part.objects.size()});
  for (const std::string& name : part.objects) to.add_list(name);
  to.add(std::uint64_t{part.geometries.size()});
  for (const DisplayGeometry& g : part.geometries) {
    to.add(g.group);
    to.add(g.look);
    to.add(g.cell);
    to.add_list(g.positions);
    to.add_list(g.colours);
    to.add_list(g.normals);
    to.add_list(g.coordinates);
    to.add_list(g.indices);
    to.add_list(g.runs);
  }
  to.add(std::uint64_t{part.pages.size()});
  for (const DisplayPages& pages : part.pages) {
    to.add(pages.group);
    to.add(pages.center);
    to.add(pages.radius);
    to.add(pages.measure);
    to.add(pages.error);
    for (int k = 0; k < 3; ++k) to.add(pages.half[k]);
    to.add(std::uint64_t{pages.levels.size()});
    for (const DisplayLevel& level : pages.levels) {
      to.add(level.from);
      to.add(level.to);
      to.add(level.group);
      to.add_list(level.page);
    }
  }
  return to.take_bytes();
}

void decode(std::span<const std::byte> bytes, DisplayPart& part, std::uint64_t most_node_bytes) {
  // The least bytes of an element, so that no count allocates more than a multiple of the bytes present.
  constexpr std::size_t texture_bytes = 23, look_bytes = 28, name_bytes = 8, geometry_bytes = 80, pages_bytes = 57;
  // A group has no bytes of its own, but each group except the first is a level, which has.
  constexpr std::size_t level_bytes = 16;
  constexpr std::uint64_t node = DisplayPart::node_cost;
  Reader from(bytes, most_node_bytes);
  part.groups = from.take<std::uint32_t>();
  if (part.groups == 0 || part.groups > 1 + bytes.size() / level_bytes) throw StreamDamaged{"groups that are no tree"};
  from.take_nodes(part.groups, node);
  for (auto n = from.take_count(part.textures, texture_bytes, node); n > 0; --n) {
    part.textures.push_back(take_texture(from));
  }
  for (auto n = from.take_count(part.looks, look_bytes, node); n > 0; --n) part.looks.push_back(take_look(from, part));
  for (auto n = from.take_count(part.objects, name_bytes, DisplayPart::name_cost); n > 0; --n) {
    from.take_list(part.objects.emplace_back(), DisplayPart::name_limit);
  }
  std::uint64_t triangles = 0;
  for (auto n = from.take_count(part.geometries, geometry_bytes, node); n > 0; --n) {
    part.geometries.push_back(take_geometry(from, part));
    triangles += part.geometries.back().indices.size() / 3;
  }
  std::vector<std::uint32_t> depth(part.groups, not_shown);
  depth[0] = 0;
  for (auto n = from.take_count(part.pages, pages_bytes, node); n > 0; --n) {
    part.pages.push_back(take_pages(from, part, depth));
  }
  if (!from.at_end()) throw StreamDamaged{"a part that is too long"};
  if (triangles != part.triangles) throw StreamDamaged{"a part of other triangles"};
  if (std::find(depth.begin(), depth.end(), not_shown) != depth.end()) throw StreamDamaged{"groups that are no tree"};
}

}  // namespace roam::reader
