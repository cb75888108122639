// Certificates written by hand, and forgeries of them with the right checksum.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "check/check.h"
#include "messages.h"
#include "verify/verification.h"

namespace {

using roam::Triangle;
using roam::Vec3;
using namespace roam::checking;

/// A floor and a wall at x = 6.
const std::vector<Triangle> scene{{Vec3(0, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)},
                                  {Vec3(9, 9, 0), Vec3(0, 9, 0), Vec3(9, -9, 0)},
                                  {Vec3(6, -9, 0), Vec3(6, 9, 0), Vec3(6, 0, 9)}};

/// Forward, a crouch, and up again.
const std::string good =
    "way 6 1 0 1 5 0 1\nsize 0.3 0.6\nsize 0.3 0.25\n"
    "segment 1 1 0 1 2 0 1 0.3 0.6 0.4\n"
    "segment 2 2 0 1 2 0 0.65 0.3 0.25 0.4\n"
    "segment 3 2 0 0.65 4 0 0.65 0.3 0.25 0.39\n"
    "segment 4 4 0 0.65 4 0 1 0.3 0.25 0.35\n"
    "segment 5 4 0 1 4 0 1 0.3 0.6 0.35\n"
    "segment 6 4 0 1 5 0 1 0.3 0.6 0.3999999999\n";

std::string with_head(const std::string& text, const std::vector<Triangle>& triangles = scene) {
  SceneSum sum;
  for (const Triangle& t : triangles) sum.add(t);
  char line[64];
  std::snprintf(line, sizeof line, "\nscene %zu %016llx\n", triangles.size(),
                static_cast<unsigned long long>(sum.hash));
  return std::string(first_line) + line + text;
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), by);
}

/// The refusal, and the number of its segment; empty: accepted.
std::string refusal(const std::string& text, const std::vector<Triangle>& triangles = scene) {
  try {
    const Certificate certificate = read_certificate(text);
    Checker checker(certificate);
    for (const Triangle& t : triangles) checker.add(t);
    checker.finish();
  } catch (const Refused& refused) {
    return std::to_string(refused.segment) + ": " + refused.what();
  } catch (const std::invalid_argument& damaged) {
    return damaged.what();
  }
  return "";
}

/// The refusal of these lines with a right checksum.
std::string forged(const std::string& text, const std::vector<Triangle>& triangles = scene) {
  const std::string all = with_head(text);
  return refusal(all + checksum_line(all), triangles);
}

TEST(Certificate, IsAcceptedIfItIsTrue) { EXPECT_EQ(forged(good), ""); }

TEST(Certificate, IsRefusedForEachForgery) {
  struct Forgery {
    const char *part, *by, *refusal;
  };
  const char* const size = "the head of the file does not name this size of the body";
  const char* const joint = "it does not begin where the one before it ends, or the head of the file says";
  const char* const end = "it does not end where the head of the file says";
  for (const auto& [part, by, why] : std::vector<Forgery>{
           {"1 2 0 1 0.3 0.6 0.4", "1 2 0 1 0.2 0.6 0.4", size},         // a radius made smaller
           {"1 2 0 1 0.3 0.6 0.4", "1 2 0 1 0.3 0.25 0.4", ""},          // the crouch begins earlier: true
           {"4 0 0.65 0.3 0.25", "4 0 0.65 0.3 0.6", "moves sideways"},  // stands up where it may not
           {"4 0 1 0.3 0.6", "4.1 0 1 0.3 0.6", "5: the body has another size than before, and moves sideways"},
           {"4 0 1 0.3 0.6", "4 0.1 1 0.3 0.6", "5: the body has another size than before, and moves sideways"},
           {"1 2 0 1 0.3", "1 2 0.1 1 0.3", joint},  // a corner moved
           {"0.4\nsegment 2", "0.41\nsegment 2", "1: triangle 0 of the scene is nearer than it says"},
           {"0.39\n", "0.41\n", "3: triangle 0 of the scene is nearer"},  // bounds raised
           {"0.3999999999\n", "0.4000001\n", "6: triangle 0 of the scene is nearer"},
           {"0.39\n", "0.2999\n", "3: its clearance is below the radius"},
           {"segment 3 2 0 0.65 4 0 0.65 0.3 0.25 0.39\n", "", "4: a segment before it is missing"},  // left out
           {"segment 1 1 0 1 2 0 1 0.3 0.6 0.4\n", "", "2: a segment before it is missing"},
           {"segment 6 4 0 1 5 0 1 0.3 0.6 0.3999999999\n", "", "another number of segments"},
           {"way 6 1", "way 6 1.5", joint},
           {"5 0 1\nsize", "5.5 0 1\nsize", end},
           {"segment 4", "segment 5", "5: a segment before it is missing"},
           {"0.39\n", "nan\n", "3: it is not as the format says"},
           {"0.39\n", "1e300\n", "3: it is not as the format says"},
           {"segment 6", "segments 6", "another number of segments"},
           {"way 6", "path 6", "0: its head is wrong"},
           {"way 6", "way 5000001", "0: its head is wrong"},
       }) {
    const std::string found = forged(replaced(good, part, by));
    if (*why == '\0') {
      EXPECT_EQ(found, "") << part << " -> " << by;
    } else {
      EXPECT_TRUE(contains(found, why)) << part << " -> " << by << ": " << found;
    }
  }
}

