// Ctrl-C and SIGTERM end every verb soon, whatever it does, and leave no process and no unfinished file.

#include "cli/interrupt.h"

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/stat.h>

#include <csignal>
#include <set>
#include <thread>

#include "environment_variable.h"
#include "program.h"

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Arguments = std::vector<std::string>;

/// A second and, for a machine that is busy, more.
constexpr double soon = 6.0;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Files of a folder that no user asked for.
std::vector<std::string> unfinished_in(const std::string& folder) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".unfinished") found.push_back(entry.path().string());
  }
  return found;
}

class Interrupt : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    // What a program leaves behind becomes a child of this one.
    ASSERT_EQ(prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
    shared_ = new TestFolder;
    scene_ = shared_->file("terrain.ply");
    ASSERT_EQ(run_program(ROAM_PROGRAM, {"make", "terrain", "-o", scene_, "--triangles", "2M"}).status, 0);
  }
  static void TearDownTestSuite() { delete shared_; }

  void SetUp() override {
    setenv("XDG_CONFIG_HOME", folder_.file("config").c_str(), 1);
    setenv("TMPDIR", folder_.file("").c_str(), 1);
    unsetenv("ROAM_READER");
  }
  void TearDown() override {
    EXPECT_GT(interrupted_, 0) << "nothing was interrupted: make the job longer";
    unsetenv("TMPDIR");
  }

  /// Starts the program, sends the signal after so many seconds, and looks at what is left. A fast machine may be done
  /// before.
  void interrupt(const Arguments& arguments, double after, int signal, int times = 1, double longest = soon) {
    SCOPED_TRACE(arguments[0] + ", signal " + std::to_string(signal) + " after " + std::to_string(after) + " s");
    std::vector<char*> argv{const_cast<char*>(ROAM_PROGRAM)};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    // Never written to: who reads from it waits.
    int input[2];
    ASSERT_EQ(::pipe2(input, O_CLOEXEC), 0);
    const std::string log = folder_.file("log");
    posix_spawn_file_actions_adddup2(&files, input[0], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    pid_t program = 0;
    ASSERT_EQ(posix_spawn(&program, ROAM_PROGRAM, &files, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&files);

    int status = 0;
    const auto start = Clock::now();
    bool ended = false;
    const auto waits = [&] { return since(start) < after || (!awaited_.empty() && !fs::exists(awaited_)); };
    while (waits() && !ended) {
      ended = ::waitpid(program, &status, WNOHANG) == program;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ended = ended || ::waitpid(program, &status, WNOHANG) == program;
    const bool done = ended;
    const auto sent = Clock::now();
    for (int i = 0; i < times && !done; ++i) {
      ASSERT_EQ(::kill(program, signal), 0);
      // Each is a signal of its own.
      if (i + 1 < times) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    bool sent_again = again_ == 0.0;
    while (!ended && since(sent) < 10.0 * soon) {
      for (int i = 0; i < times && !sent_again && since(sent) > again_; ++i) {
        ::kill(program, signal);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        sent_again = i + 1 == times;
      }
      ended = ::waitpid(program, &status, WNOHANG) == program;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (!ended) {
      ::kill(program, SIGKILL);
      ::waitpid(program, &status, 0);
    }
    ::close(input[0]);
    ::close(input[1]);
    interrupted_ += done || status == 0 ? 0 : 1;
    EXPECT_LT(since(sent), longest);
    // Orderly, or as the signal does it.
    const bool in_order = WIFEXITED(status) && WEXITSTATUS(status) == 128 + signal;
    const bool may_be_done = done || !awaited_.empty();
    EXPECT_TRUE((may_be_done && WIFEXITED(status) && WEXITSTATUS(status) == 0) || in_order ||
                (WIFSIGNALED(status) && WTERMSIG(status) == signal))
        << status << ": " << folder_.read("log");
    expect_no_child();
    for (const std::string& file : unfinished_in(folder_.file(""))) ADD_FAILURE() << file << " is left";
  }

  /// At several moments, by both signals.
  void interrupt(const Arguments& arguments) {
    for (const double after : {0.1, 0.7, 2.0}) interrupt(arguments, after, after < 0.5 ? SIGTERM : SIGINT);
  }

  static const std::string& scene() { return scene_; }

  /// A drawing that takes too long is cancelled.
  void expect_drawn_or_told() const {
    const std::string log = folder_.read("log");
    const bool told = log.find("way.svg was not drawn: Ctrl-C came before") != std::string::npos;
    EXPECT_TRUE(told || fs::exists(folder_.file("way.svg")) || log.find("roam: cancelled") != std::string::npos) << log;
  }

  TestFolder folder_;
  fs::path awaited_;    ///< the signal is sent when this file is there; empty: at its time
  double again_ = 0.0;  ///< s after the signals they are sent again; 0: they are not

 private:
  int interrupted_ = 0;

  /// Children of the program may take a moment to notice.
  static void expect_no_child() {
    const auto start = Clock::now();
    pid_t child = 0;
    int status = 0;
    while ((child = ::waitpid(-1, &status, WNOHANG)) >= 0 && since(start) < soon) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_TRUE(child < 0 && errno == ECHILD) << "a child is left";
  }

  static TestFolder* shared_;
  static std::string scene_;
};

TestFolder* Interrupt::shared_ = nullptr;
std::string Interrupt::scene_;

TEST_F(Interrupt, Make) { interrupt({"make", "terrain", "-o", folder_.file("huge.ply"), "--triangles", "100M"}); }

TEST_F(Interrupt, Info) {
  for (const double after : {0.1, 0.4}) interrupt({"info", scene()}, after, SIGINT);
}

TEST_F(Interrupt, Walk) { interrupt({"walk", scene(), "--wander", "1e7", "--picture", folder_.file("way.svg")}); }

/// `timeout` and shells send a signal to the program and one to its group.
TEST_F(Interrupt, WalkByThreeSignalsAtOnceWritesWhatItHas) {
  const std::string trace = folder_.file("t.csv");
  const std::string floor =
      folder_.write("floor.obj", "v -9e3 -9e3 0\nv 9e3 -9e3 0\nv 9e3 9e3 0\nv -9e3 9e3 0\nf 1 2 3 4\n");
  interrupt({"walk", floor, "--wander", "1e7", "--trace", trace}, 2.0, SIGTERM, 3);
  EXPECT_TRUE(fs::exists(trace)) << folder_.read("log");
  EXPECT_NE(folder_.read("log").find("INTERRUPTED after"), std::string::npos) << folder_.read("log");
}

TEST_F(Interrupt, WalkAfterItsEndTellsHowItWent) {
  awaited_ = folder_.file("t.csv");
  Arguments walk{"walk", scene(), "--wander", "1", "--trace", awaited_, "--picture", folder_.file("way.svg"), "--json"};
  for (const char* more : {"--stats", "--verify"}) {
    fs::remove(awaited_);
    fs::remove(folder_.file("way.svg"));
    walk.push_back(more);
    interrupt(walk, 0.0, SIGINT);
    EXPECT_NE(folder_.read("log").find("\"outcome\""), std::string::npos) << folder_.read("log");
    expect_drawn_or_told();
  }
}

TEST_F(Interrupt, SweepThatWaitsForQuestions) { interrupt({"sweep", scene()}); }

TEST_F(Interrupt, Train) { interrupt({"train", scene(), "--spacing", "0.05", "-o", folder_.file("p.json")}); }

TEST_F(Interrupt, Probe) {
  interrupt({"probe", scene(), "--from=10,10,100", "--to=690,690,100", "--radius", "0.3", "--height", "1.7",
             "--spacing", "0.05", "--picture", folder_.file("way.svg")});
}

TEST_F(Interrupt, ProbeThatDrawsHasTold) {
  awaited_ = folder_.file("way.path");
  interrupt({"probe", scene(), "--from=10,10,100", "--to=12,10,100", "--radius", "0.3", "--height", "1.7", "--path",
             awaited_, "--picture", folder_.file("way.svg")},
            0.0, SIGINT);
  EXPECT_NE(folder_.read("log").find("YES"), std::string::npos) << folder_.read("log");
  expect_drawn_or_told();
}

TEST_F(Interrupt, Build) {
  for (const double after : {0.1, 0.3, 0.6, 0.9}) {
    interrupt({"build", scene(), "-o", folder_.file(std::to_string(after))}, after, SIGINT);
  }
}

TEST_F(Interrupt, Verify) {
  ASSERT_EQ(run_program(ROAM_PROGRAM, {"build", scene(), "-o", folder_.file("s")}).status, 0);
  interrupt({"verify", folder_.file("s")}, 0.05, SIGINT);
}

TEST_F(Interrupt, Check) {
  (void)run_program(ROAM_PROGRAM, {"walk", scene(), "--wander", "1", "--certify", folder_.file("certificate")});
  for (const double after : {0.05, 0.2}) interrupt({"check", folder_.file("certificate"), scene()}, after, SIGINT);
}

#ifdef ROAM_HAS_BENCH
TEST_F(Interrupt, Bench) { interrupt({"bench", "engines", "--queries", "1000000"}); }
#endif

/// An import that waits for a reader which neither says anything nor ends when it is asked to.
TEST_F(Interrupt, AnImportThatWaits) {
  const std::string reader = folder_.write("reader", "#!/bin/sh\ntrap '' TERM INT\nwhile :; do sleep 1; done\n");
  ::chmod(reader.c_str(), 0755);
  setenv("ROAM_READER", reader.c_str(), 1);
  for (const char* verb : {"info", "train"}) interrupt({verb, scene()});
}

// ------------------------------------------------------------------------------------------------------------ view

TEST_F(Interrupt, View) {
  interrupt({"view", scene(), "--headless", "--time", "1e6", "--screenshot", folder_.file("shot.png")});
}

TEST_F(Interrupt, ViewThatWritesItsFilmAndSaysThatItsPictureIsNotWritten) {
  const std::string floor = folder_.write("floor.obj", "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n");
  const std::string film = folder_.file("film.mp4");
  // Its encoder takes longer than good order.
  fs::create_directory(folder_.file("bin"));
  const std::string path = std::getenv("PATH");
  const std::string encoder = folder_.write("bin/ffmpeg", "#!/bin/sh\nPATH='" + path + "' ffmpeg \"$@\" && sleep 4\n");
  ::chmod(encoder.c_str(), 0755);
  const EnvironmentVariable slow("PATH", folder_.file("bin") + ":" + path);
  // A busy machine draws its first picture late.
  for (const double seconds : {5.0, 20.0, 60.0}) {
    interrupt(
        {"view", floor, "--headless", "--time", "1e6", "--screenshot", folder_.file("shot.png"), "--record", film},
        seconds, SIGINT, 1, 4.0 + 2.0 * soon);
    if (fs::exists(film)) break;
  }
  EXPECT_TRUE(fs::exists(film)) << folder_.read("log");
  EXPECT_NE(folder_.read("log").find("still writing the results; Ctrl-C again drops them"), std::string::npos);
  EXPECT_NE(folder_.read("log").find("shot.png was not written: the session ended before"), std::string::npos)
      << folder_.read("log");
}

TEST_F(Interrupt, ViewThatWaitsForItsEncoder) {
  const std::string floor = folder_.write("floor.obj", "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n");
  const std::string film = folder_.file("film.mp4");
  fs::create_directory(folder_.file("bin"));
  const std::string path = std::getenv("PATH");
  awaited_ = folder_.file("ending");
  const std::string encoder = folder_.write(
      "bin/ffmpeg", "#!/bin/sh\nPATH='" + path + "'\nffmpeg \"$@\" && touch '" + awaited_.string() + "' && sleep 4\n");
  ::chmod(encoder.c_str(), 0755);
  const EnvironmentVariable slow("PATH", folder_.file("bin") + ":" + path);
  interrupt({"view", floor, "--headless", "--time", "1", "--record", film}, 0.0, SIGINT, 1, 4.0 + 2.0 * soon);
  EXPECT_TRUE(fs::exists(film)) << folder_.read("log");
  EXPECT_NE(folder_.read("log").find("film.mp4"), std::string::npos) << "the report: " << folder_.read("log");
}

/// A signal that is sent twice, as by `timeout`, after the time in which the program ends without results.
TEST_F(Interrupt, ViewWhoseEncoderNeverEndsByASecondSignal) {
  const std::string floor = folder_.write("floor.obj", "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n");
  fs::create_directory(folder_.file("bin"));
  const std::string encoder = folder_.write("bin/ffmpeg", "#!/bin/sh\ncat > /dev/null\nexec sleep 300\n");
  ::chmod(encoder.c_str(), 0755);
  const EnvironmentVariable endless("PATH", folder_.file("bin") + ":" + std::string(std::getenv("PATH")));
  again_ = 6.0;
  interrupt({"view", floor, "--headless", "--time", "1e6", "--record", folder_.file("film.mp4")}, 5.0, SIGINT, 2,
            again_ + soon);
  EXPECT_FALSE(fs::exists(folder_.file("film.mp4")));
  EXPECT_NE(folder_.read("log").find("roam: cancelled"), std::string::npos) << folder_.read("log");
}

TEST_F(Interrupt, ViewThatFilms) {
  interrupt({"view", scene(), "--headless", "--time", "1e6", "--record", folder_.file("film.mp4")});
}

TEST_F(Interrupt, ViewThatFilmsByThreeSignalsAtOnce) {
  for (const int signal : {SIGINT, SIGTERM}) {
    interrupt({"view", scene(), "--headless", "--time", "1e6", "--record", folder_.file("film.mp4")}, 2.0, signal, 3);
  }
}

TEST_F(Interrupt, ViewThatFilmsByTheEndOfItsTerminal) {
  interrupt({"view", scene(), "--headless", "--time", "1e6", "--record", folder_.file("film.mp4")}, 2.0, SIGHUP);
}

/// One draw call of minutes: an image that is repeated thousands of times over one quad, seen aslant, filtered by
/// software.
TEST_F(Interrupt, ViewWhileTheDriverWorks) {
  constexpr int side = 256;
  std::string image{"\0\0\2\0\0\0\0\0\0\0\0\0", 12};  // TGA, colours as they are
  for (const int size : {side, side}) image += {static_cast<char>(size & 0xFF), static_cast<char>(size >> 8)};
  image += {24, 0};
  for (int i = 0; i < side * side * 3; ++i) image += static_cast<char>(i * 7919 >> 4);
  folder_.write("stone.tga", image);
  folder_.write("ground.mtl", "newmtl stone\nKd 1 1 1\nmap_Kd stone.tga\n");
  const std::string ground = folder_.write("ground.obj",
                                           "mtllib ground.mtl\nusemtl stone\nv -500 -500 0\nv 500 -500 0\nv 500 500 0\n"
                                           "v -500 500 0\nvt 0 0\nvt 5000 0\nvt 5000 5000\nvt 0 5000\n"
                                           "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  for (const int signal : {SIGINT, SIGTERM}) {
    interrupt({"view", ground, "--headless", "--size", "3840x2160", "--time", "1e6", "--record",
               folder_.file("film.mp4"), "--at", "0,0,0.9,0,-1"},
              4.0, signal);
  }
}

TEST(TimeToWriteDeathTest, MayBeGivenBeforeTheSignal) {
  const auto write = [] {
    roam::app::catch_signals();
    roam::app::give_time_to_write(std::chrono::minutes(10));
    std::raise(SIGINT);
    std::this_thread::sleep_for(2 * roam::app::longest_good_order);
    std::_Exit(0);
  };
  EXPECT_EXIT(write(), testing::ExitedWithCode(0), "");
}

TEST(IgnoredInterrupt, StaysIgnored) {
  const TestFolder folder;
  const std::string scene = folder.file("terrain.ply");
  const ProgramResult result = run_program(
      "/bin/sh", {"-c", "trap '' INT; exec '" ROAM_PROGRAM "' make terrain -o '" + scene + "' --triangles 2M"},
      {.interrupt_after = 0.1});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(fs::exists(scene));
}

}  // namespace
