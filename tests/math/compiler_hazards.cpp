// What the compiler must leave alone for the proofs to hold. These fail when the flags of cmake/compiler.cmake are
// lost: g++ 12.2 at -O2 drops the rounding of double -> float -> double of 3-vectors (its SLP vectoriser), which is
// what moving a far origin does.

#include <gtest/gtest.h>

#include <glm/vec3.hpp>

#include "roam/math.h"

namespace {

#if defined(__GNUC__)
#define ROAM_NOT_INLINED __attribute__((noinline))
#else
#define ROAM_NOT_INLINED __declspec(noinline)
#endif

ROAM_NOT_INLINED roam::Vec3 rounded_to_float(const roam::Vec3& p) { return roam::Vec3(glm::vec3(p)); }

ROAM_NOT_INLINED roam::Vec3 lost_by_float_offset(const roam::Vec3& p, const roam::Vec3& origin) {
  const glm::vec3 offset(p - origin);
  return p - (origin + roam::Vec3(offset));
}

ROAM_NOT_INLINED double product_less(double a, double b, double product) { return a * b - product; }

/// A value that the compiler cannot foresee.
double hidden(double x) {
  volatile double v = x;
  return v;
}

/// One coordinate at a time, through memory, where no vectoriser looks.
double rounded_one(double x) {
  volatile float f = static_cast<float>(x);
  return f;
}

TEST(CompilerHazards, VectorsAreRoundedToFloatsWhenTheySayFloat) {
  const roam::Vec3 p(hidden(1.0 / 3.0), hidden(1.0 / 7.0), hidden(1.0 / 11.0));
  const roam::Vec3 rounded = rounded_to_float(p);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(rounded[k], rounded_one(p[k]));
}

TEST(CompilerHazards, FloatOffsetsFromAFarOriginLoseWhatFloatsLose) {
  const roam::Vec3 origin(hidden(-13739.0), hidden(253.0), hidden(182.0));
  const roam::Vec3 p = origin + roam::Vec3(100.1, 50.2, -3.3);
  const roam::Vec3 lost = lost_by_float_offset(p, origin);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(lost[k], p[k] - (origin[k] + rounded_one(p[k] - origin[k])));
    EXPECT_NE(lost[k], 0.0);
  }
}

TEST(CompilerHazards, ProductsAreRoundedBeforeTheyAreSubtracted) {
  const double a = hidden(1.0 + 0x1p-30), b = hidden(1.0 - 0x1p-29 + 0x1p-52), product = hidden(a * b);
  EXPECT_EQ(product_less(a, b, product), 0.0);
}

}  // namespace
