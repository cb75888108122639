// Pictures and films on disk.

#include "graphics/capture.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <stdexcept>
#include <string>
#include <utility>

#include "files/mark.h"
#include "graphics/hud.h"
#include "graphics_stage.h"
#include "process/find_program.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;
using graphics::Screenshot;
using graphics::Video;

bool is_marked(const fs::path& file) { return files::marked("").has(files::open_named(file).number()); }

/// A folder of its own, removed afterwards.
struct GraphicsCapture : testing::Test {
  GraphicsCapture() : folder(fs::path(testing::TempDir()) / ("roam-capture-" + std::to_string(getpid()))) {
    fs::create_directories(folder);
  }
  ~GraphicsCapture() override { fs::remove_all(folder); }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  const fs::path folder;
};

template <class Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

osg::ref_ptr<osg::Image> plain_image(int width, int height, unsigned char level) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  std::fill_n(image->data(), image->getTotalSizeInBytes(), level);
  return image;
}

/// What a program says.
std::string output_of(const std::string& command) {
  std::string all;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 256> chunk;
  while (pipe && std::fgets(chunk.data(), chunk.size(), pipe)) all += chunk.data();
  if (pipe) pclose(pipe);
  return all;
}

/// "width,height,frame rate,pixel format,codec,frames" in the order that ffprobe has.
std::string probe(const fs::path& film) {
  return output_of(
      "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
      "stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_read_frames -of csv=p=0 " +
      film.string());
}

bool have_ffmpeg() { return !process::find_program("ffmpeg").empty() && !process::find_program("ffprobe").empty(); }

TEST_F(GraphicsCapture, AScreenshotIsThePictureToThePixel) {
  Stage stage(333, 217, {.quality = graphics::Quality::full});
  stage.add(paint(quad({0, 4, 1}, {1, 0, 0}, {0, 0, 1}), {1, 0.5f, 0, 1}));
  const auto expected = stage.picture(true);
  const fs::path file = folder / "shot.png";
  Screenshot shot(stage.frame, file, true);
  EXPECT_FALSE(shot.done());
  stage.viewer.frame();
  shot.finish();
  EXPECT_TRUE(shot.done());
  const osg::ref_ptr<osg::Image> read = osgDB::readRefImageFile(file.string());
  ASSERT_TRUE(read);
  ASSERT_EQ(read->s(), 333);
  ASSERT_EQ(read->t(), 217);
  EXPECT_EQ(differing(*read, *expected), 0);
  EXPECT_EQ(files(), 1u);
  EXPECT_TRUE(is_marked(file));
}

TEST_F(GraphicsCapture, AScreenshotMayLeaveTheDisplayOut) {
  Stage stage(640, 360);
  graphics::Hud hud(stage.frame);
  hud.set_message("not in every picture");
  Screenshot without(stage.frame, folder / "without.png", false);
  Screenshot with(stage.frame, folder / "with.png", true);
  stage.viewer.frame();
  without.finish();
  with.finish();
  const auto a = osgDB::readRefImageFile((folder / "without.png").string());
  const auto b = osgDB::readRefImageFile((folder / "with.png").string());
  ASSERT_TRUE(a && b);
  EXPECT_EQ(differing(*a, *stage.picture(false)), 0);
  EXPECT_GT(differing(*a, *b, 6), 1000);
}

TEST_F(GraphicsCapture, JpegIsWrittenToo) {
  Stage stage(64, 48);
  Screenshot shot(stage.frame, folder / "shot.jpg", true);
  stage.viewer.frame();
  shot.finish();
  EXPECT_TRUE(is_marked(folder / "shot.jpg"));
  EXPECT_TRUE(osgDB::readRefImageFile((folder / "shot.jpg").string()));
}

