// The head-up display: what it says, that it can be read, that it fits.

#include "graphics/hud.h"

#include <algorithm>
#include <osg/Texture2D>
#include <set>
#include <string>

#include "graphics_stage.h"

namespace roam::test {
namespace {

using graphics::Detail;
using graphics::Hud;
using graphics::Tone;

/// Relative luminance, as the Web Content Accessibility Guidelines 2 define it.
double luminance(const Pixel& p) {
  const auto linear = [](int level) {
    const double c = level / 255.0;
    return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(p.r) + 0.7152 * linear(p.g) + 0.0722 * linear(p.b);
}

double contrast(const Pixel& a, const Pixel& b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

struct Region {
  int left = 0, bottom = 0, right = 0, top = 0;  // right and top: one beyond
  int pixels = 0;
};

/// The smallest rectangle of all pixels that the display changes.
Region changed(const osg::Image& without, const osg::Image& with) {
  Region r{without.s(), without.t(), 0, 0, 0};
  for (int y = 0; y < without.t(); ++y) {
    for (int x = 0; x < without.s(); ++x) {
      if (at(without, x, y).distance(at(with, x, y)) < 6) continue;
      r.left = std::min(r.left, x);
      r.right = std::max(r.right, x + 1);
      r.bottom = std::min(r.bottom, y);
      r.top = std::max(r.top, y + 1);
      ++r.pixels;
    }
  }
  return r;
}

Region shown_in(Stage& stage) {
  const auto without = stage.picture(false);
  return changed(*without, *stage.picture(true));
}

/// A wall of the photogrammetric kind, which is drawn as it is: one grey all over the picture.
void fill_with(Stage& stage, unsigned char level) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  std::fill_n(image->data(), 3, level);
  osg::ref_ptr<osg::Geometry> wall = quad({0, 1, 0}, {9, 0, 0}, {0, 0, 9});
  wall->setTexCoordArray(0, new osg::Vec2Array(4));
  const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
  wall->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
  stage.add(wall);
}

/// Contrast of the lightest and the darkest in a region: letter and panel.
double contrast_within(const osg::Image& picture, const Region& r) {
  Pixel light = at(picture, r.left, r.bottom), dark = light;
  for (int y = r.bottom; y < r.top; ++y) {
    for (int x = r.left; x < r.right; ++x) {
      const Pixel p = at(picture, x, y);
      if (luminance(p) > luminance(light)) light = p;
      if (luminance(p) < luminance(dark)) dark = p;
    }
  }
  return contrast(light, dark);
}

const std::vector<graphics::HelpLine> many_keys = [] {
  std::vector<graphics::HelpLine> keys;
  for (int section = 0; section < 4; ++section) {
    keys.push_back({"Section " + std::to_string(section), ""});
    for (int i = 0; i < 9; ++i) keys.push_back({"Shift+Ctrl+" + std::to_string(i), "what this key does, said shortly"});
  }
  return keys;
}();

TEST(GraphicsHud, CanBeReadOnWhiteAndOnBlack) {
  for (const unsigned char level : {255, 128, 0}) {
    for (const Tone tone : {Tone::info, Tone::warning}) {
      Stage stage(640, 360);
      fill_with(stage, level);
      Hud hud(stage.frame);
      hud.set_crosshair(false);
      hud.set_status({{"", "HHHHHHHH", tone}});
      const auto without = stage.picture(false);
      const auto with = stage.picture(true);
      ASSERT_EQ(at(*without, 320, 180), (Pixel{level, level, level}));
      const Region panel = changed(*without, *with);
      // The panel's inside, without its soft edge.
      const Region inside{panel.left + 4, panel.bottom + 4, panel.right - 4, panel.top - 4, 0};
      EXPECT_GT(contrast_within(*with, inside), 7.0) << int(level);
    }
  }
}

TEST(GraphicsHud, LabelsAndHelpCanBeReadToo) {
  Stage stage(1280, 720);
  fill_with(stage, 255);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  hud.set_status({{"HHHHHHHH", ""}});
  const Region label = shown_in(stage);
  EXPECT_GT(contrast_within(*stage.picture(true), {label.left + 4, label.bottom + 4, label.right - 4, label.top - 4}),
            4.5);
  hud.set_status({});
  hud.set_help({{"", "HHHHHHHHHHHH"}, {"H", "HHHHHHHHHHHH"}});
  hud.show_help(true);
  const Region help = shown_in(stage);
  EXPECT_GT(contrast_within(*stage.picture(true), {help.left + 6, help.bottom + 6, help.right - 6, help.top - 6}), 7.0);
}

TEST(GraphicsHud, TheCrosshairIsSeenOnWhiteAndOnBlack) {
  for (const unsigned char level : {255, 0}) {
    Stage stage(640, 360);
    fill_with(stage, level);
    Hud hud(stage.frame);
    const Region cross = shown_in(stage);
    EXPECT_GT(cross.pixels, 10) << int(level);
    EXPECT_LT(cross.right - cross.left, 24);
    EXPECT_NEAR(0.5 * (cross.left + cross.right), 320, 1);
    EXPECT_NEAR(0.5 * (cross.bottom + cross.top), 180, 1);
    EXPECT_GT(contrast_within(*stage.picture(true), cross), 3.0);
    hud.set_crosshair(false);
    EXPECT_EQ(shown_in(stage).pixels, 0);
  }
}

TEST(GraphicsHud, HelpFitsTheWindow) {
  for (const auto& [width, height] :
       {std::pair{640, 360}, std::pair{1920, 1080}, std::pair{480, 800}, std::pair{480, 360}, std::pair{300, 200}}) {
    Stage stage(width, height);
    Hud hud(stage.frame);
    hud.set_help(many_keys);
    hud.show_help(true);
    const Region help = shown_in(stage);
    EXPECT_GT(help.pixels, width * height / 12);
    EXPECT_GE(help.left, 3) << width;
    EXPECT_GE(help.bottom, 3) << width;
    EXPECT_LE(help.right, width - 3) << width;
    EXPECT_LE(help.top, height - 3) << width;
  }
}

/// Pixels of the help's text, which is light on its dark panel; all of it, or that of the headings, which is blue.
int letters_of(const std::vector<graphics::HelpLine>& lines, int width, int height) {
  Stage stage(width, height);
  fill_with(stage, 0);
  Hud hud(stage.frame);
  hud.set_help(lines);
  hud.show_help(true);
  const auto picture = stage.picture(true);
  int count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) count += at(*picture, x, y).g > 120;
  }
  return count;
}

TEST(GraphicsHud, HelpShowsItsLastLinesInASmallWindowToo) {
  const std::vector<graphics::HelpLine> but_last(many_keys.begin(), many_keys.end() - 1);
  EXPECT_GT(letters_of(many_keys, 480, 360), letters_of(but_last, 480, 360) + 50);
}

TEST(GraphicsHud, HelpThatHasNoRoomSaysSoInsteadOfBeingCut) {
  // Only the first lines are there, whatever follows, and what is shown is not empty.
  std::vector<graphics::HelpLine> more = many_keys;
  more.push_back({"Section 4", ""});
  more.push_back({"Shift+Ctrl+9", "what this key does, said shortly"});
  const int letters = letters_of(many_keys, 300, 200);
  EXPECT_EQ(letters, letters_of(more, 300, 200));
  EXPECT_GT(letters, 500);
  EXPECT_EQ(letters_of(many_keys, 24, 16), 0);
}

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
  // Lines below follow, and no value has more than three.
  EXPECT_EQ(high(panel(1280, 720, {{"Note", note}, {"Mode", "walk"}})), high(two) + line);
  EXPECT_EQ(high(panel(1280, 720, {{"Note", note + note + note + note}})), high(two) + line);
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

TEST(GraphicsHud, WarningsDifferFromInfos) {
  const auto draw = [](Tone tone) {
    Stage stage(640, 360);
    Hud hud(stage.frame);
    hud.set_message("opening 0.62 m, body 0.60 m", tone);
    return stage.picture(true);
  };
  const auto info = draw(Tone::info), warning = draw(Tone::warning);
  int amber_in_info = 0, amber_in_warning = 0;
  for (int y = 0; y < 360; ++y) {
    for (int x = 0; x < 640; ++x) {
      const auto amber = [&](const Pixel& p) { return p.r > 180 && p.b < 110; };
      amber_in_info += amber(at(*info, x, y));
      amber_in_warning += amber(at(*warning, x, y));
    }
  }
  EXPECT_EQ(amber_in_info, 0);
  EXPECT_GT(amber_in_warning, 50);
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

/// The height of the picture where `name` is, seen from its left part; -2: nowhere.
double height_where(const Hud& hud, const std::string& name) {
  for (double y = -0.99; y < 1.0; y += 0.01) {
    for (double x = -0.9; x < 0.9; x += 0.02) {
      if (hud.help_at(x, y) == name) return y;
    }
  }
  return -2.0;
}

TEST(GraphicsHud, HelpSaysWhichLineIsAtAPoint) {
  for (const auto& [width, height] : {std::pair(1280, 720), std::pair(480, 360)}) {
    Stage stage(width, height);
    Hud hud(stage.frame);
    std::vector<graphics::HelpLine> lines = many_keys;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      if (!lines[i].effect.empty()) lines[i].name = std::to_string(i);
    }
    hud.set_help(lines);
    (void)stage.picture(true);
    EXPECT_EQ(height_where(hud, "1"), -2.0) << "it is not open";
    hud.show_help(true);
    const auto before = stage.picture(true);
    const double first = height_where(hud, "1"), second = height_where(hud, "2");
    EXPECT_GT(first, second);
    EXPECT_GT(second, -1.0);
    EXPECT_EQ(hud.help_at(-0.999, 0.999), "");
    hud.set_help_focus("1");
    const auto focused = stage.picture(true);
    // The row of the first line has another colour now, that of the second does not.
    const auto changes = [&](double y) {
      int count = 0;
      const int row = static_cast<int>(0.5 * (y + 1.0) * height);
      for (int x = 0; x < width; ++x) count += luminance(at(*before, x, row)) != luminance(at(*focused, x, row));
      return count;
    };
    EXPECT_GT(changes(first + 4.0 / height), 20);
    EXPECT_EQ(changes(second + 4.0 / height), 0);
    hud.show_help(false);
    (void)stage.picture(true);
    EXPECT_EQ(height_where(hud, "1"), -2.0);
  }
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

TEST(GraphicsHud, GoesAwayWithItsObject) {
  Stage stage(640, 360);
  {
    Hud hud(stage.frame);
    hud.set_message("here");
    EXPECT_GT(shown_in(stage).pixels, 100);
  }
  EXPECT_EQ(shown_in(stage).pixels, 0);
}

/// A picture of text alone: light letters on a dark panel, before black.
osg::ref_ptr<osg::Image> letters(const std::string& words) {
  Stage stage(1280, 720);
  fill_with(stage, 0);
  Hud hud(stage.frame);
  hud.set_crosshair(false);
  hud.set_status({{"", words}});
  return stage.picture(true);
}

TEST(GraphicsHud, EachLetterLiesOnWholePixels) {
  const auto picture = letters("llllllllllllllll");
  // In a row through the middle of the letters, each has one full column, and the same levels beside it.
  std::vector<int> full(720);
  std::vector<std::set<int>> others(720);
  for (int y = 0; y < 720; ++y) {
    for (int x = 0; x < 640; ++x) {
      const int level = at(*picture, x, y).g;
      full[static_cast<std::size_t>(y)] += level > 250;
      if (level > 20 && level <= 250) others[static_cast<std::size_t>(y)].insert(level);
    }
  }
  const auto row = std::max_element(full.begin(), full.end());
  EXPECT_EQ(*row, 16);
  EXPECT_LE(others[static_cast<std::size_t>(row - full.begin())].size(), 2u);
}

TEST(GraphicsHud, OnlyLettersAreLight) {
  // Between the words there is nothing but panel: no texel of another letter.
  const auto picture = letters("a" + std::string(40, ' ') + "a");
  const auto lit = [&](int x) {
    int count = 0;
    for (int y = 600; y < 720; ++y) count += at(*picture, x, y).g > 40;
    return count;
  };
  std::vector<int> columns;
  for (int x = 0; x < 640; ++x) {
    if (lit(x) > 0) columns.push_back(x);
  }
  ASSERT_GE(columns.size(), 10u);
  EXPECT_LE(columns.size(), 24u);
  EXPECT_GT(columns.back() - columns.front(), 150);
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
