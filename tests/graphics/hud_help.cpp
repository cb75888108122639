// The help of the head-up display.

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
