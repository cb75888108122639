// What the body and the eye do over many frames, judged by brute force in long double.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "osg_rig.h"

namespace {

using namespace scenes;
using rig::Adapter;
using rig::Rig;

constexpr double side = 6.0;  // metres: half the width of the hall

/// A closed hall with boxes, boards that lean about, and a flight of stairs.
Mesh clutter(std::uint64_t seed) {
  Random random(seed);
  Mesh m;
  add_box(m, {-side, -side, 0.0}, {side, side, 4.0});
  for (int i = 0; i < 12; ++i) {
    const Vec3 lo(random.between(-side, side), random.between(-side, side), 0.0);
    add_box(m, lo, lo + Vec3(random.between(0.05, 2.0), random.between(0.05, 2.0), random.between(0.05, 2.5)));
  }
  for (int i = 0; i < 12; ++i) {
    const Vec3 a(random.between(-side, side), random.between(-side, side), random.between(0.0, 2.0));
    const auto leg = [&] {
      return Vec3(random.between(-1.5, 1.5), random.between(-1.5, 1.5), random.between(-1.0, 1.0));
    };
    add_triangle(m, a, a + leg(), a + leg());
  }
  for (int i = 0; i < 8; ++i) add_box(m, {-4.0 + 0.3 * i, 4.0, 0.0}, {-1.0, 5.5, 0.17 * (i + 1)});
  return m;
}

/// Corridors of 1.6 m by 2.2 m round a block, with doors of 0.75 m by 1.8 m, stairs up and down, and a low beam.
Mesh gallery(std::uint64_t seed) {
  Random random(seed);
  Mesh m;
  add_box(m, {-side, -side, -0.6}, {side, side, 2.2});
  add_box(m, {-side + 1.6, -side + 1.6, -0.6}, {side - 1.6, side - 1.6, 2.2});
  for (const double y : {-side, side - 1.6}) {  // doors across both long corridors
    const double x = random.between(-3.0, 3.0), gap = 0.425;
    add_box(m, {x, y, -0.6}, {x + 0.1, y + gap, 2.2});
    add_box(m, {x, y + 1.6 - gap, -0.6}, {x + 0.1, y + 1.6, 2.2});
    add_box(m, {x, y + gap, 1.2}, {x + 0.1, y + 1.6 - gap, 2.2});
  }
  for (int i = 0; i < 4; ++i) {
    add_box(m, {-side, -2.0 + 0.3 * i, -0.6}, {-side + 1.6, 2.0 - 0.3 * i, -0.6 + 0.15 * (i + 1)});
  }
  add_box(m, {side - 1.6, 0.0, 0.75}, {side, 0.4, 2.2});  // to be crouched under
  return m;
}

/// A person at random keys.
struct Monkey {
  Rig& r;
  Random random;
  const Mesh& mesh;
  Judge judge;
  long judged = 0, frames = 0, ghosts = 0, held = 0;
  double travelled = 0.0;
  double worst = std::numeric_limits<double>::infinity();
  double worst_eye = std::numeric_limits<double>::infinity();

  Monkey(Rig& rig, const Mesh& scene, std::uint64_t seed) : r(rig), random(seed), mesh(scene), judge(scene) {
    r->setStepCallback([this](const roam::StepReport& report, double) {
      if (r->mode() == roam::Mode::ghost || report.held) return;
      ++judged;
      travelled += glm::length(report.to - report.from);
      worst = std::min(worst, margin(judge, report, r->settings().radius));
    });
  }

