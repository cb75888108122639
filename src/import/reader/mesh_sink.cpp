#include "import/reader/mesh_sink.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/finite.h"
#include "roam/mesh.h"
#include "roam/scene_frame.h"

namespace roam::reader {
namespace {

/// Frames of 1.5 MB: small compared with a scene, large compared with the cost of a frame.
constexpr std::size_t vertices_per_frame = 1u << 16;
constexpr std::size_t triangles_per_frame = 1u << 17;
static_assert(vertices_per_frame * sizeof(Vec3) <= payload_limit);
static_assert(triangles_per_frame * 3 * sizeof(std::uint32_t) <= payload_limit);

constexpr auto progress_interval = std::chrono::milliseconds(100);
/// Most different sentences that report_note_once remembers.
constexpr std::size_t said_limit = 100;

bool same_unit(double stated, double metres) {
  // Files round the unit that they state: in some, an inch is 0.02539999969 m.
  constexpr double stated_rounding = 1e-6;
  return std::abs(stated - metres) <= stated_rounding * metres;
}

/// The unit of this length, if the command line has it.
std::optional<LengthUnit> unit_of(double metres) {
  for (const char* const name : length_unit_names) {
    const LengthUnit unit = parse_length_unit(name);
    if (same_unit(metres, metres_per(unit))) return unit;
  }
  return std::nullopt;
}

/// The names of an object and its ancestors in one text; `name` if all are empty. A node and its only mesh often have
/// the same name, which is one.
std::string path_of(std::span<const std::string> names, const std::string& name) {
  std::string path;
  std::string_view last;
  for (const std::string& part : names) {
    if (part.empty() || part == last) continue;
    if (!path.empty()) path += DisplayPart::name_separator;
    path += last = part;
  }
  return path.empty() ? name : path;
}

}  // namespace

MeshSink::MeshSink(FrameWriter& frames, const ReadingSettings& settings, PartPool* parts, PieceCutter* pieces)
    : frames_(frames),
      settings_(settings),
      parts_(parts),
      pieces_(pieces),
      up_(settings.up.value_or(UpAxis::z)),
      matched_(settings.ignore.size(), 0) {}

void MeshSink::set_format_up(UpAxis up) { up_ = settings_.up.value_or(up); }

void MeshSink::compare_with_stated(std::optional<UpAxis> up, std::optional<double> metres_per_unit,
                                   std::string_view file) {
  if (up && !settings_.up && *up != up_) {
    const char* axis = to_string(*up);
    report_note(
        fmt::format("{}: the file states that its {} axis is up; its coordinates are left as they are, z up. If "
                    "the file is right, read it with up = {} (--up={}).",
                    file, axis, axis, axis));
  }
  const double read_as = settings_.metres_per_unit;
  if (metres_per_unit && !same_unit(*metres_per_unit, read_as)) {
    const std::optional<LengthUnit> unit = unit_of(*metres_per_unit);
    if (unit) frames_.send(FrameKind::unit, PayloadWriter().add(*unit));
    report_note(
        fmt::format("{}: the file states that its unit is {:.6g} m; it is read as {:.6g} m. If the file is right, {}.",
                    file, *metres_per_unit, read_as,
                    unit ? fmt::format("read it with its unit (--unit {})", to_string(*unit))
                         : "scale it to metres first: none of m, cm, mm, ft and in is its unit"));
  }
}

Vec3 MeshSink::turned(const Vec3& v) const {
  // 0 - x instead of -x: no negative zeros.
  switch (up_) {
    case UpAxis::x:
      return {0.0 - v.z, v.y, v.x};
    case UpAxis::y:
      return {v.x, 0.0 - v.z, v.y};
    case UpAxis::z:
      return v;
    case UpAxis::minus_x:
      return {v.z, v.y, 0.0 - v.x};
    case UpAxis::minus_y:
      return {v.x, v.z, 0.0 - v.y};
    case UpAxis::minus_z:
      return {v.x, 0.0 - v.y, 0.0 - v.z};
  }
  return v;
}

Vec3 MeshSink::placed(const Vec3& vertex) const { return turned((vertex + offset_) * settings_.metres_per_unit); }

std::array<Vec3, 4> MeshSink::placement() const {
  const double unit = settings_.metres_per_unit;
  return {placed(Vec3(0.0)), turned({unit, 0, 0}), turned({0, unit, 0}), turned({0, 0, unit})};
}

bool MeshSink::matches_ignore(std::span<const std::string> names) {
  bool any = false;
  for (std::size_t i = 0; i < settings_.ignore.size(); ++i) {
    for (const std::string& name : names) {
      if (!name.empty() && fnmatch(settings_.ignore[i].c_str(), name.c_str(), 0) == 0) {
        matched_[i] = 1;
        any = true;
        break;
      }
    }
  }
  return any;
}

bool MeshSink::begin_object(std::span<const std::string> names, std::string_view fallback) {
  std::string_view name = fallback;
  for (const std::string& candidate : names) name = candidate.empty() ? name : std::string_view(candidate);
  if (begun_ && name == name_ && std::equal(names.begin(), names.end(), names_.begin(), names_.end())) return false;
  finish_object();
  name_ = name;
  names_.assign(names.begin(), names.end());
  const bool unnamed = std::all_of(names.begin(), names.end(), [](const std::string& n) { return n.empty(); });
  ignored_ = matches_ignore(unnamed ? std::span<const std::string>(&name_, 1) : names);
  begun_ = true;
  ++object_number_;
  if (pieces_ != nullptr) pieces_->begin_object(name_);
  if (parts_ != nullptr) parts_->begin_object(path_of(names_, name_));
  return true;
}

void MeshSink::set_look(const Look& wanted) {
  if (parts_ == nullptr) return;
  Look look = wanted;
  // Without an image there is nothing to cut. Looks are sorted, so none may have a NaN.
  if (look.texture == no_texture && look.transparency != Transparency::blend) {
    look.transparency = Look{}.transparency;
    look.cutoff = Look{}.cutoff;
  }
  if (!(look.cutoff >= 0.0f && look.cutoff <= 1.0f)) look.cutoff = Look{}.cutoff;
  if (look == look_) return;
  if (!triangles_.empty()) send_triangles();
  look_ = look;
}

void MeshSink::set_group(std::uint32_t group) {
  if (!triangles_.empty()) send_triangles();
  parts_->set_group(group);
}

/// Gives the vertex the next index. False if the vertex is not kept, because it is bad or in an ignored object.
bool MeshSink::count_vertex(const Vec3& vertex, Vec3& place) {
  if (vertex_count_ == std::numeric_limits<std::uint32_t>::max()) {
    throw Error(fmt::format("object '{}' has more than 2^32 vertices; split it.", name_));
  }
  const std::uint32_t index = vertex_count_++;
  if (ignored_ && !vertices_are_shared_) return false;
  place = placed(vertex);
  if (is_within_limit(place)) return true;
  bad_.push_back(index);
  return false;
}

std::uint32_t MeshSink::add_vertex(const Vec3& vertex, const VertexLook& look) {
  const std::uint32_t index = vertex_count_;
  Vec3 v;
  if (!count_vertex(vertex, v)) return index;
  if (pieces_ != nullptr) {
    pieces_->vertices().add(v);
    return index;
  }
  vertices_.push_back(v);
  if (parts_ != nullptr) {
    looks_.push_back(look);
    looks_.back().normal = glm::vec3(turned(Vec3(look.normal)));
  } else if (vertices_.size() == vertices_per_frame) {
    send_vertices();
  }
  return index;
}

std::uint32_t MeshSink::add_shared_vertex(const Vec3& vertex, const VertexLook& look) {
  return recent_.index({vertex, parts_ != nullptr ? look : VertexLook{}, object_number_},
                       [&] { return add_vertex(vertex, look); });
}

std::uint32_t MeshSink::use_vertex(std::uint32_t index) {
  if (!ignored_ && is_bad(index)) bad_used_.insert(index);
  return index;
}

bool MeshSink::is_bad(std::uint32_t index) const {
  return !bad_.empty() && std::binary_search(bad_.begin(), bad_.end(), index);
}

void MeshSink::add_polygon(std::span<const Vec3> corners) {
  corners_.clear();
  if (pieces_ == nullptr) {
    for (const Vec3& corner : corners) corners_.push_back(add_shared_vertex(corner));
    for (std::size_t i = 2; i < corners_.size(); ++i) add_triangle(corners_[0], corners_[i - 1], corners_[i]);
    return;
  }
  // The corners are available here, so no vertex is stored.
  for (const Vec3& corner : corners) {
    corners_.push_back(recent_.index({corner, {}, object_number_}, [&] {
      Vec3 place;
      const std::uint32_t index = vertex_count_;
      count_vertex(corner, place);
      return index;
    }));
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const std::array<std::size_t, 3> fan{0, i - 1, i};
    if (ignored_) {
      ++ignored_triangles_;
    } else if (is_bad(corners_[0]) || is_bad(corners_[i - 1]) || is_bad(corners_[i])) {
      ++bad_triangles_;
    } else {
      pieces_->add_triangle({corners_[0], corners_[i - 1], corners_[i]},
                            [&](std::size_t k) { return placed(corners[fan[k]]); });
    }
  }
}

void MeshSink::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (ignored_) {
    ++ignored_triangles_;
    return;
  }
  std::array<std::uint32_t, 3> corners{a, b, c};
  for (std::uint32_t& corner : corners) {
    if (corner >= vertex_count_) {
      ++bad_triangles_;
      return;
    }
    if (bad_.empty()) continue;
    const auto at = std::lower_bound(bad_.begin(), bad_.end(), corner);
    if (at != bad_.end() && *at == corner) {
      ++bad_triangles_;
      return;
    }
    corner -= static_cast<std::uint32_t>(at - bad_.begin());
  }
  if (pieces_ != nullptr) {
    PagedVertices& vertices = pieces_->vertices();
    return pieces_->add_triangle(corners, [&](std::size_t k) { return vertices[corners[k]]; });
  }
  triangles_.push_back(corners);
  if (triangles_.size() == triangles_per_frame) {
    send_vertices();
    send_triangles();
  }
}

