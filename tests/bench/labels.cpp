// Labelled sweeps: labels are the truth to the last bit, the file is numpy's, and a bad engine is found out.

#include "bench/labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "oracle.h"
#include "roam/error.h"

namespace roam::bench {
namespace {

using oracle::Quad;

std::vector<LabelledSweep> some(std::uint64_t count, std::uint64_t seed = 3) {
  std::vector<LabelledSweep> all;
  make_labelled(count, seed, [&](auto made) { all.insert(all.end(), made.begin(), made.end()); });
  return all;
}

/// A sphere of 0.5 m that flies 4 m down towards the plane z = 0 from a height of 2 m.
LabelledSweep fall() {
  return {.radius = 0.5,
          .from = {0.25, 0.25, 2.0},
          .motion = {0.0, 0.0, -4.0},
          .triangle = {{-8.0, -8.0, 0.0}, {8.0, -8.0, 0.0}, {0.0, 8.0, 0.0}}};
}

Quad gap_until(const LabelledSweep& s, double time) {
  return oracle::least_distance<Quad>(s.body(), s.start(), s.way(), time, s.corners()) - Quad(s.radius);
}

TEST(Labels, OfAFallAreThoseOfSchool) {
  LabelledSweep s = fall();
  label(s);
  EXPECT_EQ(s.hit, 1);
  EXPECT_EQ(s.time, 0.375);
  EXPECT_EQ(s.gap, -0.5);
  EXPECT_EQ(s.point[0], 0.25);
  EXPECT_EQ(s.point[2], 0.0);
}

TEST(Labels, OfAMissAreItsGap) {
  LabelledSweep s = fall();
  s.motion[2] = -1.25;
  label(s);
  EXPECT_EQ(s.hit, 0);
  EXPECT_EQ(s.time, 1.0);
  EXPECT_EQ(s.gap, 0.25);
}

TEST(Labels, AreTheTruthToTheLastBit) {
  int hits = 0, free_hits = 0;
  for (const LabelledSweep& s : some(6000)) {
    if (s.hit == 0) {
      ASSERT_GE(gap_until(s, 1.0), 0);
      ASSERT_EQ(s.time, 1.0);
      continue;
    }
    ++hits;
    ASSERT_LT(gap_until(s, std::nextafter(s.time, 2.0)), 0) << "a later time is free";
    if (gap_until(s, 0.0) < 0) {
      ASSERT_EQ(s.time, 0.0);
      continue;
    }
    ++free_hits;
    ASSERT_GE(gap_until(s, s.time), 0) << "the body is not free until then";
    // The point lies on the triangle, as near to the axis as anything on it, to the digits of its coordinates.
    const Triangle corners = s.corners();
    const Vec3 point(s.point[0], s.point[1], s.point[2]);
    const double digit = 0x1p-50 * (std::abs(point.x) + std::abs(point.y) + std::abs(point.z) + 1.0);
    ASSERT_LE(double(oracle::distance<Quad>({}, point, corners)), digit);
    const Triangle only{point, point, point};
    const double there = double(oracle::distance_on_the_way<Quad>(s.body(), s.start(), s.way(), s.time, only));
    const double least = double(oracle::distance_on_the_way<Quad>(s.body(), s.start(), s.way(), s.time, corners));
    ASSERT_LE(there, least + digit);
  }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(free_hits, 1500);
}

TEST(Labels, AreTheSameForTheSameSeed) {
  const auto a = some(500), b = some(500), other = some(500, 4);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].time, b[i].time);
    ASSERT_EQ(a[i].from[0], b[i].from[0]);
  }
  EXPECT_NE(a[0].from[0], other[0].from[0]);
}

class LabelFile : public testing::Test {
 protected:
  LabelFile() { std::filesystem::create_directories(folder_); }
  ~LabelFile() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "roam_labels";
  std::filesystem::path file_ = folder_ / "sweeps.npy";
};

TEST_F(LabelFile, IsReadAsItWasWritten) {
  const auto sweeps = some(100);
  const std::string records(reinterpret_cast<const char*>(sweeps.data()), sweeps.size() * sizeof(LabelledSweep));
  write(numpy_header(100) + records);
  const auto read = read_labelled(file_);
  ASSERT_EQ(read.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) ASSERT_EQ(read[i].time, sweeps[i].time);
  EXPECT_EQ(numpy_header(100).size() % 64, 0u);

  write(numpy_header(100) + records.substr(1));
  EXPECT_THROW((void)read_labelled(file_), Error);
  write(numpy_header(99) + records);
  EXPECT_THROW((void)read_labelled(file_), Error);
}

TEST(LabelScores, FindABlindALateAndATimidEngine) {
  LabelledSweep s = fall();
  label(s);
  LabelScore right, blind, late, timid;
  judge(s, 0.375, right);
  judge(s, 1.0, blind);
  judge(s, 0.5, late);
  judge(s, 0.25, timid);
  EXPECT_EQ(right.missed + right.late + right.early, 0u);
  EXPECT_EQ(right.hits, 1u);
  EXPECT_EQ(blind.missed, 1u);
  EXPECT_EQ(blind.deepest, 0.5);
  EXPECT_EQ(late.late, 1u);
  EXPECT_DOUBLE_EQ(late.deepest, 0.5);
  EXPECT_EQ(timid.early, 1u);
  EXPECT_DOUBLE_EQ(timid.farthest, 0.5);
}

}  // namespace
}  // namespace roam::bench
