// A million hard sweeps against brute force in quad precision: none missed, none late, none early by more than the
// documented resolution, every certificate true.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "adversarial_queries.h"
#include "hit_resolution.h"
#include "oracle.h"
#include "roam/sweep.h"
#include "sweep/certified.h"
#include "test_seed.h"

namespace {

using adversarial::Kind;
using adversarial::Query;
using oracle::Quad;

/// Two bodies, nine kinds, four origins: 1,008,000 in all.
constexpr int queries_per_origin = 14000;

std::string text(const Query& q) {
  std::ostringstream s;
  const auto put = [&](const roam::Vec3& v) { s << "{" << v.x << ", " << v.y << ", " << v.z << "} "; };
  s << std::setprecision(17) << "radius " << q.body.radius << " half height " << q.body.half_height << " from ";
  put(q.from);
  s << "motion ";
  put(q.motion);
  s << "triangle ";
  for (const auto& corner : q.triangle) put(corner);
  return s.str();
}

roam::certified::LocalTriangle local(const Query& q) {
  return {{q.triangle[0] - q.from, q.triangle[1] - q.from, q.triangle[2] - q.from}, 0.0};
}

/// What the normal alone proves about the gap at that time: the bound that anybody can check.
Quad proven_gap(const Query& q, const roam::Vec3& normal, double time) {
  const auto n = oracle::widen<Quad>(normal);
  Quad least = 0;
  for (int i = 0; i < 3; ++i) {
    const auto x =
        oracle::widen<Quad>(q.from) + Quad(time) * oracle::widen<Quad>(q.motion) - oracle::widen<Quad>(q.triangle[i]);
    const Quad d = dot(n, x);
    if (i == 0 || d < least) least = d;
  }
  const Quad span = Quad(q.body.half_height) * (n.z < 0 ? -n.z : n.z);
  return (least - span) / oracle::root(dot(n, n)) - Quad(q.body.radius);
}

struct Verdict {
  int hits = 0, misses = 0, embedded = 0;
  int missed = 0;       ///< said free, met the triangle
  int late = 0;         ///< the body was inside before the time that was answered
  int early = 0;        ///< stopped farther away than the resolution
  int unproven = 0;     ///< the distance is more than the truth, or more than the normal proves
  int loose = 0;        ///< the distance of a miss is less than the truth by more than its tolerance
  int ill_touched = 0;  ///< point not on the triangle, or not where the body is
  std::string first_bad;

