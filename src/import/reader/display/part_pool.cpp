#include "import/reader/display/part_pool.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "import/part_format.h"
#include "import/stream.h"

namespace roam::reader {
namespace {

/// Bytes of geometry in a part. A part takes a second of reading at most, and thousands of parts are no burden.
constexpr std::size_t part_bytes = 8u << 20;
/// Bytes of geometry that are held back so that a texture is sent once: for one texture, and for all.
constexpr std::size_t one_texture_bytes = 64u << 20;
constexpr std::size_t all_textures_bytes = 512u << 20;
/// Metres. Beyond this the origin is moved, because floats at 10 km are a millimetre apart.
constexpr double far_from_zero = 1e4;
constexpr double origin_rounding = 1e3;

bool has_normals(const Corners& corners, std::span<const VertexLook> looks) {
  return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
    const glm::vec3 n = looks[corner].normal;
    const float square = n.x * n.x + n.y * n.y + n.z * n.z;
    return square > 0.0f && std::isfinite(square);
  });
}

}  // namespace

void PartPool::begin_object(std::string names) {
  if (names.size() > DisplayPart::name_limit) names.resize(DisplayPart::name_limit);
  if (names == object_name_) return;
  object_name_ = std::move(names);
  object_.reset();
}

void PartPool::add(std::span<const Vec3> vertices, std::span<const VertexLook> looks,
                   std::span<const Corners> triangles, const Look& look) {
  if (triangles.empty()) return;
  if (index_.size() < vertices.size()) index_.resize(vertices.size());
  if (!object_) {
    object_ = object_numbers_.try_emplace(object_name_, static_cast<std::uint32_t>(objects_.size())).first->second;
    if (*object_ == objects_.size()) objects_.push_back(object_name_);
  }
  for (const bool normals : {true, false}) {
    const bool any = std::any_of(triangles.begin(), triangles.end(),
                                 [&](const Corners& corners) { return has_normals(corners, looks) == normals; });
    if (!any) continue;
    const auto at = gathered_.try_emplace({look, group_, normals}).first;
    const std::size_t before = at->second.bytes();
    add_to(at->second, vertices, looks, triangles, look, normals);
    const std::size_t bytes = at->second.bytes();
    (look.image() == no_texture ? plain_bytes_ : textured_bytes_) += bytes - before;
    if (!page_) send_enough(look, bytes);
  }
}

void PartPool::send_enough(const Look& look, std::size_t bytes) {
  const bool plain = look.image() == no_texture;
  if (plain && plain_bytes_ >= part_bytes) {
    send_where([](const Look& one) { return one.image() == no_texture; });
  } else if (!plain && bytes >= one_texture_bytes) {
    send_where([&](const Look& one) { return one.image() == look.image(); });
  } else if (textured_bytes_ >= all_textures_bytes) {
    send_where([](const Look&) { return true; });
  }
}

PartGraph& PartPool::begin_page() {
  group_ = 0;
  return page_.emplace(textures_, origin_.value_or(Vec3(0.0)));
}

void PartPool::add_to(Surface& surface, std::span<const Vec3> vertices, std::span<const VertexLook> looks,
                      std::span<const Corners> triangles, const Look& look, bool normals) {
  ++mark_;
  if (surface.runs.empty() || surface.runs.back().object != *object_) {
    surface.runs.push_back({*object_, static_cast<std::uint32_t>(surface.triangles.size())});
  }
  for (const Corners& corners : triangles) {
    if (has_normals(corners, looks) != normals) continue;
    Corners added;
    for (std::size_t k = 0; k < 3; ++k) {
      Index& index = index_[corners[k]];
      if (index.mark != mark_) {
        index = {mark_, static_cast<std::uint32_t>(surface.vertices.size())};
        surface.vertices.push_back(vertices[corners[k]]);
        surface.looks.push_back(looks[corners[k]]);
        if (look.transparency == Transparency::none) surface.looks.back().colour[3] = 255;
      }
      added[k] = index.index;
    }
    surface.triangles.push_back(added);
  }
}

void PartPool::send_where(const std::function<bool(const Look&)>& wanted) {
  std::optional<PartGraph> own;
  TextureId last = no_texture;
  // The map is in the order of textures. So one part has several small textures, and all geometry of one texture is in
  // one part.
  for (auto at = gathered_.begin(); at != gathered_.end();) {
    const auto& [look, group, normals] = at->first;
    Surface& surface = at->second;
    if (!wanted(look)) {
      ++at;
      continue;
    }
    if (own && look.image() != last && own->bytes() >= part_bytes) {
      send(*own);
      own.reset();
    }
    if (!page_ && !own) own.emplace(textures_, origin_near(surface.vertices));
    (page_ ? *page_ : *own).add(surface, look, normals, group, objects_);
    last = look.image();
    (last == no_texture ? plain_bytes_ : textured_bytes_) -= surface.bytes();
    at = gathered_.erase(at);
  }
  if (own) send(*own);
}

void PartPool::finish_file() {
  send_where([](const Look&) { return true; });
  textures_.forget_images();
  objects_.clear();
  object_numbers_.clear();
  object_.reset();
}

void PartPool::end_page() {
  if (page_) send(*page_);
  page_.reset();
}

const Vec3& PartPool::origin_near(std::span<const Vec3> places) {
  if (origin_) return *origin_;
  // The median, so that one stray vertex cannot move the origin.
  Vec3 middle{0.0};
  std::vector<double> along(places.size());
  for (int k = 0; k < 3; ++k) {
    std::transform(places.begin(), places.end(), along.begin(), [k](const Vec3& place) { return place[k]; });
    const auto median = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
    std::nth_element(along.begin(), median, along.end());
    middle[k] = *median;
  }
  origin_ = Vec3(0.0);
  if (std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)}) > far_from_zero) {
    for (int k = 0; k < 3; ++k) (*origin_)[k] = origin_rounding * std::round(middle[k] / origin_rounding);
  }
  return *origin_;
}

void PartPool::send(const PartGraph& graph) {
  const DisplayPart& part = graph.part();
  const std::vector<std::byte> bytes = encode(part);
  // An empty page has no bounds.
  const Box bounds = part.bounds.lower.x <= part.bounds.upper.x ? part.bounds : Box{part.origin, part.origin};
  PartHeader header{};
  for (int k = 0; k < 3; ++k) {
    header.origin[k] = part.origin[k];
    header.lower[k] = bounds.lower[k];
    header.upper[k] = bounds.upper[k];
  }
  header.triangles = part.triangles;
  header.bytes = bytes.size();
  frames_.send(FrameKind::part, PayloadWriter().add(header));
  const std::span<const std::byte> all = bytes;
  for (std::size_t sent = 0; sent < all.size(); sent += payload_limit) {
    frames_.send(FrameKind::part_bytes, all.subspan(sent, std::min<std::size_t>(payload_limit, all.size() - sent)));
  }
  frames_.flush();
}

}  // namespace roam::reader