TEST_F(GraphicsCapture, AScreenshotOfAThreadedViewerWaitsForItsFrame) {
  Stage stage(64, 48);
  stage.viewer.setThreadingModel(osgViewer::Viewer::DrawThreadPerContext);
  for (int i = 0; i < 5; ++i) {
    Screenshot shot(stage.frame, folder / "shot.png", true);
    stage.viewer.frame();
    EXPECT_EQ(complaint([&] { shot.finish(); }), "");
  }
  stage.viewer.stopThreading();
}

TEST_F(GraphicsCapture, SaysWhyAPictureCannotBeWritten) {
  Stage stage(64, 48);
  EXPECT_NE(complaint([&] { Screenshot(stage.frame, folder / "shot.txt", true); }).find(".png"), std::string::npos);
  Screenshot nowhere(stage.frame, folder / "no" / "such" / "shot.png", true);
  stage.viewer.frame();
  EXPECT_NE(complaint([&] { nowhere.finish(); }).find("make its folder"), std::string::npos);
  // A folder of that name is in the way.
  fs::create_directories(folder / "taken.png" / "inside");
  EXPECT_NE(complaint([&] { graphics::write_image(*plain_image(8, 8, 9), folder / "taken.png"); }).find("taken.png"),
            std::string::npos);
  EXPECT_EQ(files(), 1u);
}

/// Takes pictures of its kind, and throws what nobody expects.
class Thrower : public osgDB::ReaderWriter {
 public:
  Thrower() { supportsExtension("jpeg", "throws"); }
  WriteResult writeImage(const osg::Image&, std::ostream&, const Options*) const override {
    throw std::runtime_error("the plugin is torn");
  }
};

TEST_F(GraphicsCapture, APluginThatThrowsEndsNoProgram) {
  const osg::ref_ptr<Thrower> thrower = new Thrower;
  osgDB::Registry& plugins = *osgDB::Registry::instance();
  const osg::ref_ptr<osgDB::ReaderWriter> usual = plugins.getReaderWriterForExtension("jpeg");
  plugins.removeReaderWriter(usual);
  plugins.addReaderWriter(thrower);
  Stage stage(64, 64);
  Screenshot shot(stage.frame, folder / "shot.jpeg", true);
  stage.viewer.frame();
  const std::string said = complaint([&] { shot.finish(); });
  plugins.removeReaderWriter(thrower);
  plugins.addReaderWriter(usual);
  EXPECT_NE(said.find("the plugin is torn"), std::string::npos) << said;
  EXPECT_NE(said.find("shot.jpeg"), std::string::npos) << said;
}

