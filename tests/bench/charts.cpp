// Charts of times: that their lengths are the times, and their texts can be read.
#include "bench/charts.h"

#include <gtest/gtest.h>

#include "sheet_items.h"

namespace roam::bench {
namespace {

using sheets::all;
using sheets::box;
using sheets::expect_readable;

TEST(BarChart, IsAsLongAsItsTimesAre) {
  const draw::Sheet sheet =
      bar_chart("Sweeps", {{"random", {{"roam", 0.5, 5.0, "", true}, {"an engine & <more>", 50.0, 500.0, "12 wrong"}}},
                           {"near", {{"roam", 0.0, 0.0, "no room", true}}}});
  const auto p50 = all<draw::Lines>(sheet, "bars p50"), p99 = all<draw::Lines>(sheet, "bars p99");
  ASSERT_EQ(p50.size(), 2U);  // no time, no bar
  ASSERT_EQ(p99.size(), 2U);
  // An axis of powers of ten: each step by ten is equally long.
  const double decade = box(p99[0]).width() - box(p50[0]).width();
  EXPECT_GT(decade, 50.0);
  EXPECT_NEAR(box(p50[1]).width() - box(p99[0]).width(), decade, 1e-6);
  EXPECT_NEAR(box(p99[1]).width() - box(p50[1]).width(), decade, 1e-6);
  EXPECT_DOUBLE_EQ(box(p50[1]).lower.x, box(p50[0]).lower.x);
  EXPECT_GT(box(p50[1]).lower.y, box(p50[0]).upper.y);
  const auto names = all<draw::Text>(sheet, "bars name");
  ASSERT_EQ(names.size(), 3U);
  EXPECT_TRUE(names[0].font.bold);
  EXPECT_EQ(names[1].text, "an engine & <more>");
  EXPECT_FALSE(names[1].font.bold);
  const auto figures = all<draw::Text>(sheet, "bars figures");
  ASSERT_EQ(figures.size(), 3U);
  EXPECT_EQ(figures[1].text, "50 / 500  12 wrong");
  EXPECT_GT(figures[1].at.x, box(p99[1]).upper.x);
  expect_readable(sheet);
}

TEST(BarChart, HasATitleWithoutAnyBars) {
  const draw::Sheet sheet = bar_chart("Sweeps", {});
  EXPECT_EQ(all<draw::Text>(sheet, "title").size(), 1U);
  expect_readable(sheet);
}

TEST(StepChart, HasItsPointsWhereTheTimesAre) {
  const draw::Sheet sheet = step_chart({{10'000, 1.0, 10.0}, {1'000'000, 2.0, 1e-9}});
  const auto median = all<draw::Disc>(sheet, "steps median"), p99 = all<draw::Disc>(sheet, "steps p99");
  ASSERT_EQ(median.size(), 2U);
  ASSERT_EQ(p99.size(), 2U);
  EXPECT_DOUBLE_EQ(median[0].centre.x, p99[0].centre.x);
  const double decade = 0.5 * (median[1].centre.x - median[0].centre.x);
  EXPECT_GT(decade, 50.0);
  const double up = median[0].centre.y - p99[0].centre.y;  // from 1 to 10 microseconds
  EXPECT_GT(up, 50.0);
  EXPECT_NEAR(median[0].centre.y - median[1].centre.y, 0.30103 * up, 0.01);
  // All within the frame, also a time that the clock did not see.
  draw::Rect frame;
  for (const draw::Lines& line : all<draw::Lines>(sheet, "steps grid")) {
    frame.include(box(line).lower);
    frame.include(box(line).upper);
  }
  for (const auto& points : {median, p99}) {
    for (const draw::Disc& point : points) EXPECT_TRUE(frame.grown(1e-6).contains(point.centre));
  }
  expect_readable(sheet);
}

}  // namespace
}  // namespace roam::bench
