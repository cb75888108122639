// What is written to a disk that is full, or beyond a limit of the system: a sentence, a status, and no half of a file.
#include <gtest/gtest.h>

#include "cli_scenes.h"
#include "interrupted_walk.h"
#include "messages.h"
#include "program.h"

namespace {

namespace fs = std::filesystem;

class FullDisk : public testing::Test {
 protected:
  void SetUp() override {
    scene_ = folder_.write("floor.obj", "v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nf 1 2 3 4\n");
    fs::create_directories(folder_.file("disk"));
    setenv("XDG_CONFIG_HOME", folder_.file("config").c_str(), 1);
  }
  /// Runs the program in a world where the folder "disk" is a disk of 64 kB, of which so many are full; then lists what
  /// is there.
  [[nodiscard]] ProgramResult run(const std::string& arguments, int full = 62) const {
    return run_program("/bin/sh", {"-c", "exec unshare -rm /bin/sh -c '" + mount() + " && dd if=/dev/zero of=" +
                                             folder_.file("disk/filler") + " bs=1k count=" + std::to_string(full) +
                                             " 2>/dev/null; " ROAM_PROGRAM " " + arguments + "; status=$?; ls " +
                                             folder_.file("disk") + "; exit $status'"});
  }
  void expect_told(const std::string& arguments, const std::string& why, int full = 62) const {
    const ProgramResult result = run(arguments, full);
    EXPECT_EQ(result.status, 1) << arguments << result.err;
    EXPECT_TRUE(contains(result.err, why)) << result.err;
    // The report of a session that has ended, and what is on the disk.
    EXPECT_TRUE(result.out == "filler\n" || result.out.ends_with("\nfiller\n")) << result.out;
  }
  [[nodiscard]] bool can_mount() const {
    return run_program("/bin/sh", {"-c", "exec unshare -rm /bin/sh -c '" + mount() + "'"}).status == 0;
  }
  [[nodiscard]] std::string mount() const { return "mount -t tmpfs -o size=64k none " + folder_.file("disk"); }

  const TestFolder folder_;
  std::string scene_;
};

TEST_F(FullDisk, IsSaidOfPicturesAndFilms) {
  if (!can_mount()) GTEST_SKIP() << "no disk can be mounted here";
  const std::string view = "view " + scene_ + " --headless --size 640x480 --mode fly ";
  expect_told(view + "--screenshot " + folder_.file("disk/shot.png"), "shot.png: No space left on device; make room");
  expect_told(view + "--time 0.5 --record " + folder_.file("disk/film.mp4"), "the disk is full: make room");
  expect_told("make gallery -o " + folder_.file("disk/gallery.ply"), "gallery.ply: No space left on device; make room");
}

TEST_F(FullDisk, IsSaidOfAFilmWhoseIndexFindsNoRoom) {
  if (!can_mount()) GTEST_SKIP() << "no disk can be mounted here";
  const std::string film = " --headless --size 320x240 --mode fly --turntable 1 --record ";
  ASSERT_EQ(run_program("/bin/sh", {"-c", ROAM_PROGRAM " view " + scene_ + film + folder_.file("film.mp4")}).status, 0);
  const auto pages = static_cast<int>((fs::file_size(folder_.file("film.mp4")) - 1) / 4096);
  expect_told("view " + scene_ + film + folder_.file("disk/film.mp4"), "the disk is full: make room", 64 - 4 * pages);
}

TEST_F(FullDisk, CostsNoOutputOnAnotherDisk) {
  if (!can_mount()) GTEST_SKIP() << "no disk can be mounted here";
  const ProgramResult result =
      run("view " + scene_ + " --headless --size 320x240 --mode fly --time 0.5 --json --record " +
          folder_.file("disk/film.mp4") + " --trace " + folder_.file("t.csv"));
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "the disk is full: make room")) << result.err;
  EXPECT_TRUE(fs::exists(folder_.file("t.csv"))) << result.err;
  EXPECT_TRUE(contains(result.out, "\"" + folder_.file("t.csv") + "\"")) << result.out;
  EXPECT_FALSE(contains(result.out, "\"" + folder_.file("disk/film.mp4") + "\"")) << result.out;
  const ProgramResult picture = run("view " + scene_ + " --headless --size 640x480 --mode fly --screenshot " +
                                    folder_.file("disk/shot.png") + " --trace " + folder_.file("u.csv"));
  EXPECT_EQ(picture.status, 1);
  EXPECT_TRUE(contains(picture.err, "shot.png: No space left on device")) << picture.err;
  EXPECT_FALSE(contains(picture.err, "was not written")) << picture.err;
  EXPECT_TRUE(fs::exists(folder_.file("u.csv"))) << picture.err;
}

TEST_F(FullDisk, LeavesATraceOfBefore) {
  const std::string trace = folder_.write("disk/t.csv", "step,t,x,y,z,of before");
  const ProgramResult result = run_program(
      "/bin/sh", {"-c", "ulimit -f 20; exec " ROAM_PROGRAM " walk " + scene_ + " --wander 60 --trace " + trace});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_TRUE(contains(result.err, "t.csv: File too large")) << result.err;
  EXPECT_EQ(folder_.read("disk/t.csv"), "step,t,x,y,z,of before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.file("disk")), fs::directory_iterator()), 1);
}

TEST_F(FullDisk, IsSaidOfAWalkThatIsInterrupted) {
  const std::string closed = folder_.write("closed.obj", room_obj());  // a walk leaves an open scene at last
  const ProgramResult result =
      interrupted_walk("/bin/sh", {"-c", "ulimit -f 2; exec " ROAM_PROGRAM " walk " + closed +
                                             " --wander 1e9 --picture " + folder_.file("disk/way.svg")});
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_TRUE(result.out.starts_with("INTERRUPTED after ")) << result.out;
  EXPECT_TRUE(contains(result.err, "way.svg: File too large")) << result.err;
}

TEST_F(FullDisk, IsLikeALimitOfTheSystem) {
  const ProgramResult result = run_program(
      "/bin/sh", {"-c", "ulimit -f 2; exec " ROAM_PROGRAM " view " + scene_ +
                            " --headless --size 640x480 --mode fly --screenshot " + folder_.file("disk/shot.png")});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_TRUE(contains(result.err, "shot.png: File too large")) << result.err;
  const ProgramResult film = run_program(
      "/bin/sh", {"-c", "ulimit -f 2; exec " ROAM_PROGRAM " view " + scene_ +
                            " --headless --size 640x480 --mode fly --time 0.5 --record " + folder_.file("disk/f.mp4")});
  EXPECT_EQ(film.status, 1) << film.err;
  EXPECT_TRUE(
      contains(film.err, "could not make the film " + folder_.file("disk/f.mp4") + ": it was ended: File size limit"))
      << film.err;
  EXPECT_TRUE(fs::is_empty(folder_.file("disk")));
}

}  // namespace
