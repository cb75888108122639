// The head-up display: what it says, and that it fits.

#include "graphics/hud.h"

#include <algorithm>
#include <string>
#include <vector>

#include "hud_pictures.h"

namespace roam::test {
namespace {

using graphics::Detail;
using graphics::Tone;

TEST(GraphicsHud, TextGrowsWithTheWindow) {
  const auto height_at = [](int width, int height) {
    Stage stage(width, height);
    Hud hud(stage.frame);
    hud.set_crosshair(false);
    hud.set_status({{"Mode", "walk"}});
    const Region panel = shown_in(stage);
    return panel.top - panel.bottom;
  };
  const int small = height_at(640, 360), large = height_at(1920, 1080);
  EXPECT_GE(small, 20);
  EXPECT_GT(large, 1.4 * small);
}

TEST(GraphicsHud, FollowsTheWindow) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  hud.set_message("in the lower middle");
  const Region before = shown_in(stage);
  EXPECT_NEAR(0.5 * (before.left + before.right), 320, 2);
  EXPECT_LT(before.top, 120);
  stage.context.window->setWindowRectangle(0, 0, 1000, 500);
  const Region after = shown_in(stage);
  EXPECT_NEAR(0.5 * (after.left + after.right), 500, 2);
  EXPECT_LT(after.top, 170);
}

TEST(GraphicsHud, LongTextsStayInThePicture) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  const std::string words = "a wall with a very long name that goes on and on ";
  hud.set_message(words + words + words + words, Tone::warning);
  hud.set_status({{"Place", words + words + words}});
  const Region shown = shown_in(stage);
  EXPECT_GT(shown.pixels, 5000);
  EXPECT_GE(shown.left, 2);
  EXPECT_LE(shown.right, 638);
  EXPECT_GE(shown.bottom, 2);
  EXPECT_LE(shown.top, 358);
}

TEST(GraphicsHud, LongValuesAreBrokenIntoLines) {
  const auto panel = [](int width, int height, const std::vector<graphics::StatusLine>& lines) {
    Stage stage(width, height);
    fill_with(stage, 255);
    Hud hud(stage.frame);
    hud.set_crosshair(false);
    hud.set_status(lines);
    return shown_in(stage);
  };
  const auto high = [](const Region& r) { return r.top - r.bottom; };
  const std::string note = "the display shows 12 of 14 parts; run roam info on the file to see which are missing";
  const Region one = panel(1280, 720, {{"Note", "short"}}), two = panel(1280, 720, {{"Note", "short"}, {"", "x"}});
  const int line = high(two) - high(one);
  const Region broken = panel(1280, 720, {{"Note", note}});
  EXPECT_EQ(high(broken), high(two));
  EXPECT_LT(broken.right, 0.5 * 1280);
  // Lines below follow, and no value has more than five.
  EXPECT_EQ(high(panel(1280, 720, {{"Note", note}, {"Mode", "walk"}})), high(two) + line);
  EXPECT_EQ(high(panel(1280, 720, {{"Note", note + note + note + note}})), high(two) + 3 * line);
  // Where there is no room for all of it, there are fewer.
  std::vector<graphics::StatusLine> many;
  for (int i = 0; i < 6; ++i) many.push_back({"Note", note + note});
  EXPECT_LT(high(panel(480, 300, many)), 220);
}

TEST(GraphicsHud, AValueThatGrowsAndShrinksTakesAndGivesBackLines) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  const auto shown = [&](const std::string& value) {
    hud.set_status({{"Note", value}, {"Mode", "walk"}});
    const auto picture = stage.picture(true);
    return picture;
  };
  const auto before = shown("short");
  const auto meanwhile = shown("a note that is far too long to stand on one line of the panel of so small a window");
  EXPECT_GT(differing(*before, *meanwhile, 6), 1000);
  EXPECT_EQ(differing(*before, *shown("short")), 0);
}

