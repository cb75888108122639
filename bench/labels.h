#pragma once
/// \file
/// Labelled sweeps: one body, one motion, one triangle, and the answer to the last bit. They judge any engine.
///
/// The labels are computed by brute force in 113-bit arithmetic (tests/support/oracle.h), which shares no code with
/// roam's sweeps. roam's answer is only where the search for a label begins.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "roam/sweep.h"

namespace roam::bench {

/// One sweep and its answer: a record of the file, 184 bytes, numbers as on x86.
struct LabelledSweep {
  std::int32_t kind = 0;                   ///< see kind_name()
  std::int32_t hit = 0;                    ///< 1: at some time the axis is nearer to the triangle than the radius
  double radius = 0.0, half_height = 0.0;  ///< m; 0 half height: a sphere, else an upright capsule
  double from[3]{}, motion[3]{};           ///< m
  double triangle[3][3]{};                 ///< m
  double time = 1.0;                       ///< greatest double in [0, 1] up to which the body is free
  double gap = 0.0;                        ///< m: least gap during the motion; less than 0 if hit
  double point[3]{};                       ///< m: the triangle's point closest to the body at `time`, if it
                                           ///< was free at the start and is hit; else 0

  [[nodiscard]] Body body() const { return {radius, half_height}; }
  [[nodiscard]] Vec3 start() const { return {from[0], from[1], from[2]}; }
  [[nodiscard]] Vec3 way() const { return {motion[0], motion[1], motion[2]}; }
  [[nodiscard]] Triangle corners() const;
};
static_assert(sizeof(LabelledSweep) == 184);

inline constexpr int kind_count = 9;
/// "grazing", "sliver", ...
[[nodiscard]] std::string kind_name(int kind);

/// Computes the label of a sweep: everything from `hit` on but the sweep itself.
void label(LabelledSweep& sweep);

/// Makes `count` labelled sweeps, all kinds in turn, spheres and capsules, at the origin and up to 6.4e6 m from it.
/// `take` receives them in order. On all cores; the same sweeps for the same seed.
void make_labelled(std::uint64_t count, std::uint64_t seed,
                   const std::function<void(std::span<const LabelledSweep>)>& take);

/// The first bytes of the file: the header of a numpy file (format 1.0) of `count` records.
[[nodiscard]] std::string numpy_header(std::uint64_t count);
/// Reads such a file. Throws roam::Error if it is another.
/// Whether a file begins as one of labelled sweeps does.
[[nodiscard]] bool is_labelled(const std::filesystem::path& file);
[[nodiscard]] std::vector<LabelledSweep> read_labelled(const std::filesystem::path& file);

/// The wrong answers to the sweeps of one kind.
struct LabelScore {
  std::uint64_t sweeps = 0, hits = 0;
  std::uint64_t missed = 0;  ///< answered free, but the body gets deeper in the triangle than `tolerated`
  std::uint64_t late = 0;    ///< answered hit, but the body is that deep before
  std::uint64_t early = 0;   ///< answered hit while the triangle is still more than `far_off` away
  double deepest = 0.0;      ///< m, of all that were missed or late by any depth
  double farthest = 0.0;     ///< m: greatest distance at which a body was stopped
};
inline constexpr double tolerated = 1e-5;  // m
inline constexpr double far_off = 1e-3;    // m

/// Adds the answer to one sweep: the time of impact; 1 or more means free.
void judge(const LabelledSweep& sweep, double answer, LabelScore& score);

}  // namespace roam::bench
