// Time and frames: how long a key was down counts, and nothing else.
#include <chrono>
#include <thread>

#include "osg_standing.h"

namespace {

using namespace scenes;
using rig::Standing;

TEST(ManipulatorTime, ATapBetweenTwoFramesCountsForAsLongAsItWas) {
  Standing r;
  r.time += 0.02;
  r.down('w');
  r.time += 0.05;
  r.up('w');
  r.frame(0.03);
  EXPECT_NEAR(r.at().x, 1.4 * 0.05, 1e-4);
}

TEST(ManipulatorTime, AfterALongRestOnlyTheTimeSinceThePressCounts) {
  Standing r;
  r.time += 9.9;
  r.down('w');
  r.frame(0.1);
  EXPECT_NEAR(r.at().x, 1.4 * 0.1, 1e-4);
}

TEST(ManipulatorTime, ALongFrameIsCutShort) {
  Standing r;
  r.down('w');
  r.frame(20.0);
  EXPECT_NEAR(r.at().x, 1.4 * osgRoam::Manipulator::longest_frame, 1e-4);
}

TEST(ManipulatorTime, EveryFrameIsCutIntoShortSteps) {
  Standing r;
  double longest = 0.0, sum = 0.0;
  int count = 0;
  r->setStepCallback([&](const roam::StepReport&, double seconds) {
    longest = std::max(longest, seconds);
    sum += seconds;
    ++count;
  });
  for (const double dt : {0.001, 0.01, 0.0166, 0.017, 0.04, 0.1, 0.25, 3.0}) {
    const double before = sum;
    count = 0;
    r.frame(dt);
    EXPECT_LE(longest, osgRoam::Manipulator::longest_step + 1e-12);
    EXPECT_NEAR(sum - before, std::min(dt, 0.25), 1e-9);
    EXPECT_EQ(r->steps(), count);
    EXPECT_GT(r->collisionNanoseconds(), 0);
  }
}

TEST(ManipulatorTime, AFrameOfOneStepIsOneStepHoweverLateTheClockIs) {
  Standing r;
  r.time = 10'000.0;
  r.frame(0.0);
  for (int i = 0; i < 2000; ++i) {
    r.frame(osgRoam::Manipulator::longest_step);
    ASSERT_EQ(r->steps(), 1) << i;
  }
}

TEST(ManipulatorTime, TellsItsOwnTimeApartFromWhatOthersTake) {
  Standing r;
  constexpr std::int64_t rest = 50'000'000;  // ns
  r->setPilot([&](roam::Walker& walker, double seconds) {
    std::this_thread::sleep_for(std::chrono::nanoseconds(rest));
    return &walker.step({}, seconds);
  });
  r.frame(0.01);
  EXPECT_GT(r->collisionOwnNanoseconds(), 0);
  EXPECT_LE(r->collisionOwnNanoseconds() + rest, r->collisionNanoseconds());
  r->setPilot(nullptr);
  r.frame(0.0);
  EXPECT_EQ(r->collisionOwnNanoseconds(), 0);
}

TEST(ManipulatorTime, TimeThatStandsStillOrRunsBackwardsMovesNothing) {
  Standing r;
  r.down('w');
  r.frame(0.0);
  const Vec3 before = r.at();
  for (const double dt : {0.0, -5.0, 0.0, -1e9}) r.frame(dt);
  EXPECT_EQ(r.at(), before);
  r.queue->frame(NAN);
  r.deliver();
  r.frames(1.0);  // and goes on from where it stands now
  EXPECT_NEAR(r.at().x - before.x, 1.4, 1e-3);
  EXPECT_EQ(r->problem(), "");
}

TEST(ManipulatorTime, EventsWithNonsensicalTimesAreHarmless) {
  Standing r;
  for (const double when : {0.0, 1e300, -1e300, double(NAN), double(INFINITY)}) {
    r.queue->keyPress('w', when, 'w');
    r.deliver();
    r.frames(0.1);
    r.queue->keyRelease('w', when, 'w');
    r.deliver();
    r.frames(0.1);
  }
  EXPECT_TRUE(std::isfinite(r.at().x));
  EXPECT_LE(r.at().x, 1.4 * 5 * 0.21);
  EXPECT_EQ(r->problem(), "");
}

}  // namespace
