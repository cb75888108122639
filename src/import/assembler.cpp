#include "import/assembler.h"

#include <cmath>
#include <limits>
#include <utility>

#include "roam/world.h"

namespace roam::reader {
namespace {

using Corners = std::array<std::uint32_t, 3>;
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Corners) == 3 * sizeof(std::uint32_t));

template <class T>
std::vector<T> copied(std::span<const std::byte> payload) {
  if (payload.size() % sizeof(T) != 0) throw Assembler::StreamDamaged{"a frame of broken length"};
  std::vector<T> values(payload.size() / sizeof(T));
  if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), payload.data(), payload.size());
  return values;
}

template <class T>
std::vector<T> joined(std::vector<std::vector<T>>& pieces) {
  if (pieces.size() == 1) {
    std::vector<T> only = std::move(pieces.front());
    pieces.clear();
    return only;
  }
  std::size_t count = 0;
  for (const auto& piece : pieces) count += piece.size();
  std::vector<T> all;
  all.reserve(count);
  for (auto& piece : pieces) {
    all.insert(all.end(), piece.begin(), piece.end());
    std::vector<T>().swap(piece);
  }
  pieces.clear();
  return all;
}

/// Adds to the entry of that name, or makes one while there is room.
void note_object(std::vector<LeftOutObject>& objects, LeftOutObject&& object) {
  for (LeftOutObject& known : objects) {
    if (known.name == object.name) {
      known.vertices += object.vertices;
      known.triangles += object.triangles;
      return;
    }
  }
  if (objects.size() < ImportReport::name_limit) objects.push_back(std::move(object));
}

/// Most sentences that one reader may say.
constexpr std::size_t note_limit = 100;

}  // namespace

Assembler::Assembler(Scene& scene, std::size_t ignore_patterns, std::uint64_t mesh_bytes)
    : scene_(scene), ignore_patterns_(ignore_patterns), mesh_bytes_left_(mesh_bytes) {}

void Assembler::take(std::span<const std::byte> bytes) {
  pending_.insert(pending_.end(), bytes.begin(), bytes.end());
  std::size_t begin = 0;
  while (pending_.size() - begin >= sizeof(FrameHeader)) {
    FrameHeader header;
    std::memcpy(&header, pending_.data() + begin, sizeof(header));
    if (header.magic != frame_magic || header.zero != 0 || header.bytes > payload_limit) {
      throw StreamDamaged{"bytes that are no frame"};
    }
    if (header.number != next_number_) throw StreamDamaged{"frames out of order"};
    if ((header.number == 0) != (header.kind == FrameKind::hello)) throw StreamDamaged{"no greeting"};
    if (ended_) throw StreamDamaged{"frames after the end"};
    if (pending_.size() - begin - sizeof(header) < header.bytes) break;
    handle(header, std::span(pending_).subspan(begin + sizeof(header), header.bytes));
    ++next_number_;
    begin += sizeof(header) + header.bytes;
  }
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(begin));
}

void Assembler::handle(const FrameHeader& header, std::span<const std::byte> payload) {
  if (header.kind == FrameKind::vertices) return take_vertices(payload);
  if (header.kind == FrameKind::triangles) return take_triangles(payload);
  PayloadReader fields(payload);
  ImportReport& report = scene_.report;
  switch (header.kind) {
    case FrameKind::hello:
      if (fields.take<std::uint32_t>() != stream_version) throw StreamDamaged{"another version of the stream"};
      break;
    case FrameKind::progress:
      bytes_read_ = fields.take<std::uint64_t>();
      break;
    case FrameKind::georeference: {
      Georeference georeference;
      georeference.origin = fields.take<Vec3>();
      georeference.srs = fields.take_text();
      if (!report.georeference) report.georeference = std::move(georeference);
      break;
    }
    case FrameKind::object:
      finish_mesh();
      in_mesh_ = true;
      name_ = fields.take_text();
      count_bytes(sizeof(Mesh) + name_.size());
      break;
    case FrameKind::left_out:
      take_left_out(fields);
      break;
    case FrameKind::missing_page: {
      std::string file = fields.take_text();
      auto& files = report.missing_page_files;
      if (files.size() < ImportReport::name_limit) files.push_back(std::move(file));
      break;
    }
    case FrameKind::note: {
      std::string sentence = fields.take_text();
      if (report.notes.size() < note_limit) report.notes.push_back(std::move(sentence));
      break;
    }
    case FrameKind::failure: {
      Failure failure{fields.take_text()};
      if (!fields.complete()) break;
      throw failure;
    }
    case FrameKind::end:
      take_end(fields);
      break;
    default:
      throw StreamDamaged{"a frame of unknown kind"};
  }
  if (!fields.complete()) throw StreamDamaged{"a frame of broken length"};
}