  void hit_a_key() {
    static constexpr std::array keys{int('w'),
                                     int('w'),
                                     int('w'),
                                     int('s'),
                                     int('a'),
                                     int('d'),
                                     int('q'),
                                     int('e'),
                                     int(' '),
                                     int('c'),
                                     int(Adapter::KEY_Shift_L),
                                     int(Adapter::KEY_Control_L)};
    const int key = keys[random.bits() % keys.size()];
    random.chance(0.6) ? r.down(key) : r.up(key);
  }
  void act() {
    if (random.chance(0.3)) hit_a_key();
    if (random.chance(0.3)) r->look(r->yaw() + random.between(-0.3, 0.3), random.between(-1.0, 1.0));
    if (random.chance(0.01)) {
      const float x = static_cast<float>(random.between(0, 799)), y = static_cast<float>(random.between(0, 599));
      r.double_click(x, y);
    }
    if (random.chance(0.01)) r.wheel(random.chance(0.5) ? Adapter::SCROLL_UP : Adapter::SCROLL_DOWN);
    if (random.chance(0.003)) r.press('g');
    if (random.chance(0.002)) r.press('n');
    if (random.chance(0.001)) r->releaseKeys();
    if (random.chance(0.001)) {
      const osg::Vec3d to(random.between(-side, side), random.between(-side, side), random.between(0.0, 4.0));
      r->setByMatrix(osg::Matrixd::translate(to));
    }
  }
  void frame() {
    act();
    r.frame(0.002 * std::pow(100.0, random.unit()));  // 500 Hz to 5 Hz
    ++frames;
    if (r->mode() == roam::Mode::ghost) {
      ++ghosts;
    } else if (r->held()) {
      ++held;
    } else {
      const double least = r->leastEyeDistance();
      worst_eye = std::min(worst_eye, judge.distance({0.0, 0.0}, r->eye(), least + 0.01) - least);
    }
  }
};

void random_input(const Mesh& mesh, const roam::WalkerSettings& settings, std::uint64_t seed, int frames) {
  Rig r(mesh, settings, seed % 2 ? roam::Mode::walk : roam::Mode::fly);
  r->setPose({-side + 0.8, -side + 0.8, 1.4}, 0.5, 0.0);
  Monkey monkey(r, mesh, seed);
  for (int i = 0; i < frames; ++i) monkey.frame();
  EXPECT_GE(monkey.worst, 0.0);
  EXPECT_GE(monkey.worst_eye, -1e-6);
  EXPECT_EQ(r->problem(), "");
  // It did get about, and was mostly judged.
  EXPECT_GT(monkey.travelled, 0.02 * frames);
  EXPECT_GT(monkey.judged, frames);
  EXPECT_LT(monkey.ghosts + monkey.held, frames / 2);
}

class RandomInput : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(ManipulatorMotion, RandomInput, testing::Range(0, 10));

TEST_P(RandomInput, NeverBringsBodyOrEyeIntoAWall) {
  const int i = GetParam();
  const auto seed = static_cast<std::uint64_t>(i + 1);
  const roam::WalkerSettings bodies[] = {{},
                                         {.radius = 0.25, .height = 1.7, .eye = 1.7},
                                         roam::WalkerSettings::sphere(0.35),
                                         {.radius = 0.2, .height = 1.0, .eye = 0.0, .crouch_height = 0.5},
                                         {.clearance_reach = 0.0}};
  random_input(i % 2 ? clutter(seed) : gallery(seed), bodies[i / 2], seed, 10000);
}

/// Presses and lets go at the same moments, whatever the frames are.
Vec3 scripted(double dt, roam::Mode mode) {
  Mesh m = floor_mesh();
  add_wall(m, 6.0, -10.0, 9.0, 10.0, 0.0, 6.0);  // slid along
  for (int i = 0; i < 5; ++i) add_box(m, {2.0 + 0.3 * i, -10.0, 0.0}, {5.0, 10.0, 0.17 * (i + 1)});
  Rig r(m, {}, mode);
  r->setFeet({0.0, 0.0, 0.0}, 0.3, 0.1);
  struct Stroke {
    double time;
    int key;
    bool press;
  };
  const Stroke strokes[] = {{0.11, 'w', true},
                            {1.93, 'a', true},
                            {2.41, 'a', false},
                            {3.0, Adapter::KEY_Shift_L, true},
                            {3.77, Adapter::KEY_Shift_L, false},
                            {3.9, ' ', true},
                            {3.95, ' ', false},
                            {5.03, 'w', false},
                            {5.2, 'd', true},
                            {6.01, 'd', false}};
  const double start = r.time;
  for (std::size_t next = 0; r.time < start + 7.0;) {
    while (next < std::size(strokes) && start + strokes[next].time <= r.time + dt) {
      const Stroke& s = strokes[next++];
      if (s.press) {
        r.queue->keyPress(s.key, start + s.time, s.key);
      } else {
        r.queue->keyRelease(s.key, start + s.time, s.key);
      }
    }
    r.frame(dt);
  }
  EXPECT_GT(glm::length(r->walker()->position()), 4.0);
  return r->walker()->position();
}

TEST(ManipulatorMotion, TheSameInputGoesNearlyTheSameWayAtAnyFrameRate) {
  for (const roam::Mode mode : {roam::Mode::walk, roam::Mode::fly}) {
    const Vec3 fine = scripted(1.0 / 500.0, mode);
    for (const double rate : {144.0, 60.0, 30.0, 11.0, 5.0}) {
      EXPECT_LT(glm::length(scripted(1.0 / rate, mode) - fine), 0.02) << rate;
    }
  }
}

/// A flight of stairs from x = 1 to x = 7 and a landing.
Mesh stairs() {
  Mesh m = floor_mesh();
  for (int i = 0; i < 20; ++i) add_box(m, {1.0 + 0.3 * i, -2.0, 0.0}, {12.0, 2.0, 0.17 * (i + 1)});
  return m;
}

/// The largest change of height of the eye, and of the body, between two frames of 1/60 s at one step of the stairs.
struct Jolts {
  double eye = 0.0, body = 0.0;
};

Jolts climb(Rig& r, double seconds) {
  Jolts jolts;
  for (double t = 0.0; t < seconds; t += frame) {
    const double eye = r->eye().z, feet = r->walker()->feet().z;
    r.frame(frame);
    jolts.eye = std::max(jolts.eye, std::abs(r->eye().z - eye));
    jolts.body = std::max(jolts.body, std::abs(r->walker()->feet().z - feet));
  }
  return jolts;
}

/// Walks on a floor with a wall across it at x = 8.
struct Eased : Rig {
  Eased() : Rig(yard(), {}, roam::Mode::walk) {
    manipulator->setFeet({0.0, 0.0, 0.0}, 0.0, 0.0);
    manipulator->setEasing(0.2);
    frames(0.5);
  }
  static Mesh yard() {
    Mesh m = floor_mesh();
    add_wall(m, 8.0, -10.0, 8.0, 10.0, 0.0, 5.0);
    return m;
  }
  [[nodiscard]] Vec3 at() const { return manipulator->walker()->position(); }
};

TEST(ManipulatorEasing, KeysBringTheBodyToSpeedAndToRestInThisTime) {
  Eased r;
  const double v = r->speed();
  r.down('w');
  r.frames(0.1);
  EXPECT_NEAR(r.at().x, v * 0.1 * 0.1 / (2.0 * 0.2), 1e-3);
  r.frames(0.9);
  EXPECT_NEAR(r.at().x, v * 0.9, 1e-3);
  r.up('w');
  r.frames(0.1);
  EXPECT_NEAR(r.at().x, v * (0.9 + 0.075), 1e-3);
  r.frames(0.5);
  EXPECT_NEAR(r.at().x, v, 1e-3);
  EXPECT_EQ(r.at().y, 0.0);
  EXPECT_FALSE(r.viewer.continuous);
  r->setEasing(0.0);
  r.down('w');
  r.frames(0.5);
  r.up('w');
  r.frames(0.5);
  EXPECT_NEAR(r.at().x, v * 1.5, 1e-3);
}

TEST(ManipulatorEasing, DelaysNeitherWallsNorTheEndOfAWay) {
  Eased r, plain;
  plain->setEasing(0.0);
  for (Eased* one : {&r, &plain}) {
    (*one)->setSpeed(20.0);
    one->down('w');
    one->frames(2.0);
    one->up('w');
    one->frames(0.5);
  }
  EXPECT_NEAR(r.at().x, plain.at().x, 1e-3) << "at the wall";
  for (Eased* one : {&r, &plain}) {
    (*one)->goTo({2.0, 3.0, 0.0}, {0.0, 0.0, 1.0});
    one->frames(3.0);
  }
  EXPECT_EQ(r->going(), false);
  EXPECT_LT(glm::distance(r.at(), plain.at()), 1e-3);
}

TEST(ManipulatorEasing, IsAFiniteTime) {
  const Rig r;
  for (const double wrong : {-0.1, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(r->setEasing(wrong), roam::Error);
  }
  EXPECT_EQ(r->easing(), 0.0);
}

TEST(ManipulatorMotion, TheEyeClimbsStairsSoftlyUpAndDown) {
  Rig r(stairs(), {}, roam::Mode::walk);
  r->setFeet({0.0, 0.0, 0.0}, 0.0, 0.0);
  r.frames(0.5);
  r.down('w');
  const Jolts up = climb(r, 6.0);
  EXPECT_NEAR(r->walker()->feet().z, 3.4, near_ground);
  r.up('w');
  r.frames(1.0);
  EXPECT_NEAR(r->eye().z, 3.4 + 1.6, near_ground);  // it catches up
  r.down('s');
  const Jolts down = climb(r, 6.0);
  EXPECT_NEAR(r->walker()->feet().z, 0.0, near_ground);
  // A ramp through the stairs would be 0.013 m a frame.
  EXPECT_GT(std::min(up.body, down.body), 0.035);
  EXPECT_LT(std::max(up.eye, down.eye), 0.025);
}

TEST(ManipulatorMotion, JumpsAndFallsAreNotSoftened) {
  Rig r(stairs(), {}, roam::Mode::walk);
  r->setFeet({0.0, 0.0, 0.0}, 0.0, 0.0);
  r.frames(0.5);
  r.press(' ');
  r.frames(0.3);
  EXPECT_NEAR(r->eye().z - r->walker()->feet().z, 1.6, 1e-3);
}

TEST(ManipulatorMotion, UnderALowCeilingTheEyeKeepsItsDistance) {
  // Down a stair under a ceiling that leaves the body 3 cm.
  Mesh m = floor_mesh();
  add_box(m, {-10.0, -2.0, 0.0}, {0.0, 2.0, 0.25});
  add_box(m, {-10.0, -2.0, 2.08}, {0.6, 2.0, 2.4});
  add_box(m, {0.6, -2.0, 1.83}, {10.0, 2.0, 2.4});
  Rig r(m, {}, roam::Mode::walk);
  r->setFeet({-2.0, 0.0, 0.25}, 0.0, 0.0);
  r.frames(0.5);
  const Judge judge(m);
  r.down('w');
  r.down(Adapter::KEY_Shift_L);  // so that the eye lags far behind
  for (int i = 0; i < 400 && r->walker()->position().x < 3.0; ++i) {
    r.frame(frame / 4.0);
    ASSERT_GE(judge.distance({0.0, 0.0}, r->eye(), 1.0), r->leastEyeDistance() - 1e-6);
  }
  EXPECT_GT(r->walker()->position().x, 1.5);
  EXPECT_NEAR(r->walker()->feet().z, 0.0, near_ground);
}

TEST(ManipulatorMotion, TheLeastDistanceOfTheEyeIsThatOfTheBodyAroundIt) {
  Rig r;
  r->setSettings({.radius = 0.3, .height = 1.8, .eye = 1.6, .crouch_height = 1.8});
  EXPECT_NEAR(r->leastEyeDistance(), 0.2, 1e-12);
  r->setSettings({.radius = 0.3, .height = 1.8, .eye = 0.9, .crouch_height = 1.8});
  EXPECT_NEAR(r->leastEyeDistance(), 0.3, 1e-12);
  r->setSettings({.radius = 0.3, .height = 1.8, .eye = 1.8});
  EXPECT_NEAR(r->leastEyeDistance(), 0.075, 1e-12);  // never on the skin of the body
  r->setSettings(roam::WalkerSettings::sphere(0.5));
  EXPECT_NEAR(r->leastEyeDistance(), 0.5, 1e-12);
}

}  // namespace
