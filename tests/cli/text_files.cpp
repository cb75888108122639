// Small files that the program reads itself: paths, sizes, settings, bookmarks. None is read without end, a pipe is
// read once, and a message shows little of a file that is something else.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "messages.h"
#include "program.h"

namespace {

namespace fs = std::filesystem;

std::string in_quotes(const std::string& text) { return "'" + text + "'"; }

/// kB that a program may have resident that refuses such a file.
constexpr long little_memory = 700'000;

class TextFiles : public testing::Test {
 protected:
  void SetUp() override {
    // A floor of 20 m by 20 m.
    scene_ = folder_.write("floor.obj", "v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nf 1 2 3 4\n");
    setenv("XDG_CONFIG_HOME", folder_.file("config").c_str(), 1);
    fs::create_directories(folder_.file("config/roam"));
  }
  [[nodiscard]] ProgramResult run(const std::string& arguments, const ProgramOptions& options = {}) const {
    return run_program("/bin/bash", {"-c", "exec '" ROAM_PROGRAM "' " + arguments}, options);
  }
  [[nodiscard]] std::string walk(const std::string& path) const {
    return "walk " + in_quotes(scene_) + " --mode fly --path " + path;
  }
  [[nodiscard]] std::string view(const std::string& options) const {
    return "view " + in_quotes(scene_) + " --headless --size 160x120 --screenshot " +
           in_quotes(folder_.file("out.png")) + " " + options;
  }
  /// Refused by a sentence, and not by a signal.
  static void expect_refused(const ProgramResult& result, const std::string& why) {
    EXPECT_TRUE(result.status == 1 || result.status == 2) << result.status << result.err;
    EXPECT_TRUE(contains(result.err, why)) << result.err.substr(0, 2000);
    EXPECT_LT(result.err.size(), 1500u);
    EXPECT_LT(result.peak, little_memory);
  }