TEST_F(GraphicsCapture, APictureThatIsTooLargeIsAnErrorThatSaysWhatCanBeDrawn) {
  Stage stage(64, 48, {.samples = 4});
  stage.viewer.getCamera()->setViewport(0, 0, 100'000, 48);
  Screenshot shot(stage.frame, folder / "large.png", true);
  stage.viewer.frame();
  const std::string words = complaint([&] { shot.finish(); });
  EXPECT_NE(words.find("100000 x 48 pixels"), std::string::npos) << words;
  EXPECT_TRUE(shot.done());
  EXPECT_EQ(files(), 0u);
  // Nor does a film get pictures of nothing.
  bool any = false;
  stage.frame.request_picture(true, [&](const osg::ref_ptr<osg::Image>&) { any = true; });
  stage.viewer.frame();
  EXPECT_FALSE(any);

  // The size that it names can be drawn.
  const std::size_t option = words.find("--size ");
  ASSERT_NE(option, std::string::npos) << words;
  int width = 0, height = 0;
  ASSERT_EQ(std::sscanf(words.c_str() + option, "--size %dx%d", &width, &height), 2) << words;
  EXPECT_GE(width, 4096);
  EXPECT_LT(width, 100'000);
  stage.viewer.getCamera()->setViewport(0, 0, width, height);
  const auto named = stage.picture(true);
  ASSERT_TRUE(named);
  EXPECT_EQ(named->s(), width);
  EXPECT_EQ(named->t(), height);

  // And the first size again, as if nothing had been.
  stage.viewer.getCamera()->setViewport(0, 0, 64, 48);
  Stage other(64, 48, {.samples = 4});
  EXPECT_EQ(differing(*stage.picture(true), *other.picture(true)), 0);
}

TEST_F(GraphicsCapture, AScreenshotThatWasMovedFromHasNothingToFinish) {
  Stage stage(64, 48);
  Screenshot first(stage.frame, folder / "shot.png", true);
  Screenshot second(std::move(first));
  EXPECT_TRUE(first.done());  // NOLINT(bugprone-use-after-move): the header says so
  EXPECT_TRUE(first.path().empty());
  EXPECT_EQ(complaint([&] { first.finish(); }), "");
  EXPECT_FALSE(second.done());
  stage.viewer.frame();
  second.finish();
  EXPECT_EQ(files(), 1u);
}

TEST_F(GraphicsCapture, AScreenshotThatIsGivenUpDoesNotHang) {
  Stage stage(64, 48);
  { Screenshot shot(stage.frame, folder / "shot.png", true); }
  stage.viewer.frame();
  EXPECT_EQ(files(), 0u);
}

TEST_F(GraphicsCapture, AFilmHasTheRightPictures) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  const fs::path file = folder / "film.mp4";
  Video video(file, 320, 180, 30);
  for (int i = 0; i < 45; ++i) video.add(plain_image(320, 180, static_cast<unsigned char>(5 * i)));
  EXPECT_EQ(video.frames(), 45);
  EXPECT_FALSE(fs::exists(file));
  video.finish();
  EXPECT_EQ(probe(file), "h264,320,180,yuv420p,30/1,45\n");
  EXPECT_EQ(files(), 1u);
}

TEST_F(GraphicsCapture, OddSizesAreFilledUp) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  Video video(folder / "film.mp4", 321, 181, 25);
  for (int i = 0; i < 3; ++i) video.add(plain_image(321, 181, 128));
  video.finish();
  EXPECT_EQ(probe(folder / "film.mp4"), "h264,322,182,yuv420p,25/1,3\n");
}

TEST_F(GraphicsCapture, AFilmRunsAsTimeDid) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  Video video(folder / "film.mp4", 64, 64, 20);
  // Slower than the film, then faster.
  for (const double seconds : {0.0, 0.2, 0.4, 0.41, 0.42, 0.5}) video.add(plain_image(64, 64, 50), seconds);
  EXPECT_EQ(video.frames(), 11);
  video.finish();
  EXPECT_EQ(probe(folder / "film.mp4"), "h264,64,64,yuv420p,20/1,11\n");
}

TEST_F(GraphicsCapture, AFilmIsAsItsExtensionSays) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  for (const auto& [name, expected] : {std::pair{"film.mp4", "h264,64,48,yuv420p,20/1,6\n"},
                                       {"film.webm", "vp9,64,48,yuv420p,20/1,6\n"},
                                       {"film.gif", "gif,64,48,bgra,20/1,6\n"},
                                       {"film.WEBP", ""}}) {
    Video video(folder / name, 64, 48, 20);
    osg::ref_ptr<osg::Image> image = plain_image(64, 48, 40);
    for (int i = 0; i < 6; ++i) {
      image = plain_image(64, 48, static_cast<unsigned char>(30 * i));
      // Orange above.
      for (unsigned x = 0; x < 64; ++x) image->data(x, 47)[0] = 255, image->data(x, 47)[2] = 0;
      video.add(image);
    }
    video.finish();
    EXPECT_TRUE(is_marked(folder / name)) << name;
    if (*expected != '\0') {
      EXPECT_EQ(probe(folder / name), expected);
      continue;
    }
    // ffmpeg does not read its own animations: the chunks of their pictures are counted.
    std::ifstream in(folder / name, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::size_t pictures = 0;
    for (std::size_t k = bytes.find("ANMF"); k != std::string::npos; k = bytes.find("ANMF", k + 4)) ++pictures;
    EXPECT_EQ(bytes.substr(8, 4), "WEBP");
    std::uint32_t stated = 0;
    std::memcpy(&stated, bytes.data() + 4, sizeof stated);
    EXPECT_EQ(stated + 8, bytes.size()) << "the size that RIFF states";
    EXPECT_EQ(pictures, 6u);
  }
}