  void count(int& counter, const Query& q) {
    ++counter;
    if (first_bad.empty()) first_bad = text(q);
  }
};

void judge_miss(const Query& q, const roam::SweepResult& s, double resolution, Verdict& v) {
  ++v.misses;
  const Quad gap = oracle::least_distance<Quad>(q.body, q.from, q.motion, 1.0, q.triangle) - Quad(q.body.radius);
  if (gap < 0) v.count(v.missed, q);
  if (s.time != 1.0 || !(s.distance >= 0.0) || Quad(s.distance) > gap) v.count(v.unproven, q);
  const double tolerance = 1e-9 * (static_cast<double>(gap) + q.body.radius) + resolution;
  if (Quad(s.distance) < gap - Quad(tolerance)) v.count(v.loose, q);
}

void judge_hit(Kind kind, const Query& q, const roam::SweepResult& s, double resolution, Verdict& v) {
  ++v.hits;
  const Quad distance = oracle::distance_on_the_way<Quad>(q.body, q.from, q.motion, s.time, q.triangle);
  const Quad gap = distance - Quad(q.body.radius);
  if (gap > Quad(resolution)) v.count(v.early, q);
  if (s.time > 0.0 || s.distance >= 0.0) {
    const Quad least = oracle::least_distance<Quad>(q.body, q.from, q.motion, s.time, q.triangle);
    if (least < Quad(q.body.radius)) v.count(v.late, q);
    if (!(s.distance >= 0.0) || Quad(s.distance) > gap) v.count(v.unproven, q);
  } else {
    ++v.embedded;
  }
  if (s.distance != 0.0 && Quad(s.distance) > proven_gap(q, s.normal, s.time)) v.count(v.unproven, q);
  // The point is told in the scene's frame, whose last digit may be coarser than the answer.
  const double digit = 0x1p-52 * std::max({std::abs(s.point.x), std::abs(s.point.y), std::abs(s.point.z)});
  const Quad off = oracle::distance<Quad>({}, s.point, q.triangle);
  if (off > Quad(2.0 * digit + resolution)) v.count(v.ill_touched, q);
  if (s.distance >= 0.0) {
    // The point of a sliver may be so far beside the place where the body touches (sweep.h).
    const auto& [a, b, c] = q.triangle;
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    const bool is_sliver = kind == Kind::sliver || glm::length(glm::cross(b - a, c - a)) < 1.001e-4 * longest * longest;
    const double sliver = is_sliver ? 1e-5 * longest + 1e-9 * (q.body.radius + s.distance) : 0.0;
    const Quad apart = oracle::distance_on_the_way<Quad>(q.body, q.from, q.motion, s.time, {s.point, s.point, s.point});
    if (apart - Quad(q.body.radius) > Quad(2.0 * digit + resolution + sliver)) v.count(v.ill_touched, q);
  }
  if (std::abs(glm::dot(s.normal, s.normal) - 1.0) > 1e-15) v.count(v.ill_touched, q);
}

Verdict judge(Kind kind, bool capsule, const roam::Vec3& origin, std::uint64_t seed) {
  adversarial::Generator generator(kind, capsule, origin, test_seed(seed));
  Verdict v;
  for (int i = 0; i < queries_per_origin; ++i) {
    const Query q = generator.next();
    const roam::SweepResult s = roam::sweep(q.body, q.from, q.motion, q.triangle);
    const double resolution = roam::certified::hit_resolution(q.body, q.motion, local(q), 1.0);
    s.hit ? judge_hit(kind, q, s, resolution, v) : judge_miss(q, s, resolution, v);
  }
  return v;
}

struct Case {
  Kind kind;
  bool capsule;
};

std::string name(const Case& c) {
  return std::string(adversarial::name(c.kind)) + (c.capsule ? "_capsule" : "_sphere");
}

void PrintTo(const Case& c, std::ostream* out) { *out << name(c); }

std::vector<Case> every_case() {
  std::vector<Case> cases;
  for (const Kind kind : adversarial::kinds) {
    cases.push_back({kind, false});
    cases.push_back({kind, true});
  }
  return cases;
}

class EverySweep : public testing::TestWithParam<Case> {};

TEST_P(EverySweep, IsNeitherMissedNorLateNorEarly) {
  const auto [kind, capsule] = GetParam();
  int hits = 0, misses = 0;
  for (int o = 0; o < 4; ++o) {
    const Verdict v = judge(kind, capsule, adversarial::origins[o], 1000u * static_cast<unsigned>(kind) + o);
    SCOPED_TRACE("origin " + std::to_string(o) + ", first wrong: " + v.first_bad);
    EXPECT_EQ(v.missed, 0);
    EXPECT_EQ(v.late, 0);
    EXPECT_EQ(v.early, 0);
    EXPECT_EQ(v.unproven, 0);
    EXPECT_EQ(v.loose, 0);
    EXPECT_EQ(v.ill_touched, 0);
    hits += v.hits;
    misses += v.misses;
    if (kind == Kind::embedded) {
      EXPECT_GT(v.embedded, queries_per_origin / 2);
    }
  }
  EXPECT_GT(hits, queries_per_origin / 10);
  if (kind != Kind::embedded) {
    EXPECT_GT(misses, queries_per_origin / 10);
  }
  RecordProperty("hits", hits);
  RecordProperty("misses", misses);
}

INSTANTIATE_TEST_SUITE_P(Hard, EverySweep, testing::ValuesIn(every_case()),
                         [](const auto& test) { return name(test.param); });

}  // namespace
