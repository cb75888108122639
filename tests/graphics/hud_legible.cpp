// Whether the head-up display can be read, whatever is behind it.

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "graphics/hud.h"
#include "graphics/lettering.h"
#include "hud_pictures.h"

namespace roam::test {
namespace {

using graphics::Tone;

double contrast(const Pixel& a, const Pixel& b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
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

TEST(GraphicsHud, KeepsAUnitWithItsNumber) {
  const graphics::Look look{.size = 14};
  const std::string words = "ahead RoomWindow_01, 13.52 m";
  const float width = graphics::width_of(words, look) - 2.0f;
  EXPECT_EQ(graphics::break_lines(words, look, width), (std::vector<std::string>{"ahead RoomWindow_01,", "13.52 m"}));
  EXPECT_EQ(graphics::break_lines("13.52 m", look, 30), (std::vector<std::string>{"13.52", "m"})) << "too narrow";
}

TEST(GraphicsHud, ShortensANameInItsMiddle) {
  const graphics::Look look{.size = 14};
  const std::string name = "aws_robomaker_residential_RoomWindow_01";
  EXPECT_EQ(graphics::shorten_name(name, look, graphics::width_of(name, look)), name);
  for (const float width : {60.0f, 120.0f, 200.0f}) {
    const std::string a = graphics::shorten_name(name, look, width);
    EXPECT_LE(graphics::width_of(a, look), width);
    EXPECT_GT(graphics::width_of(a, look), width - 20.0f) << "no shorter than it has to be: " << a;
    const std::size_t cut = a.find("…");
    ASSERT_NE(cut, std::string::npos) << a;
    EXPECT_EQ(a.substr(0, cut), name.substr(0, cut));
    EXPECT_TRUE(name.ends_with(a.substr(cut + std::string("…").size()))) << a;
    EXPECT_NE(a, graphics::shorten_name("aws_robomaker_residential_RoomWindow_02", look, width));
    EXPECT_TRUE(graphics::shorten(name, look, width).ends_with("…"));
  }
  // Between whole characters.
  const std::string cut = graphics::shorten_name("ΑΒΓΔΕΖΗΘΙΚΛΜ", look, 50.0f);
  EXPECT_TRUE(cut.starts_with("ΑΒ") && cut.ends_with("Μ")) << cut;
  EXPECT_EQ(graphics::shorten_name(name, look, 1.0f), "…");
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

}  // namespace
}  // namespace roam::test