TEST_F(GraphicsCapture, AFilmOfEvenStepsNeitherRepeatsNorDropsAPicture) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  Video video(folder / "film.gif", 16, 16, 20);
  double seconds = 0.0;
  for (int i = 0; i < 200; ++i) {
    video.add(plain_image(16, 16, 50), seconds);
    EXPECT_EQ(video.frames(), i + 1);
    for (int k = 0; k < 3; ++k) seconds += 1.0 / 60.0;
  }
}

TEST_F(GraphicsCapture, FilmsAreUprightAndKeepTheirColours) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  osg::ref_ptr<osg::Image> image = plain_image(64, 64, 40);
  // Orange above.
  for (unsigned y = 32; y < 64; ++y) {
    for (unsigned x = 0; x < 64; ++x) {
      unsigned char* p = image->data(x, y);
      p[0] = 230, p[1] = 120, p[2] = 20;
    }
  }
  Video video(folder / "film.mp4", 64, 64, 20);
  for (int i = 0; i < 4; ++i) video.add(image);
  video.finish();
  output_of("ffmpeg -v error -i " + (folder / "film.mp4").string() +
            " -frames:v 1 -vf scale=in_color_matrix=bt709 -update 1 " + (folder / "frame.bmp").string());
  const auto frame = osgDB::readRefImageFile((folder / "frame.bmp").string());
  ASSERT_TRUE(frame);
  EXPECT_LT(at(*frame, 32, 50).distance({230, 120, 20}), 18) << at(*frame, 32, 50);
  EXPECT_LT(at(*frame, 32, 14).distance({40, 40, 40}), 12) << at(*frame, 32, 14);
}

TEST_F(GraphicsCapture, SaysWhyAFilmCannotBeMade) {
  EXPECT_NE(complaint([&] { Video(folder / "film.avi", 64, 64, 20); }).find(".mp4"), std::string::npos);
  EXPECT_NE(complaint([&] { Video(folder / "film.mp4", 8, 64, 20); }).find("[16, 8192]"), std::string::npos);
  EXPECT_NE(complaint([&] { Video(folder / "film.mp4", 64, 64, 0); }).find("[1, 240]"), std::string::npos);

  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const std::string absent = complaint([&] { Video(folder / "film.mp4", 64, 64, 20); });
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(absent.find("apt-get install ffmpeg"), std::string::npos) << absent;
  EXPECT_EQ(files(), 0u);
}

/// Puts a shell script in the place of ffmpeg while it exists.
struct InPlaceOfFfmpeg {
  InPlaceOfFfmpeg(const fs::path& bin, const std::string& script) : path(std::getenv("PATH")) {
    fs::create_directories(bin);
    std::ofstream(bin / "ffmpeg") << "#!/bin/sh\n" << script;
    fs::permissions(bin / "ffmpeg", fs::perms::owner_all);
    setenv("PATH", (bin.string() + ":" + path).c_str(), 1);
  }
  ~InPlaceOfFfmpeg() { setenv("PATH", path.c_str(), 1); }
  const std::string path;
};

TEST_F(GraphicsCapture, SaysWhatFfmpegSaidLast) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  const InPlaceOfFfmpeg failing(folder / "bin", "echo out of luck >&2\nexit 1\n");
  const std::string words = complaint([&] {
    Video video(folder / "film.mp4", 64, 64, 20);
    for (int i = 0; i < 100; ++i) video.add(plain_image(64, 64, 50));
    video.finish();
  });
  EXPECT_NE(words.find("out of luck"), std::string::npos) << words;
}

