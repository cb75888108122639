// Films that roam view makes.
#include <algorithm>

#include "view_program.h"

namespace {

/// Differences of neighbouring pictures of a film, from 0 to 255: mean over the picture.
std::vector<double> changes(const std::string& film) {
  const ProgramResult log =
      run_program("/usr/bin/ffmpeg",
                  {"-v", "error", "-i", film, "-vf",
                   "format=gray,tblend=all_mode=difference,signalstats,metadata=print:key=lavfi.signalstats.YAVG:"
                   "file=-",
                   "-f", "null", "-"});
  std::vector<double> found;
  const std::string mark = "YAVG=";
  for (std::size_t at = log.out.find(mark); at != std::string::npos; at = log.out.find(mark, at + 1)) {
    found.push_back(std::stod(log.out.substr(at + mark.size())));
  }
  return found;
}

TEST(ViewPath, IsFilmed) {
  View view;
  const std::string path = view.folder.write("p.path", "2 0 0.3\n4.8 0 0.3\n");
  view.run({"--headless", "--size", "160x96", "--path", path, "--record", view.folder.file("film.mp4")});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  const ProgramResult probe =
      run_program("/usr/bin/ffprobe", {"-v", "error", "-show_entries", "stream=width,height:format=duration", "-of",
                                       "default=noprint_wrappers=1", view.folder.file("film.mp4")});
  EXPECT_TRUE(contains(probe.out, "width=160")) << probe.out << probe.err;
  EXPECT_TRUE(contains(probe.out, "height=96"));
  const double seconds = std::stod(probe.out.substr(probe.out.find("duration=") + 9));
  EXPECT_NEAR(seconds, 2.0, 0.2);  // 2.8 m at 1.4 m/s
}

TEST(ViewFilm, OfATurntableTurnsOnceEvenlyAndWithoutTheDisplay) {
  View view;
  view.run({"--headless", "--size", "160x96", "--turntable", "2", "--record", view.folder.file("turn.mp4"), "--json"});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  const std::vector<double> steps = changes(view.folder.file("turn.mp4"));
  ASSERT_EQ(steps.size(), 59u) << "60 pictures";
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  EXPECT_GT(*least, 0.0) << "a picture is repeated";
  EXPECT_LT(*most, 6.0) << "it jumps";
  EXPECT_EQ(all(view.json()["hud"]), "");
}

TEST(ViewFilm, OfAPathRepeatsNoPicture) {
  View view;
  const std::string path = view.folder.write("p.path", "2 0 0.3\n4.8 0 0.3\n");
  view.run(
      {"--headless", "--hud", "off", "--size", "160x96", "--path", path, "--record", view.folder.file("film.gif")});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  const std::vector<double> steps = changes(view.folder.file("film.gif"));
  ASSERT_NEAR(static_cast<double>(steps.size()), 39.0, 2.0);  // 2 s at 20 pictures a second
  EXPECT_GT(*std::min_element(steps.begin(), steps.end()), 0.0);
}

}  // namespace