void Assembler::count_bytes(std::size_t bytes) {
  if (bytes > mesh_bytes_left_) throw MeshesTooLarge{};
  mesh_bytes_left_ -= bytes;
}

void Assembler::take_vertices(std::span<const std::byte> payload) {
  if (!in_mesh_) throw StreamDamaged{"vertices of no object"};
  count_bytes(payload.size());
  auto vertices = copied<Vec3>(payload);
  for (const Vec3& v : vertices) {
    for (int k = 0; k < 3; ++k) {
      // False for a NaN too.
      if (!(std::abs(v[k]) <= World::coordinate_limit)) throw StreamDamaged{"a vertex that is not finite"};
    }
  }
  vertices_ += vertices.size();
  mesh_vertices_ += vertices.size();
  if (mesh_vertices_ > std::numeric_limits<std::uint32_t>::max()) throw StreamDamaged{"a mesh of 2^32 vertices"};
  vertex_pieces_.push_back(std::move(vertices));
}

void Assembler::take_triangles(std::span<const std::byte> payload) {
  if (!in_mesh_) throw StreamDamaged{"triangles of no object"};
  count_bytes(payload.size());
  auto triangles = copied<Corners>(payload);
  for (const Corners& corners : triangles) {
    for (const std::uint32_t corner : corners) {
      if (corner >= mesh_vertices_) throw StreamDamaged{"a triangle without its vertices"};
    }
  }
  triangles_ += triangles.size();
  triangle_pieces_.push_back(std::move(triangles));
}

void Assembler::take_left_out(PayloadReader& fields) {
  const auto reason = fields.take<LeftOutReason>();
  LeftOutObject object;
  object.name = fields.take_text();
  object.vertices = fields.take<std::uint64_t>();
  object.triangles = fields.take<std::uint64_t>();
  const bool bad = reason == LeftOutReason::bad_vertices;
  note_object(bad ? scene_.report.bad_objects : scene_.report.ignored_objects, std::move(object));
}

void Assembler::take_end(PayloadReader& fields) {
  finish_mesh();
  const auto totals = fields.take<Totals>();
  if (fields.take<std::uint32_t>() != ignore_patterns_) throw StreamDamaged{"totals of other patterns"};
  for (std::size_t i = 0; i < ignore_patterns_; ++i) matched_.push_back(fields.take<std::uint8_t>() != 0);
  if (totals.vertices != vertices_ || totals.triangles != triangles_) {
    throw StreamDamaged{"totals that are not those of its meshes"};
  }
  ImportReport& report = scene_.report;
  report.files += totals.files;
  report.bad_vertices += totals.bad_vertices;
  report.bad_triangles += totals.bad_triangles;
  report.ignored_triangles += totals.ignored_triangles;
  report.missing_pages += totals.missing_pages;
  ended_ = true;
}

void Assembler::finish_mesh() {
  Mesh mesh;
  mesh.name = std::exchange(name_, {});
  mesh.vertices = joined(vertex_pieces_);
  mesh.triangles = joined(triangle_pieces_);
  mesh_vertices_ = 0;
  in_mesh_ = false;
  if (mesh.triangles.empty()) return;
  scene_.report.vertices += mesh.vertices.size();
  scene_.report.triangles += mesh.triangles.size();
  scene_.meshes.push_back(std::move(mesh));
}

}  // namespace roam::reader