TEST(GraphicsHud, TheBarShowsHowMuchIsDone) {
  const auto bright = [](double share) {
    Stage stage(640, 360);
    fill_with(stage, 0);
    Hud hud(stage.frame);
    hud.set_crosshair(false);
    hud.set_progress(share);
    const auto picture = stage.picture(true);
    int count = 0;
    for (int y = 0; y < 360; ++y) {
      for (int x = 0; x < 640; ++x) count += at(*picture, x, y).b > 180;
    }
    return count;
  };
  EXPECT_EQ(bright(-1), 0);
  const int half = bright(0.5), whole = bright(1.0);
  EXPECT_GT(half, 50);
  EXPECT_NEAR(whole, 2 * half, 0.06 * whole);
}

TEST(GraphicsHud, TextIsWhatIsShown) {
  Stage stage(320, 180);
  Hud hud(stage.frame);
  hud.set_status({{"Mode", "walk"}, {"Speed", "1.4 m/s"}, {"", "loading ahead", Tone::warning}});
  hud.set_message("wall, Door_12");
  hud.set_help({{"Move", ""}, {"W", "forwards"}});
  EXPECT_EQ(hud.text(), "Mode: walk\nSpeed: 1.4 m/s\nloading ahead\nwall, Door_12\n");
  hud.set_detail(Detail::minimal);
  EXPECT_EQ(hud.text(), "Mode: walk\nwall, Door_12\n");
  hud.show_help(true);
  EXPECT_EQ(hud.text(), "wall, Door_12\nMove\nW: forwards\n");
  hud.set_message({});
  EXPECT_EQ(hud.text(), "Move\nW: forwards\n");
  hud.set_detail(Detail::off);
  EXPECT_EQ(hud.text(), "");
}

TEST(GraphicsHud, AButtonIsAtTheLowerLeft) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  hud.set_button("Menu: H");
  const Region button = shown_in(stage);
  EXPECT_LT(button.right, 160);
  EXPECT_LT(button.top, 60);
  const double x = (button.left + button.right) / 640.0 - 1.0, y = (button.bottom + button.top) / 360.0 - 1.0;
  EXPECT_TRUE(hud.button_at(x, y));
  EXPECT_FALSE(hud.button_at(0, 0));
  EXPECT_EQ(hud.text(), "");
  hud.set_help({{"W", "forwards", "forward"}});
  hud.show_help(true);
  (void)stage.picture(true);
  EXPECT_FALSE(hud.button_at(x, y)) << "the help hides it";
  hud.show_help(false);
  hud.set_detail(Detail::minimal);
  EXPECT_EQ(shown_in(stage).pixels, 0);
  EXPECT_FALSE(hud.button_at(x, y));
}

TEST(GraphicsHud, DetailSaysHowMuchIsDrawn) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_status({{"Mode", "walk"}, {"Speed", "1.4 m/s"}, {"Radius", "0.3 m"}, {"Frame", "16.6 ms"}});
  const int full = shown_in(stage).pixels;
  hud.set_detail(Detail::minimal);
  const int minimal = shown_in(stage).pixels;
  hud.set_detail(Detail::off);
  EXPECT_EQ(shown_in(stage).pixels, 0);
  EXPECT_GT(minimal, 100);
  EXPECT_LT(minimal, full / 2);
  // What was set meanwhile is there when it comes back.
  hud.set_status({{"Mode", "fly"}, {"Speed", "1.4 m/s"}, {"Radius", "0.3 m"}, {"Frame", "16.6 ms"}, {"More", "text"}});
  hud.set_detail(Detail::full);
  EXPECT_GT(shown_in(stage).pixels, full);
}

