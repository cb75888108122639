// Sums over a run of steps: its length, its time, the least clearance, and the events that are picked.
#include <gtest/gtest.h>

#include "motion/event_filter.h"
#include "roam/step_report.h"

namespace {

using roam::EventKind;
using roam::StepReport;
using roam::Tally;
using roam::Vec3;

StepReport step(double x, double clearance) {
  StepReport report;
  report.segments.push({Vec3(3.0, 0.0, 0.0), 1.8, 0.3, 0.5, clearance, false});
  report.segments.push({Vec3(3.0, 4.0, 0.0), 1.8, 0.3, 1.0, clearance, false});
  report.segments.push({Vec3(x, 4.0, 0.0), 1.8, 0.3, 1.0, 0.0, true});
  report.to = {x, 4.0, 0.0};
  report.elapsed = 1.0;
  report.least_axis_clearance = clearance;
  report.least_gap = clearance - 0.3;
  return report;
}

std::vector<EventKind> kinds_of(const std::vector<roam::RouteEvent>& events, std::uint64_t of_step) {
  std::vector<EventKind> kinds;
  for (const roam::RouteEvent& e : events) {
    if (e.step == of_step) kinds.push_back(e.event.kind);
  }
  return kinds;
}

TEST(StepLength, IsThatOfItsPiecesWithoutPlacements) {
  EXPECT_EQ(step(100.0, 0.4).length(), 7.0);
  EXPECT_EQ(StepReport{}.length(), 0.0);
}

TEST(Tally, SumsStepsAndTakesTheLeastClearance) {
  Tally tally;
  tally.add_placement(step(0.0, 0.9));
  EXPECT_EQ(tally.steps, 0U);
  EXPECT_EQ(tally.length, 0.0);
  EXPECT_EQ(tally.least_axis_clearance, 0.9);
  tally.add_step(step(0.0, 0.5));
  StepReport slow = step(0.0, 0.7);
  slow.events.push({EventKind::slowed});
  slow.events.push({EventKind::throttled});
  tally.add_step(slow);
  EXPECT_EQ(tally.steps, 2U);
  EXPECT_EQ(tally.length, 14.0);
  EXPECT_EQ(tally.simulated, 2.0);
  EXPECT_EQ(tally.throttled, 1U) << "a step counts once";
  EXPECT_EQ(tally.least_axis_clearance, 0.5);
  EXPECT_EQ(tally.least_gap, 0.5 - 0.3);
}

TEST(Tally, KnowsNoClearanceOfABodyThatDoesNotFit) {
  Tally tally;
  tally.add_placement(step(0.0, 0.0));
  tally.add_step(step(0.0, 0.6));
  tally.add_step(step(0.0, 0.0));
  EXPECT_EQ(tally.least_axis_clearance, 0.6);
  EXPECT_EQ(tally.least_gap, 0.6 - 0.3);
}

TEST(EventFilter, TellsOfAKindOnceAStepAndOnceARunOfSteps) {
  StepReport report;
  report.events.push({EventKind::slid, Vec3(1.0)});
  report.events.push({EventKind::slid, Vec3(2.0)});
  report.events.push({EventKind::landed, Vec3(3.0)});
  std::vector<roam::RouteEvent> events;
  roam::EventFilter filter;
  filter.append(events, 1, report);
  EXPECT_EQ(kinds_of(events, 1), (std::vector{EventKind::slid, EventKind::landed}));
  EXPECT_EQ(events.front().event.point, Vec3(1.0));
  report.events.push({EventKind::crouched, Vec3(4.0)});
  filter.append(events, 2, report);
  EXPECT_EQ(kinds_of(events, 2), std::vector{EventKind::crouched});
  filter.append(events, 3, StepReport{});
  filter.append(events, 4, report);
  EXPECT_EQ(kinds_of(events, 4).size(), 3U) << "a new run of steps";
}

}  // namespace