TEST(Certificate, NamesItsSceneAndItsVersion) {
  const auto changed = [](const std::string& part, const std::string& by) {
    const std::string all = replaced(with_head(good), part, by);
    return refusal(all + checksum_line(all));
  };
  EXPECT_EQ(changed("\nscene ", "\nscenes "), "0: its head is wrong");
  // Another form, which says nothing about the walk.
  EXPECT_EQ(changed("certificate 1\n", "certificate 2\n"), "it is no certificate of version 1");
  EXPECT_EQ(changed("certificate 1\n", "certificate 1\r\n"), "it is no certificate of version 1");
}

TEST(Certificate, NamesTheNumberOfASegmentThatWasLeftOutAndCovered) {
  std::string text = replaced(good, "segment 3 2 0 0.65 4 0 0.65 0.3 0.25 0.39\n", "");
  text =
      replaced(replaced(replaced(text, "segment 4", "segment 3"), "segment 5", "segment 4"), "segment 6", "segment 5");
  text = replaced(text, "way 6", "way 5");
  EXPECT_TRUE(contains(forged(text), "3: it does not begin where the one before it ends")) << forged(text);
}

TEST(Certificate, HoldsForItsSceneAlone) {
  const std::string certificate = with_head(good);
  // Worked out in Python from docs/format.md.
  EXPECT_TRUE(contains(certificate, "\nscene 3 bf8153c3565b119b\n")) << certificate;
  for (int i = 0; i < 27; ++i) {
    std::vector<Triangle> moved = scene;
    moved[i / 9][i / 3 % 3][i % 3] += 1e-10;
    EXPECT_TRUE(contains(refusal(certificate + checksum_line(certificate), moved),
                         "0: the scene, or its frame, is not that of the certificate"))
        << i;
  }
  std::vector<Triangle> fewer(scene.begin(), scene.end() - 1);
  EXPECT_TRUE(contains(forged(good, fewer), "0: the scene"));
  std::vector<Triangle> another_order(scene.rbegin(), scene.rend());
  EXPECT_EQ(forged(good, another_order), "");
  std::vector<Triangle> walled = scene;  // a wall through the way
  walled.push_back({Vec3(3, -1, 0), Vec3(3, 1, 0), Vec3(3, 0, 4)});
  EXPECT_TRUE(contains(forged(good, walled), "3: triangle 3 of the scene is nearer")) << forged(good, walled);
  const std::string all = with_head(good, walled);  // and its sum in the head
  EXPECT_TRUE(contains(refusal(all + checksum_line(all), walled), "3: triangle 3 of the scene is nearer"));
}

TEST(Certificate, IsNeverAcceptedIfAByteIsWrong) {
  const std::string all = with_head(good), text = all + checksum_line(all);
  ASSERT_EQ(refusal(text), "");
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (int i = 0; i < 1000; ++i) {
    std::string other = text;
    other[below(other.size())] ^= static_cast<char>(1 << below(8));
    EXPECT_NE(refusal(other), "") << other;
    other = text;
    EXPECT_NE(refusal(other.substr(0, below(other.size()))), "");
    other.insert(below(other.size()), 1, static_cast<char>(below(256)));
    EXPECT_NE(refusal(other), "") << other;
  }
}

// With the checksum made right, only true statements are accepted.
TEST(Certificate, ProvesWhateverItAccepts) {
  roam::Mesh mesh;
  for (const Triangle& t : scene) {
    const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), t.begin(), t.end());
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  // With digits of a bound that can be raised a little.
  const std::string all = with_head(replaced(good, "0.4\nsegment 2", "0.40000000\nsegment 2"));
  std::mt19937 random(11);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  const std::string characters = "0123456789.-e \n";
  int accepted = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string other = all;
    for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
      other[below(other.size())] = characters[below(characters.size())];
    }
    other += checksum_line(other);
    if (!refusal(other).empty()) continue;
    ++accepted;
    std::vector<roam::verification::Piece> pieces;
    for (const Segment& s : read_certificate(other).segments) {
      pieces.push_back({1, s.from, s.to, {s.size.radius, s.size.half_height}, s.clearance - 1e-9});
    }
    const auto found = roam::verification::verify({&mesh, 1}, pieces);
    EXPECT_EQ(found.violations, 0U) << other;
    EXPECT_EQ(found.overstated, 0U) << other;
  }
  EXPECT_GT(accepted, 0);
}

}  // namespace
