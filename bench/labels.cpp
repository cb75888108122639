#include "labels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>

#include "adversarial_queries.h"
#include "files/whole_file.h"
#include "oracle.h"
#include "roam/error.h"

namespace roam::bench {
namespace {

using oracle::Quad;
using Point = oracle::Point<Quad>;
static_assert(std::endian::native == std::endian::little, "the file holds the numbers of x86");
static_assert(std::size(adversarial::kinds) == kind_count);

constexpr int origin_count = static_cast<int>(std::size(adversarial::origins));
constexpr int generator_count = kind_count * 2 * origin_count;
/// Sweeps that each generator makes before they are written.
constexpr std::uint64_t at_a_time = 32;

/// Bytes of the file before its header's text.
constexpr std::size_t before_text = 10;

/// Metres. The least gap up to `time`; less than 0 if the body is not free until then.
Quad gap_until(const LabelledSweep& s, double time) {
  return oracle::least_distance<Quad>(s.body(), s.start(), s.way(), time, s.corners()) - Quad(s.radius);
}
bool is_free(const LabelledSweep& s, double time) { return gap_until(s, time) >= 0; }

/// The greatest double up to which the body is free. It is at time 0 and not at time 1; `guess` is any time.
double last_free_time(const LabelledSweep& s, double guess) {
  const auto at = [&](std::uint64_t bits) { return is_free(s, std::bit_cast<double>(bits)); };
  std::uint64_t free = 0, blocked = std::bit_cast<std::uint64_t>(1.0);
  std::uint64_t next = std::bit_cast<std::uint64_t>(std::clamp(guess, 0.0, 1.0));
  // Away from the guess in growing steps, then by halves.
  for (std::uint64_t step = 1; free < next && next < blocked; step *= 4) {
    if (at(next)) {
      free = next;
      next = std::min(blocked, next + step);
    } else {
      blocked = next;
      next -= std::min(next, step);
    }
  }
  while (blocked - free > 1) {
    const std::uint64_t middle = free + (blocked - free) / 2;
    (at(middle) ? free : blocked) = middle;
  }
  return std::bit_cast<double>(free);
}

/// The pair of points of axis and triangle that are closest so far.
struct Nearest {
  Quad squared{-1};
  Point point{};  ///< on the triangle

  void take(const Point& on_axis, const Point& on_triangle) {
    const Point x = on_axis - on_triangle;
    const Quad d = dot(x, x);
    if (squared >= 0 && d >= squared) return;
    squared = d;
    point = on_triangle;
  }
};

Point on_segment(const Point& p, const Point& a, const Point& b) {
  const Point e = b - a;
  const Quad ee = dot(e, e), s = ee > 0 ? dot(p - a, e) / ee : Quad(0);
  return a + (s < 0 ? Quad(0) : s > 1 ? Quad(1) : s) * e;
}

void take_face(const Point& p, const Point (&t)[3], Nearest& nearest) {
  const Point ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], n = cross(ab, ac);
  const Quad nn = dot(n, n);
  if (!(nn > 0)) return;
  const Quad v = dot(cross(ap, ac), n) / nn, w = dot(cross(ab, ap), n) / nn;
  if (v >= 0 && w >= 0 && v + w <= 1) nearest.take(p, t[0] + (v * ab + w * ac));
}

/// The point of the triangle closest to the axis at `time`.
Vec3 closest_point(const LabelledSweep& s, double time) {
  const Triangle corners = s.corners();
  const Point origin = oracle::widen<Quad>(corners[0]), up{0, 0, Quad(s.half_height)};
  const Point centre = oracle::widen<Quad>(s.start()) + Quad(time) * oracle::widen<Quad>(s.way()) - origin;
  const Point t[3] = {{}, oracle::widen<Quad>(corners[1]) - origin, oracle::widen<Quad>(corners[2]) - origin};
  const Point low = centre - up, high = centre + up;
  Nearest nearest;
  for (const Point& end : {low, high}) {
    take_face(end, t, nearest);
    for (int i = 0; i < 3; ++i) nearest.take(end, on_segment(end, t[i], t[(i + 1) % 3]));
  }
  for (int i = 0; i < 3; ++i) {
    nearest.take(on_segment(t[i], low, high), t[i]);
    const Point along = high - low, edge = t[(i + 1) % 3] - t[i], n = cross(along, edge);
    const Quad nn = dot(n, n);
    if (!(nn > 0)) continue;
    const Quad part = dot(cross(t[i] - low, edge), n) / nn;
    if (part < 0 || part > 1) continue;
    const Point inside = low + part * along;
    nearest.take(inside, on_segment(inside, t[i], t[(i + 1) % 3]));
  }
  const Point found = origin + nearest.point;
  return {double(found.x), double(found.y), double(found.z)};
}

/// Metres. Thinner bodies are passed over: whether they touch is decided by roundings of 113 bits.
constexpr double thinnest = 1e-15;

LabelledSweep next_of(adversarial::Generator& generator, int kind) {
  adversarial::Query q = generator.next();
  while (q.body.radius < thinnest) q = generator.next();
  LabelledSweep s;
  s.kind = kind;
  s.radius = q.body.radius;
  s.half_height = q.body.half_height;
  for (int k = 0; k < 3; ++k) {
    s.from[k] = q.from[k];
    s.motion[k] = q.motion[k];
    for (int c = 0; c < 3; ++c) s.triangle[c][k] = q.triangle[c][k];
  }
  return s;
}

}  // namespace

