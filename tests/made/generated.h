#pragma once
/// \file
/// Generated cases that shrink, for properties (RapidCheck): numbers to few binary digits, scenes to few triangles.
///
///     TEST(SweepProperties, OrderOfCornersDoesNotMatter) {
///       generated::check(1000, [](const generated::OneTriangle& c) { RC_ASSERT(...); });
///     }
///
/// RC_PARAMS="seed=7 max_success=100000" asks for other and more cases. A failure prints the case and its RC_PARAMS.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/detail/TestListenerAdapter.h>

#include <cmath>
#include <cstdlib>
#include <ostream>
#include <string>
#include <vector>

#include "roam/mesh.h"
#include "roam/sweep.h"
#include "roam/walker_settings.h"
#include "test_seed.h"
#include "text/number.h"

namespace generated {

using rc::Gen;
using rc::gen::apply;
using rc::gen::element;
using rc::gen::map;
using roam::Body;
using roam::Triangle;
using roam::Vec3;

/// Metres. Numbers are multiples of it, so that sums and halves are exact, also far from the origin.
constexpr double grid = 0x1p-20;

inline double rounded_down(double value, double step) { return std::trunc(value / step) * step; }

/// Simpler numbers than `value`: fewer digits first.
inline rc::Seq<double> simpler(double value) {
  std::vector<double> all{0.0};
  if (std::abs(value) >= 2.0) all.push_back(std::trunc(value / 2.0));
  if (std::abs(value) > 1.0) all.push_back(std::trunc(value - std::copysign(1.0, value)));
  for (const double step : {1.0, 0x1p-1, 0x1p-2, 0x1p-4, 0x1p-8, 0x1p-12}) all.push_back(rounded_down(value, step));
  if (value < 0.0) all.push_back(-value);
  std::erase(all, value);
  return rc::seq::fromContainer(all);
}

/// A number in [least, most]; if `least` is above 0, it shrinks towards `least`. One in three is a multiple of 1/4 and
/// one of 1/64, so that things touch, are parallel or are the same.
inline Gen<double> number(double least, double most) {
  const double base = std::max(least, 0.0);
  return [=](const rc::Random& random, int) {
    rc::Random bits = random;
    const double unit = static_cast<double>(bits.next() >> 11) * 0x1p-53;
    constexpr double steps[] = {grid, 0x1p-6, 0x1p-2};
    const double step = steps[bits.next() % 3];
    const double value = rounded_down(least + unit * (most - least) - base, std::min(step, (most - least) / 4.0));
    return rc::shrinkable::map(rc::shrinkable::shrinkRecur(value, &simpler), [base](double v) { return base + v; });
  };
}

inline Gen<Vec3> point(double most) {
  return apply([](double x, double y, double z) { return Vec3(x, y, z); }, number(-most, most), number(-most, most),
               number(-most, most));
}

/// A ray, a sphere or a capsule.
inline Gen<Body> body() {
  return apply(
      [](double radius, double half_height) {
        return Body{radius, half_height};
      },
      rc::gen::weightedOneOf<double>({{1, rc::gen::just(0.0)}, {6, number(0.0, 0.6)}}),
      rc::gen::weightedOneOf<double>({{1, rc::gen::just(0.0)}, {1, number(0.0, 1.1)}}));
}

/// Where a scene is: at the origin, in the paper's gallery, or up to 6,400 km away.
inline Gen<Vec3> place() {
  return rc::gen::sizedElement(Vec3(0.0), Vec3(-13739.0, 253.0, 182.0), Vec3(1e5, 1e5, -1e5),
                               Vec3(6.4e6, -6.4e6, 6.4e6));
}

enum class Shape : std::uint8_t { usual, needle, in_a_row, segment, dot };

/// Corners within `most` of the middle. Two in five triangles are thin or have no area.
inline Gen<Triangle> triangle(double most) {
  using enum Shape;
  const auto shape = rc::gen::sizedElement(usual, usual, usual, needle, in_a_row, segment, usual, dot);
  return apply(
      [](const Vec3& a, const Vec3& b, const Vec3& c, Shape s) {
        switch (s) {
          case needle:
            return Triangle{a, b, b + Vec3(rounded_down(0x1p-16 * c.x, grid), rounded_down(0x1p-16 * c.y, grid), 0.0)};
          case in_a_row:
            return Triangle{a, b, 0.5 * (a + b)};
          case segment:
            return Triangle{a, b, b};
          case dot:
            return Triangle{a, a, a};
          default:
            return Triangle{a, b, c};
        }
      },
      point(most), point(most), point(most), shape);
}

struct Motion {
  Body body;
  Vec3 from{0.0};
  Vec3 motion{0.0};
};

/// A motion through a place: all of it, or a short part of its beginning.
inline Gen<double> part() { return rc::gen::weightedElement<double>({{5, 1.0}, {1, 0x1p-6}, {1, 0x1p-12}, {1, 0.0}}); }

/// From a place within `most` of the middle through one within half of that, and as far beyond.
inline Gen<Motion> motion(double most) {
  return apply(
      [](const Body& b, const Vec3& from, const Vec3& by, double some) {
        return Motion{b, from, 2.0 * some * (by - from)};
      },
      body(), point(most), point(0.5 * most), part());
}

struct OneTriangle : Motion {
  Triangle triangle{};
};

struct Scene {
  std::vector<Triangle> triangles;
  Vec3 place{0.0};  ///< of the scene's middle
  bool lossless = false;