void MeshSink::send_vertices() {
  // Parts contain vertices and triangles together.
  if (vertices_.empty() || parts_ != nullptr) return;
  if (!announced_) {
    frames_.send(FrameKind::object, PayloadWriter().add_text(name_).add(std::uint8_t{0}));
    announced_ = true;
  }
  totals_.vertices += vertices_.size();
  frames_.send(FrameKind::vertices, std::as_bytes(std::span(vertices_)));
  vertices_.clear();
}

void MeshSink::send_triangles() {
  totals_.triangles += triangles_.size();
  if (parts_ != nullptr) {
    parts_->add(vertices_, looks_, triangles_, look_);
  } else {
    frames_.send(FrameKind::triangles, std::as_bytes(std::span(triangles_)));
  }
  triangles_.clear();
}

void MeshSink::send_left_out(LeftOutReason reason, std::uint64_t vertices, std::uint64_t triangles) {
  frames_.send(FrameKind::left_out, PayloadWriter().add(reason).add_text(name_).add(vertices).add(triangles));
}

void MeshSink::finish_object() {
  // Vertices that no triangle used are dropped, unless they have been sent.
  if (!triangles_.empty()) {
    send_vertices();
    send_triangles();
  }
  if (pieces_ != nullptr) pieces_->finish_object();
  const std::uint64_t bad_vertices = vertices_are_shared_ ? bad_used_.size() : bad_.size();
  if (bad_vertices > 0 || bad_triangles_ > 0) send_left_out(LeftOutReason::bad_vertices, bad_vertices, bad_triangles_);
  if (ignored_triangles_ > 0) send_left_out(LeftOutReason::ignored, 0, ignored_triangles_);
  totals_.bad_vertices += bad_vertices;
  totals_.bad_triangles += bad_triangles_;
  totals_.ignored_triangles += ignored_triangles_;
  bad_triangles_ = ignored_triangles_ = 0;
  announced_ = ignored_ = begun_ = false;
  bad_used_.clear();
  if (vertices_are_shared_) return;
  bad_.clear();
  vertices_.clear();
  looks_.clear();
  vertex_count_ = 0;
  if (pieces_ != nullptr) pieces_->vertices().clear();
}