TEST(GraphicsHud, AHintIsSeenInEveryDetailAndFades) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  hud.set_detail(Detail::off);
  hud.set_hint("H: help");
  EXPECT_EQ(hud.text(), "H: help\n");
  const auto without = stage.picture(false);
  const auto darkest = [&] {
    const auto with = stage.picture(true);
    int most = 0;
    for (int y = 0; y < 360; ++y) {
      for (int x = 0; x < 640; ++x) most = std::max(most, at(*without, x, y).distance(at(*with, x, y)));
    }
    return most;
  };
  const int whole = darkest();
  hud.set_hint("H: help", 0.3);
  const int faded = darkest();
  EXPECT_GT(whole, 50);
  EXPECT_GT(faded, 5);
  EXPECT_LT(faded, whole / 2);
  hud.set_hint({});
  EXPECT_EQ(shown_in(stage).pixels, 0);
}

TEST(GraphicsHud, ARecordingIsARedDotAtTheUpperRight) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  hud.set_recording("12.4 m, 34 s");
  EXPECT_EQ(hud.text(), "recording: 12.4 m, 34 s\n");
  const Region mark = shown_in(stage);
  EXPECT_GT(mark.left, 400);
  EXPECT_GT(mark.bottom, 300);
  const auto picture = stage.picture(true);
  int red = 0;
  for (int y = mark.bottom; y < mark.top; ++y) {
    for (int x = mark.left; x < mark.right; ++x) {
      const Pixel p = at(*picture, x, y);
      red += p.r > 150 && p.g < 90 && p.b < 90;
    }
  }
  EXPECT_GT(red, 30);
}

TEST(GraphicsHud, BreaksAMessageIntoLinesOfLikeLengths) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  const auto width = [&](const std::string& text) {
    hud.set_message(text);
    (void)stage.picture(true);
    return hud.panels().at(0).width;
  };
  const std::string sentence = "a sentence that is somewhat too long for the window, by one";
  EXPECT_LT(width(sentence + " more word"), 0.75f * width(sentence));
}

TEST(GraphicsHud, LabelsStandAboveTheirPoints) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  hud.set_labels({{"3.214 m", 200, 100}});
  EXPECT_EQ(hud.text(), "3.214 m\n");
  const Region label = shown_in(stage);
  EXPECT_NEAR(0.5 * (label.left + label.right), 200, 3);
  EXPECT_GE(label.bottom, 100);
  EXPECT_LT(label.bottom, 110);
}

TEST(GraphicsHud, LabelsHideNoOtherLabel) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  const auto height = [&](std::vector<graphics::HudLabel> labels) {
    hud.set_labels(std::move(labels));
    const Region shown = shown_in(stage);
    return shown.top - shown.bottom;
  };
  const graphics::HudLabel narrowest{"narrowest", 200, 100}, second{"B", 210, 95}, third{"A", 208, 102};
  const int one = height({narrowest});
  EXPECT_GE(height({narrowest, second}), 2 * one);
  EXPECT_GE(height({narrowest, second, third}), 3 * one);
}

TEST(GraphicsHud, GoesAwayWithItsObject) {
  Stage stage(640, 360);
  {
    Hud hud(stage.frame);
    hud.set_message("here");
    EXPECT_GT(shown_in(stage).pixels, 100);
  }
  EXPECT_EQ(shown_in(stage).pixels, 0);
}

TEST(GraphicsHud, ChangesWhileAnotherThreadDraws) {
  Stage stage(320, 180);
  stage.viewer.setThreadingModel(osgViewer::Viewer::DrawThreadPerContext);
  Hud hud(stage.frame);
  hud.set_help(many_keys);
  for (int i = 0; i < 60; ++i) {
    hud.set_status({{"Frame", std::to_string(i * 7919)}, {"Place", std::to_string(i * i)}});
    hud.set_message(i % 3 == 0 ? std::string() : "message " + std::to_string(i));
    hud.show_help(i % 10 == 9);
    stage.viewer.frame();
  }
  stage.viewer.stopThreading();
  hud.show_help(false);
  EXPECT_NE(hud.text().find("Frame: " + std::to_string(59 * 7919)), std::string::npos);
}

}  // namespace
}  // namespace roam::test