  [[nodiscard]] roam::Mesh mesh() const {
    roam::Mesh m;
    for (const Triangle& t : triangles) {
      const auto first = static_cast<std::uint32_t>(m.vertices.size());
      for (const Vec3& corner : t) m.vertices.push_back(place + corner);
      m.triangles.push_back({first, first + 1, first + 2});
    }
    return m;
  }
};

/// At most `count` triangles.
inline Gen<Scene> scene(double most, int count) {
  return apply(
      [](const std::vector<Triangle>& triangles, const Vec3& place, bool lossless) {
        return Scene{triangles, place, lossless};
      },
      rc::gen::scale(count / 100.0,
                     rc::gen::container<std::vector<Triangle>>(rc::gen::scale(100.0 / count, triangle(most)))),
      place(), rc::gen::arbitrary<bool>());
}

inline std::string text(const Vec3& v) {
  return "{" + roam::number_text(v.x) + ", " + roam::number_text(v.y) + ", " + roam::number_text(v.z) + "}";
}
inline std::string text(const Triangle& t) { return "{" + text(t[0]) + ", " + text(t[1]) + ", " + text(t[2]) + "}"; }
inline std::ostream& operator<<(std::ostream& out, const Motion& m) {
  return out << "body {" << roam::number_text(m.body.radius) << ", " << roam::number_text(m.body.half_height)
             << "} from " << text(m.from) << " by " << text(m.motion);
}
inline std::ostream& operator<<(std::ostream& out, const OneTriangle& c) {
  return out << static_cast<const Motion&>(c) << " before " << text(c.triangle);
}
inline std::ostream& operator<<(std::ostream& out, const Scene& s) {
  out << (s.lossless ? "lossless, " : "") << "at " << text(s.place);
  for (const Triangle& t : s.triangles) out << "\n  " << text(t);
  return out;
}

/// Checks a property with `cases` cases, the same in each run. Returns how many hold.
template <class Property>
int check(int cases, const Property& property) {
  rc::detail::Configuration usual;
  usual.testParams.seed = test_seed(1);
  usual.testParams.maxSuccess = cases;
  const char* said = std::getenv("RC_PARAMS");
  const rc::detail::Configuration wanted = rc::detail::configFromString(said == nullptr ? "" : said, usual);
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  rc::detail::TestMetadata names;
  names.id = std::string(test->test_suite_name()) + "." + test->name();
  names.description = test->name();
  rc::detail::TestListenerAdapter silent;
  const auto result = rc::detail::checkTestable(property, names, wanted.testParams, silent, wanted.reproduce);
  std::ostringstream words;
  rc::detail::printResultMessage(result, words);
  if (!result.template is<rc::detail::SuccessResult>()) {
    ADD_FAILURE() << words.str();
    return 0;
  }
  std::cout << words.str() << '\n';
  return result.template get<rc::detail::SuccessResult>().numSuccess;
}

}  // namespace generated

namespace rc {

template <>
struct Arbitrary<generated::OneTriangle> {
  static Gen<generated::OneTriangle> arbitrary() {
    return gen::apply(
        [](const roam::Body& body, const roam::Triangle& t, const roam::Vec3& past, const roam::Vec3& from, double near,
           double part) {
          const roam::Vec3 by = 0.5 * (t[0] + t[1]) + past;
          return generated::OneTriangle{{body, by + near * from, -2.0 * part * near * from}, t};
        },
        generated::body(), generated::triangle(2.0), generated::point(0.5), generated::point(3.0),
        gen::element(1.0, 1.0, 1.0, 0x1p-3), generated::part());
  }
};

}  // namespace rc
