// The help of the head-up display.

#include <set>
#include <string>
#include <vector>

#include "graphics/hud.h"
#include "hud_pictures.h"

namespace roam::test {
namespace {

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

/// Pixels of a line's height, where it is on the page that is shown; 0: it is not.
int height_of_line(const Hud& hud, const std::string& name, int width, int height) {
  for (int x = 0; x < width; x += 8) {
    int count = 0;
    for (int y = 0; y < height; ++y) {
      count += hud.help_at((2.0 * x + 1.0) / width - 1.0, (2.0 * y + 1.0) / height - 1.0) == name;
    }
    if (count > 0) return count;
  }
  return 0;
}

TEST(GraphicsHud, HelpHasLegibleLettersInASmallWindowAndPagesForWhatHasNoRoom) {
  std::vector<graphics::HelpLine> lines = many_keys;
  lines.insert(lines.end(), many_keys.begin(), many_keys.end());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].effect.empty()) lines[i].name = std::to_string(i);
  }
  for (const auto& [width, height] : {std::pair(640, 360), std::pair(480, 360), std::pair(300, 200)}) {
    Stage stage(width, height);
    Hud hud(stage.frame);
    hud.set_help(lines);
    hud.show_help(true);
    std::set<std::string> missing;
    for (const auto& line : lines) missing.insert(line.name);
    missing.erase("");
    for (int page = 0; page < 40; ++page) {
      (void)stage.picture(true);
      std::erase_if(missing, [&](const std::string& name) {
        const int shown = height_of_line(hud, name, width, height);
        // Letters of 10 pixels have lines of 15, one or several.
        EXPECT_EQ(shown % 15, 0) << name << ": " << shown;
        return shown >= 15;
      });
      EXPECT_EQ(height_of_line(hud, Hud::help_more, width, height), 15) << "page " << page;
      if (!hud.help_goes_on()) break;
      hud.turn_help(1);
    }
    EXPECT_TRUE(missing.empty()) << width << ": " << missing.size() << ", " << *missing.begin();
    // After the last page the first one follows; before the first there is none.
    hud.turn_help(1);
    (void)stage.picture(true);
    EXPECT_GT(height_of_line(hud, "1", width, height), 0);
    hud.turn_help(-1);
    (void)stage.picture(true);
    EXPECT_GT(height_of_line(hud, "1", width, height), 0);
    // It opens with the first page.
    hud.turn_help(1);
    hud.show_help(false);
    hud.show_help(true);
    (void)stage.picture(true);
    EXPECT_GT(height_of_line(hud, "1", width, height), 0);
  }
}

TEST(GraphicsHud, HelpWithoutAnyRoomIsNotShown) {
  Stage stage(24, 16);
  Hud hud(stage.frame);
  hud.set_help(many_keys);
  hud.show_help(true);
  EXPECT_EQ(shown_in(stage).pixels, 0);
  EXPECT_FALSE(hud.help_goes_on());
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

}  // namespace
}  // namespace roam::test
