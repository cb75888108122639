#pragma once
/// \file
/// Results in every floating-point environment of a host, compared bit by bit.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <vector>

#include "host_environment.h"
#include "roam/step_report.h"

namespace same_bits {

/// Results as bits. Recording one computes nothing.
class Bits {
 public:
  void operator()(double value) { bits_.push_back(std::bit_cast<std::uint64_t>(value)); }
  void operator()(std::uint64_t value) { bits_.push_back(value); }
  void operator()(const roam::Vec3& v) {
    for (int k = 0; k < 3; ++k) (*this)(v[k]);
  }
  void operator()(const roam::Impact& i) {
    (*this)(static_cast<std::uint64_t>(i.hit));
    (*this)(i.time);
    (*this)(i.point);
    (*this)(i.normal);
    (*this)(i.distance);
    (*this)(i.triangle);
  }
  void operator()(const roam::Proximity& p) {
    (*this)(p.point);
    (*this)(p.normal);
    (*this)(p.distance);
  }
  void operator()(const roam::StepReport& r) {
    (*this)(r.to);
    (*this)(r.elapsed);
    (*this)(r.axis_clearance);
    (*this)(r.least_axis_clearance);
    for (const roam::Segment& c : r.segments) {
      (*this)(c.position);
      (*this)(c.time);
      (*this)(c.axis_clearance);
    }
    for (const roam::Contact& c : r.contacts) (*this)(c);
  }
  [[nodiscard]] const std::vector<std::uint64_t>& all() const { return bits_; }

 private:
  std::vector<std::uint64_t> bits_;
};

/// Makes the calls in every environment. Expects the results of the default one.
inline void expect_same(const std::function<void(Bits&)>& calls) {
  Bits usual;
  calls(usual);
  ASSERT_FALSE(usual.all().empty());
  for (const host::Environment& environment : host::environments()) {
    SCOPED_TRACE(host::name(environment));
    Bits bits;
    std::vector<long> before, after;
    int flags = 0;
    {
      const host::Set set(environment);
      before = host::control();
      calls(bits);
      after = host::control();
      flags = std::fetestexcept(FE_ALL_EXCEPT);
    }
    EXPECT_EQ(before, after) << "the environment is another one than before";
    const bool usual_one = environment.rounding == FE_TONEAREST && !environment.trapped && !environment.flushed;
    EXPECT_EQ(usual_one ? flags & host::host_flag : flags, host::host_flag) << "the exception flags are others";
    EXPECT_TRUE(bits.all() == usual.all()) << "the answers are others";
  }
}

}  // namespace same_bits