Triangle LabelledSweep::corners() const {
  Triangle t;
  for (int c = 0; c < 3; ++c) t[c] = {triangle[c][0], triangle[c][1], triangle[c][2]};
  return t;
}

std::string kind_name(int kind) { return adversarial::name(adversarial::kinds[kind]); }

void label(LabelledSweep& s) {
  const Quad gap = gap_until(s, 1.0);
  s.gap = double(gap);
  s.hit = gap < 0 ? 1 : 0;
  if (s.hit == 0) return;
  s.time = 0.0;
  if (!is_free(s, 0.0)) return;
  s.time = last_free_time(s, sweep(s.body(), s.start(), s.way(), s.corners()).time);
  const Vec3 point = closest_point(s, s.time);
  for (int k = 0; k < 3; ++k) s.point[k] = point[k];
}

void make_labelled(std::uint64_t count, std::uint64_t seed,
                   const std::function<void(std::span<const LabelledSweep>)>& take) {
  std::vector<adversarial::Generator> generators;
  for (int i = 0; i < generator_count; ++i) {
    generators.emplace_back(adversarial::kinds[i % kind_count], i / kind_count % 2 == 1,
                            adversarial::origins[i / (2 * kind_count)], seed * generator_count + std::uint64_t(i));
  }
  std::vector<LabelledSweep> made(generator_count * at_a_time);
  for (std::uint64_t done = 0; done < count; done += made.size()) {
    tbb::parallel_for(0, generator_count, [&](int i) {
      for (std::uint64_t n = 0; n < at_a_time; ++n) {
        LabelledSweep& s = made[n * generator_count + std::uint64_t(i)];
        s = next_of(generators[std::size_t(i)], i % kind_count);
        label(s);
      }
    });
    take({made.data(), std::min<std::uint64_t>(made.size(), count - done)});
  }
}

std::string numpy_header(std::uint64_t count) {
  std::string text =
      "{'descr': [('kind', '<i4'), ('hit', '<i4'), ('radius', '<f8'), ('half_height', '<f8'), "
      "('from', '<f8', (3,)), ('motion', '<f8', (3,)), ('triangle', '<f8', (3, 3)), ('time', '<f8'), "
      "('gap', '<f8'), ('point', '<f8', (3,))], 'fortran_order': False, 'shape': (" +
      std::to_string(count) + ",), }";
  constexpr std::size_t unit = 64;  // the records begin at a multiple of 64 bytes
  text.resize((before_text + text.size() + unit) / unit * unit - before_text - 1, ' ');
  text += '\n';
  const auto size = static_cast<std::uint16_t>(text.size());
  return std::string("\x93NUMPY\x01\x00", 8) + char(size & 0xff) + char(size >> 8) + text;
}

bool is_labelled(const std::filesystem::path& file) {
  std::string begin(512, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  const std::string header = numpy_header(1);
  const std::size_t same = header.find("fortran_order") - before_text;  // the rest depends on their number
  return begin.compare(before_text, same, header, before_text, same) == 0;
}

std::vector<LabelledSweep> read_labelled(const std::filesystem::path& file) {
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 34;
  const std::string bytes = files::read_named(file, most_bytes);
  const std::size_t header =
      bytes.size() < before_text ? before_text : before_text + std::uint8_t(bytes[8]) + 256U * std::uint8_t(bytes[9]);
  const std::uint64_t count = bytes.size() > header ? (bytes.size() - header) / sizeof(LabelledSweep) : 0;
  if (count == 0 || bytes.size() != header + count * sizeof(LabelledSweep) || !bytes.starts_with(numpy_header(count))) {
    throw Error(file.string() +
                " is not a file of labelled sweeps, or not a whole one; make one with `roam bench "
                "labels sweeps.npy`");
  }
  std::vector<LabelledSweep> sweeps(count);
  std::memcpy(sweeps.data(), bytes.data() + header, count * sizeof(LabelledSweep));
  for (const LabelledSweep& s : sweeps) {
    if (s.kind < 0 || s.kind >= kind_count) throw Error(file.string() + " is damaged: it has an unknown kind of sweep");
  }
  return sweeps;
}

void judge(const LabelledSweep& s, double answer, LabelScore& score) {
  ++score.sweeps;
  score.hits += s.hit == 1 ? 1 : 0;
  const bool answered_hit = answer < 1.0;
  double depth = -s.gap;
  if (answered_hit && answer > s.time) {
    depth = s.radius - double(oracle::least_distance(s.body(), s.start(), s.way(), answer, s.corners()));
  } else if (answered_hit) {
    depth = 0.0;  // the label is exact
    const double time = std::max(0.0, answer);
    const double off = double(oracle::distance_on_the_way(s.body(), s.start(), s.way(), time, s.corners())) - s.radius;
    score.farthest = std::max(score.farthest, off);
    score.early += off > far_off ? 1 : 0;
  }
  score.deepest = std::max(score.deepest, depth);
  if (depth > tolerated) ++(answered_hit ? score.late : score.missed);
}

}  // namespace roam::bench
