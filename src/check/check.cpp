#include "check/check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <locale>
#include <sstream>

namespace roam::checking {
namespace {

/// FNV-1a of 64 bits.
std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return hash;
}

template <class... Number>
bool read(std::istream& in, Number&... numbers) {
  return ((in >> numbers && std::abs(numbers) <= 1e9) && ...);
}

/// `v` without its part along `edge`. The second time removes the rounding of a long `v`.
Vec3 square_to(const Vec3& edge, Vec3 v) {
  const double square = glm::dot(edge, edge);
  for (int i = 0; i < 2 && square > 0.0; ++i) v -= (glm::dot(v, edge) / square) * edge;
  return v;
}

}  // namespace

void SceneSum::add(const Triangle& triangle) {
  hash += hash_of({reinterpret_cast<const char*>(&triangle), 9 * sizeof(double)});
  ++triangles;
}

std::string checksum_line(std::string_view text) {
  char line[32];
  std::snprintf(line, sizeof line, "checksum %016llx\n", static_cast<unsigned long long>(hash_of(text)));
  return line;
}

Certificate read_certificate(std::string_view text) {
  Certificate all;
  std::uint64_t count = 0, number = 0;
  Vec3 place(0.0), end(0.0);
  Size size;
  const auto demand = [&](bool holds, const char* why) {
    if (!holds) throw Refused(why, number);
  };
  const std::string_view body = text.substr(0, text.rfind("checksum "));
  if (text.substr(body.size()) != checksum_line(body)) throw std::invalid_argument("its checksum is wrong");
  std::istringstream in{std::string(body)};
  in.imbue(std::locale::classic());
  in.exceptions(std::ios::badbit);  // else the text would just end where memory runs out
  std::string line, scene, way, word;
  if (!std::getline(in, line) || line != first_line) throw std::invalid_argument("it is no certificate of version 1");
  in >> scene >> all.scene.triangles >> std::hex >> all.scene.hash >> std::dec >> way >> count;
  const bool read_ends = read(in, place.x, place.y, place.z, end.x, end.y, end.z);
  demand(read_ends && scene == "scene" && way == "way" && count <= most_segments, "its head is wrong");
  for (in >> word; word == "size" && read(in, size.radius, size.half_height); in >> word) all.sizes.push_back(size);
  for (; word == "segment"; word.clear(), in >> word) {
    Segment s;
    in >> number;
    demand(
        read(in, s.from.x, s.from.y, s.from.z, s.to.x, s.to.y, s.to.z, s.size.radius, s.size.half_height, s.clearance),
        "it is not as the format says");
    demand(number == all.segments.size() + 1 && number <= count, "a segment before it is missing, or one is too many");
    demand(s.from == place, "it does not begin where the one before it ends, or the head of the file says");
    demand(all.sizes.size() <= 1000 && std::find(all.sizes.begin(), all.sizes.end(), s.size) != all.sizes.end(),
           "the head of the file does not name this size of the body");
    demand(number == 1 || s.size == all.segments.back().size || (s.from.x == s.to.x && s.from.y == s.to.y),
           "the body has another size than before, and moves sideways");
    demand(s.size.radius > 0.0 && s.size.half_height >= 0.0, "no body has such a size");
    demand(s.clearance >= s.size.radius - 1e-6 && s.clearance > 1e-6, "its clearance is below the radius");
    place = s.to;
    all.segments.push_back(s);
  }
  demand(in.eof() && count > 0 && number == count, "the head of the file says another number of segments");
  demand(place == end, "it does not end where the head of the file says");
  return all;
}