  const TestFolder folder_;
  std::string scene_;
};

constexpr const char* printed_way =
    "# roam: mode fly radius 0.5 height 1 eye 0.5 step 0.3 slope 45\\n-5 0 3\\n5 0 3\\n";

TEST_F(TextFiles, APathMayComeThroughAPipe) {
  const std::string text = "printf " + in_quotes(printed_way);
  const ProgramResult substituted = run(walk("<(" + text + ")"));
  EXPECT_EQ(substituted.status, 0) << substituted.err;
  const ProgramResult piped = run_program(
      "/bin/bash", {"-c", text + " | '" ROAM_PROGRAM "' walk " + in_quotes(scene_) + " --path /dev/stdin --json"});
  EXPECT_EQ(piped.status, 0) << piped.err;
  EXPECT_TRUE(contains(piped.out, "\"radius\": 0.5")) << piped.out;
  const ProgramResult viewed = run("view " + in_quotes(scene_) + " --headless --size 160x120 --path <(" + text + ")");
  EXPECT_EQ(viewed.status, 0) << viewed.err;
}

TEST_F(TextFiles, ADashIsStandardInput) {
  const std::string path = "# roam: mode fly radius 0.5 height 1 eye 0.5 step 0.3 slope 45\n-5 0 3\n5 0 3\n";
  const ProgramResult walked = run(walk("- --json"), {.input = path});
  EXPECT_EQ(walked.status, 0) << walked.err;
  EXPECT_TRUE(contains(walked.out, "\"radius\": 0.5")) << walked.out;
  const ProgramResult viewed =
      run("view " + in_quotes(scene_) + " --headless --size 160x120 --path -", {.input = path});
  EXPECT_EQ(viewed.status, 0) << viewed.err;
  const std::string probe = "probe " + in_quotes(scene_) + " --from 0,0,1 --to 1,0,1";
  const ProgramResult probed = run(probe + " --matrix - --json", {.input = "0.2x1.8\n0.3\n"});
  EXPECT_EQ(probed.status, 0) << probed.err;
  EXPECT_TRUE(contains(probed.out, "\"radius\": 0.3")) << probed.out;
  expect_refused(run(walk("-"), {.input = "1 2\n"}), "standard input:1: found 2 numbers");
  expect_refused(run(walk("- < /dev/zero")), "standard input:1: the line is longer than 4096 bytes");
}

TEST_F(TextFiles, ADashIsStandardOutputAndTheReportGoesToStandardError) {
  const std::string path = in_quotes(folder_.write("way.path", "-5 0 3\n5 0 3\n"));
  const std::string trace = in_quotes(folder_.file("t.csv"));
  ASSERT_EQ(run(walk(path + " --trace " + trace)).status, 0);
  const ProgramResult streamed = run(walk(path + " --trace -"));
  EXPECT_EQ(streamed.status, 0) << streamed.err;
  EXPECT_EQ(streamed.out, folder_.read("t.csv"));
  EXPECT_TRUE(contains(streamed.err, "REACHED: ")) << streamed.err;
  const ProgramResult viewed =
      run("view " + in_quotes(scene_) + " --headless --size 160x120 --path " + path + " --trace -");
  EXPECT_TRUE(viewed.out.starts_with("step,t,x,y,z,radius,")) << viewed.out.substr(0, 200);
  EXPECT_FALSE(contains(viewed.out, "REACHED: ")) << viewed.out;

  // The way that one program finds is the way that another goes.
  const ProgramResult found =
      run("probe " + in_quotes(scene_) + " --from -5,0,1 --to 5,0,1 --radius 0.3 --height 1.7 --path -");
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_TRUE(found.out.starts_with("# roam: mode walk radius 0.3 height 1.7 ")) << found.out;
  EXPECT_EQ(run("walk " + in_quotes(scene_) + " --path -", {.input = found.out}).status, 0);
  const ProgramResult both = run("walk " + in_quotes(scene_) + " --path - --trace -", {.input = found.out});
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_FALSE(fs::exists("-"));

  expect_refused(run(walk(path + " --trace - --json")), "--trace - and --json both write to standard output");
}

TEST_F(TextFiles, MayBeginWithTheByteOrderMarkOfUtf8) {
  const std::string mark = "\xEF\xBB\xBF", sizes = folder_.write("sizes", mark + "0.2x1.8\n0.3\n");
  const ProgramResult probed =
      run("probe " + in_quotes(scene_) + " --from 0,0,1 --to 1,0,1 --json --matrix " + in_quotes(sizes));
  EXPECT_EQ(probed.status, 0) << probed.err;
  EXPECT_TRUE(contains(probed.out, "\"radius\": 0.2")) << probed.out;
  EXPECT_EQ(run(walk(in_quotes(folder_.write("way.path", mark + "-5 0 3\n5 0 3\n")))).status, 0);
}

TEST_F(TextFiles, ACtrlCEndsTheWaitForAPathThatNobodyWrites) {
  ASSERT_EQ(::mkfifo(folder_.file("pipe").c_str(), 0666), 0);
  const ProgramResult result = run(walk(in_quotes(folder_.file("pipe"))), {.interrupt_after = 0.3});
  EXPECT_EQ(result.status, 130);
  EXPECT_TRUE(contains(result.err, "cancelled")) << result.err;
}

TEST_F(TextFiles, NoneIsReadWithoutEnd) {
  expect_refused(run(walk("/dev/zero")), "/dev/zero:1: the line is longer than 4096 bytes");
  expect_refused(run(walk("- < <(yes '# a comment')")), "standard input: is larger than 128 MiB");
  expect_refused(run("probe " + in_quotes(scene_) + " --from 0,0,1 --to 1,0,1 --matrix /dev/zero"),
                 "/dev/zero: File too large");
  expect_refused(run(view("--settings /dev/zero")), "/dev/zero: File too large");
  fs::create_symlink("/dev/zero", folder_.file("config/roam/bookmarks.json"));
  expect_refused(run(view("--bookmark 1")), "bookmarks.json: File too large");
}

TEST_F(TextFiles, OfJsonIsReadNoDeeperThanAnySuchFile) {
  std::string begin, end;
  for (int i = 0; i < 200'000; ++i) {
    begin += "{\"keys\":";
    end += '}';
  }
  const std::string deep = folder_.write("deep.json", begin + "1" + end);
  expect_refused(run(view("--settings " + in_quotes(deep))), "deep.json: is nested deeper than");
  (void)folder_.write("config/roam/bookmarks.json", "[" + begin + "1" + end + "]");
  expect_refused(run(view("--bookmark 1")), "bookmarks.json: is nested deeper than");
}

TEST_F(TextFiles, AMessageShowsLittleOfAFileThatIsNone) {
  const std::string secret(3000, 's');
  fs::create_symlink(folder_.write("secret", secret), folder_.file("path.csv"));
  const auto expect_little = [&](const ProgramResult& result) {
    EXPECT_TRUE(result.status == 1 || result.status == 2) << result.status << result.err;
    EXPECT_FALSE(contains(result.err, std::string(30, 's'))) << result.err;
  };
  const std::string link = in_quotes(folder_.file("path.csv"));
  expect_little(run(walk(link)));
  expect_little(run("probe " + in_quotes(scene_) + " --from 0,0,1 --to 1,0,1 --matrix " + link));
  expect_little(run(view("--settings " + link)));
  expect_little(run("sweep " + in_quotes(scene_) + " < " + link));
  (void)folder_.write("config/roam/bookmarks.json", "[\"" + secret + "\"");
  expect_little(run(view("--bookmark 1")));
}

}  // namespace