void MeshSink::report_missing_page(std::string_view file) {
  ++totals_.missing_pages;
  if (totals_.missing_pages <= ImportReport::name_limit) {
    frames_.send(FrameKind::missing_page, PayloadWriter().add_text(file));
  }
}

void MeshSink::report_note(std::string_view sentence) {
  frames_.send(FrameKind::note, PayloadWriter().add_text(sentence));
}

void MeshSink::report_note_once(std::string_view sentence) {
  if (said_.size() < said_limit && said_.emplace(sentence).second) report_note(sentence);
}

void MeshSink::report_georeference(const Georeference& georeference) {
  frames_.send(FrameKind::georeference, PayloadWriter().add(georeference.origin).add_text(georeference.srs));
}

void MeshSink::report_progress(std::uint64_t bytes_read) {
  bytes_read_ = bytes_read;
  const auto now = std::chrono::steady_clock::now();
  if (now - progress_sent_ < progress_interval) return;
  progress_sent_ = now;
  frames_.send(FrameKind::progress, PayloadWriter().add(bytes_read_));
  frames_.flush();
}

void MeshSink::say_what_was_rounded() {
  const double largest = largest_rounded_ * settings_.metres_per_unit;
  if (!(largest <= coordinate_limit)) return;
  // Neighbouring floats at x are up to x * 2^-23 apart. A spacing of a millimetre deserves a note.
  const double spacing = std::ldexp(largest, -std::numeric_limits<float>::digits + 1);
  constexpr double worth_telling = 1e-3;
  if (spacing < worth_telling) return;
  report_note(
      fmt::format("Coordinates of up to {:.0f} m came through a reader that keeps floats: they are rounded by up "
                  "to {:.2g} m. OBJ, STL and PLY keep every digit; so does a scene that is stored near its own "
                  "origin.",
                  largest, spacing / 2.0));
}

void MeshSink::send_parts() {
  if (parts_ == nullptr) return;
  finish_object();
  parts_->finish_file();
}

void MeshSink::end() {
  finish_object();
  const bool is_page = parts_ != nullptr && parts_->page() != nullptr;
  if (parts_ != nullptr) {
    parts_->finish_file();
    parts_->end_page();
    totals_.textures = parts_->textures().read();
    totals_.missing_textures = parts_->textures().missing();
  }
  // Each page would say another number.
  if (!is_page) say_what_was_rounded();
  if (pieces_ != nullptr) {
    totals_.vertices = pieces_->vertices_sent();
    totals_.triangles = pieces_->triangles_sent();
  }
  PayloadWriter payload;
  payload.add(totals_).add(static_cast<std::uint32_t>(matched_.size()));
  for (const std::uint8_t matched : matched_) payload.add(matched);
  frames_.send(FrameKind::end, payload);
  frames_.flush();
}

}  // namespace roam::reader