/// The moving axis sweeps a parallelogram P. For ANY direction n, P and the triangle T are at least (least n.p -
/// greatest n.t) / |n| apart, because two parallel planes lie between them. So a bad direction can only refuse what is
/// right; it cannot accept what is wrong. The best direction is one of these: between two corners, from a corner square
/// to an edge, square to two edges, square to a face. All are tried, faces first.
bool apart(const Segment& segment, const Triangle& triangle, double distance) {
  // Relative to the start, so that the distance to the scene's origin costs no digits.
  const Vec3 way = segment.to - segment.from, half(0.0, 0.0, segment.size.half_height);
  const std::array<Vec3, 4> p{-half, way - half, way + half, half};
  const Triangle t{triangle[0] - segment.from, triangle[1] - segment.from, triangle[2] - segment.from};
  double size = distance;
  for (const Vec3& q : {p[0], p[1], p[2], p[3], t[0], t[1], t[2]})
    size = std::max(size, std::abs(q.x) + std::abs(q.y) + std::abs(q.z));
  // In units of 2^-53 size |n|: 2 for a coordinate, 3 for its product with n, both twice; 2 for the difference of two
  // products, 4 for |n| and its product. 32 are charged.
  const double wanted = distance + 0x1p-48 * size;
  const auto along = [&](const Vec3& n) {
    const double length = std::sqrt(glm::dot(n, n));
    if (!(length > 1e-100)) return false;
    const auto [p_lo, p_hi] = std::minmax({glm::dot(n, p[0]), glm::dot(n, p[1]), glm::dot(n, p[2]), glm::dot(n, p[3])});
    const auto [t_lo, t_hi] = std::minmax({glm::dot(n, t[0]), glm::dot(n, t[1]), glm::dot(n, t[2])});
    return std::max(p_lo - t_hi, t_lo - p_hi) >= wanted * length;
  };
  // The normal of a narrow face is noise, unless it is made square to the longest edge.
  const auto across = [&](const Vec3& a, const Vec3& b) {
    return along(square_to(a, glm::cross(a, b))) || along(square_to(b, glm::cross(a, b)));
  };
  if (across(t[1] - t[0], t[2] - t[1]) || across(t[0] - t[2], t[1] - t[0]) || across(way, half)) return true;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 between = t[j] - p[i], edge = p[(i + 1) % 4] - p[i], other = t[(j + 1) % 3] - t[j];
      if (along(between) || along(square_to(edge, between)) || along(square_to(other, between))) return true;
      if (across(edge, other)) return true;
    }
  }
  return false;
}

Checker::Checker(const Certificate& certificate) : certificate_(certificate), refused_(certificate.segments.size()) {
  const std::size_t leaves = std::bit_ceil(refused_);
  tree_.resize(2 * leaves);
  for (std::size_t i = 0; i < refused_; ++i) {
    const Segment& s = certificate_.segments[i];
    tree_[leaves + i].include(s.from);
    tree_[leaves + i].include(s.to);
    // A triangle outside of this box is farther away than the clearance. 1e-6 m is more than all roundings below 1e9 m.
    tree_[leaves + i] = tree_[leaves + i].grown(Vec3(0.0, 0.0, s.size.half_height) + s.clearance + 1e-6);
  }
  for (std::size_t node = leaves - 1; node > 0; --node) {
    tree_[node].include(tree_[2 * node]);
    tree_[node].include(tree_[2 * node + 1]);
  }
}

void Checker::search(std::size_t node, const Triangle& triangle, const Box& box) {
  const int below = std::bit_width(tree_.size() / 2) - std::bit_width(node);
  if ((node << below) - tree_.size() / 2 >= refused_) return;  // the first wrong segment is named
  for (int k = 0; k < 3; ++k)
    if (box.upper[k] < tree_[node].lower[k] || box.lower[k] > tree_[node].upper[k]) return;
  if (node < tree_.size() / 2) {
    search(2 * node, triangle, box);
    return search(2 * node + 1, triangle, box);
  }
  const std::size_t number = node - tree_.size() / 2;
  const Segment& s = certificate_.segments[number];
  if (apart(s, triangle, s.clearance - 1e-9)) return;
  refused_ = number;
  refused_by_ = seen_.triangles;
}

void Checker::add(const Triangle& triangle) {
  Box box;
  for (const Vec3& corner : triangle) box.include(corner);
  search(1, triangle, box);
  seen_.add(triangle);
}

void Checker::finish() const {
  const bool other = seen_ != certificate_.scene, near = refused_ < certificate_.segments.size();
  std::string why = near ? "triangle " + std::to_string(refused_by_) + " of the scene is nearer than it says" : "";
  if (other) why += std::string(near ? "; " : "") + "the scene, or its frame, is not that of the certificate";
  if (near || other) throw Refused(why, near ? refused_ + 1 : 0);
}

}  // namespace roam::checking