TEST_F(GraphicsCapture, AFilmIsWaitedForWhileFfmpegWritesIt) {
  const InPlaceOfFfmpeg slow(folder / "bin",
                             "cat > /dev/null\n"
                             "for i in 1 2 3 4 5 6 7 8 9 10; do sleep 0.5; echo $i >&3; done\n");
  Video video(folder / "film.webp", 64, 64, 20);
  video.add(plain_image(64, 64, 50));
  EXPECT_EQ(complaint([&] { video.finish(std::chrono::seconds(3)); }), "");
  EXPECT_EQ(fs::file_size(folder / "film.webp"), 21u);
}

TEST_F(GraphicsCapture, AFilmIsGivenUpIfFfmpegDoesNothingOrMayNotGoOn) {
  // A large picture does not fit into a pipe or a socket that nobody reads.
  for (const auto& [script, size, urgent] : {std::tuple{"cat > /dev/null\nexec sleep 300\n", 64, false},
                                             {"exec sleep 300\n", 4096, false},
                                             {"cat > /dev/null\nwhile :; do :; done\n", 64, true},
                                             {"while :; do :; done\n", 4096, true}}) {
    const InPlaceOfFfmpeg idle(folder / "bin", script);
    Video video(folder / "film.webp", size, size, 20);
    video.add(plain_image(size, size, 50));
    int asked = 0;
    const auto is_urgent = [&, comes = urgent] { return comes && ++asked > 2; };
    const std::string words = complaint([&] { video.finish(std::chrono::milliseconds(500), is_urgent); });
    EXPECT_NE(words.find("it did not end"), std::string::npos) << words;
  }
  EXPECT_EQ(files(), 1u) << "only the folder of the program";
}

TEST_F(GraphicsCapture, AFilmIsNotWrittenWhereALinkInItsPlaceLeads) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  const fs::path letter = folder / "letter.txt";
  std::ofstream(letter) << "precious";
  // As whoever may write to the folder: replaces the film before ffmpeg opens it.
  const InPlaceOfFfmpeg replacing(folder / "bin", "for film in " + folder.string() + "/*.unfinished; do ln -sf " +
                                                      letter.string() + " \"$film\"; done\nexec " +
                                                      process::find_program("ffmpeg").string() + " \"$@\"\n");
  static_cast<void>(complaint([&] {
    Video video(folder / "film.mp4", 64, 64, 20);
    for (int i = 0; i < 5; ++i) video.add(plain_image(64, 64, 50));
    video.finish();
  }));
  EXPECT_EQ(fs::file_size(letter), 8u) << "something was written through the link";
}

TEST_F(GraphicsCapture, AFilmThatCannotBeWrittenIsRefusedAtOnce) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  const std::string words = complaint([&] { Video(folder / "no" / "such" / "film.mp4", 64, 64, 20); });
  EXPECT_NE(words.find("No such file or directory"), std::string::npos) << words;
}

TEST_F(GraphicsCapture, AFilmThatIsDroppedOrEmptyLeavesNothing) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  {
    Video dropped(folder / "film.mp4", 64, 64, 20);
    for (int i = 0; i < 5; ++i) dropped.add(plain_image(64, 64, 50));
  }
  EXPECT_EQ(files(), 0u);
  {
    Video empty(folder / "film.mp4", 64, 64, 20);
    EXPECT_NE(complaint([&] { empty.finish(); }), "");
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(GraphicsCapture, APictureOfAnotherSizeIsRefused) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg and ffprobe are not on the PATH";
  Video video(folder / "film.mp4", 64, 64, 20);
  EXPECT_NE(complaint([&] { video.add(plain_image(64, 65, 50)); }).find("64 x 65"), std::string::npos);
}

}  // namespace
}  // namespace roam::test
