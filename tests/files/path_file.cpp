#include "roam/path_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <sstream>
#include <streambuf>

#include "program.h"
#include "roam/error.h"

namespace {

std::vector<roam::Waypoint> read(const std::string& text) {
  std::istringstream in(text);
  return roam::read_path(in, "walk.path");
}

std::string message(const std::string& text) {
  try {
    (void)read(text);
  } catch (const roam::Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(PathFile, ReadsWaypointsWithEveryDigit) {
  const auto path = read("-13739.123456789012 253 182\n1e-3 +2 .5\n");
  ASSERT_EQ(path.size(), 2u);
  EXPECT_EQ(path[0].position, roam::Vec3(-13739.123456789012, 253, 182));
  EXPECT_EQ(path[1].position, roam::Vec3(1e-3, 2, 0.5));
  EXPECT_FALSE(path[0].pose);
}

TEST(PathFile, ReadsTheLinesThatOsgviewerRecords) {
  const auto path = read("0 1 2 3 0 0 0 1\n0.0166 1.5 2 3 0.1 0.2 0.3 0.9\n");
  ASSERT_EQ(path.size(), 2u);
  EXPECT_EQ(path[1].position, roam::Vec3(1.5, 2, 3));
  ASSERT_TRUE(path[1].pose);
  EXPECT_EQ(path[1].pose->time, 0.0166);
  EXPECT_EQ(path[1].pose->rotation, (std::array<double, 4>{0.1, 0.2, 0.3, 0.9}));
}

TEST(PathFile, SkipsCommentsBlankLinesAndTheMarksOfOtherSystems) {
  const auto path = read("\xEF\xBB\xBF# path 1\r\n\r\n  0 0 0 # the start\r\n\t1\t0\t0\r\n#");
  ASSERT_EQ(path.size(), 2u);
  EXPECT_EQ(path[0].line, 3);
  EXPECT_EQ(path[1].line, 4);
}

TEST(PathFile, NamesTheLineAndTheWordThatAreWrong) {
  EXPECT_EQ(message("0 0 0\n1 zero 0\n"),
            "walk.path:2: 'zero' is no number; a line is 'x y z' or 't x y z qx qy qz qw', '#' begins a comment");
  EXPECT_EQ(message("0 0 0\n1,5 0 0\n").substr(0, 31), "walk.path:2: '1,5' is no number");
  for (const char* word : {"+", "++5", "+-5", "-+5"}) {
    EXPECT_EQ(message(std::string("0 0 0\n") + word + " 0 0\n").substr(0, 30),
              ("walk.path:2: '" + std::string(word) + "' is no number; a line").substr(0, 30));
  }
  EXPECT_EQ(message("0 0 0\n\n1 2\n").substr(0, 30), "walk.path:3: found 2 numbers; ");
  EXPECT_EQ(message("0 0 0\n1 2 3 4 5 6 7 8 9\n").substr(0, 28), "walk.path:2: found 9 numbers");
}

TEST(PathFile, RefusesNumbersThatAreNotFinite) {
  for (const char* word : {"nan", "inf", "-inf", "1e999"}) {
    EXPECT_NE(message(std::string("0 0 0\n1 2 ") + word + "\n").find("is not a finite number"), std::string::npos)
        << word;
  }
}

TEST(PathFile, RefusesMixedKindsAndTimesThatRunBackwards) {
  EXPECT_NE(message("0 0 0\n0 1 2 3 0 0 0 1\n").find("walk.path:2: waypoints"), std::string::npos);
  EXPECT_NE(message("1 0 0 0 0 0 0 1\n0.5 1 2 3 0 0 0 1\n").find("walk.path:2: the time runs backwards"),
            std::string::npos);
}

TEST(PathFile, NeedsTwoWaypoints) {
  EXPECT_NE(message("# nothing\n").find("holds no waypoint"), std::string::npos);
  EXPECT_NE(message("1 2 3\n").find("only one waypoint"), std::string::npos);
}

/// Lines without end, of which each is the same.
class Endless : public std::streambuf {
 public:
  explicit Endless(std::string line) : line_(std::move(line)) { rewind(); }
  std::uint64_t bytes = 0;

 private:
  void rewind() { setg(line_.data(), line_.data(), line_.data() + line_.size()); }
  int_type underflow() override {
    bytes += line_.size();
    if (bytes > std::uint64_t{1} << 30) return traits_type::eof();
    rewind();
    return traits_type::to_int_type(line_.front());
  }
  std::string line_;
};

std::string message_of_endless(const std::string& line) {
  Endless lines(line);
  std::istream in(&lines);
  try {
    (void)roam::read_path(in, "walk.path");
  } catch (const roam::Error& error) {
    return error.what();
  }
  return "read to its end";
}

TEST(PathFile, IsNotReadWithoutEnd) {
  EXPECT_EQ(message_of_endless("x"),
            "walk.path:1: the line is longer than 4096 bytes; a line is 'x y z' or 't x y z qx "
            "qy qz qw'");
  EXPECT_EQ(message_of_endless("1 2 3\n"),
            "walk.path:1000001: holds more than 1000000 waypoints; leave some out, or go along it in parts");
  EXPECT_EQ(message_of_endless("# a comment that is as long as comments are, and says nothing\n"),
            "walk.path: is larger than 128 MiB; is it the right file?");
}

TEST(PathFile, TakesLinesAsLongAsTheyMayBe) {
  const std::string longest = "#" + std::string(4095, 'x');
  EXPECT_EQ(read(longest + "\n1 2 3\n4 5 6\n" + longest).size(), 2u);
  EXPECT_EQ(message("1 2 3\n4 5 6\n" + longest + "x").substr(0, 28), "walk.path:3: the line is lon");
}

TEST(PathFile, ShowsLittleOfAFileThatIsNone) {
  const std::string secret(200, 's');
  const std::string said = message(secret + " in a file that a link leads to\n");
  EXPECT_EQ(said.find(std::string(30, 's')), std::string::npos) << said;
  EXPECT_EQ(said.find("a link"), std::string::npos) << said;
  EXPECT_EQ(message("1 2 \x1b[31mred\n").find('\x1b'), std::string::npos);
}

TEST(PathFile, SaysWhichFileCannotBeOpened) {
  try {
    (void)roam::load_path("no/such.path");
    FAIL() << "opened a file that is not there";
  } catch (const roam::Error& error) {
    EXPECT_EQ(std::string(error.what()), "cannot read no/such.path: No such file or directory; check its name");
  }
  EXPECT_THROW((void)roam::load_path("."), roam::Error);
  EXPECT_THROW((void)roam::load_path("/dev/zero"), roam::Error);
}

/// A file that is gone when the test ends.
struct PathOnDisk {
  std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / ("roam-saved-" + std::to_string(::getpid()) + ".path");
  ~PathOnDisk() {
    std::error_code none;
    std::filesystem::remove(file, none);
  }
};

std::string saving(const std::filesystem::path& file, const std::vector<roam::Vec3>& path) {
  try {
    roam::save_path(file, path);
  } catch (const roam::Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(PathFile, IsSavedSoThatItIsReadBackToTheLastBit) {
  const PathOnDisk disk;
  const std::vector<roam::Vec3> way{{-13739.123456789012, 0.1 + 0.2, -0.0}, {1e-300, 1e9, 1.0 / 3.0}, {2, 3, 4}};
  roam::save_path(disk.file, way);
  EXPECT_EQ(roam::positions(roam::load_path(disk.file)), way);
  roam::WalkerSettings body;
  body.support_radius = 0.65;
  roam::save_path(disk.file, way, &body, roam::Mode::walk);
  EXPECT_EQ(roam::positions(roam::load_path(disk.file)), way);
  std::ifstream in(disk.file);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "# roam: mode walk radius 0.3 height 1.8 eye 1.6 step 0.3 slope 45 support 0.65");
}

/// Several kB.
std::vector<roam::Vec3> long_way() {
  std::vector<roam::Vec3> way;
  for (int i = 0; i < 2000; ++i) way.emplace_back(i, 0.5 * i, 0.25);
  return way;
}

TEST(PathFile, IsAsItWasWhenTheDiskIsFull) {
  const TestFolder folder;
  const std::string file = folder.write("way.path", "of before");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{4096, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string said = saving(file, long_way());
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_NE(said.find("way.path: File too large"), std::string::npos) << said;
  EXPECT_TRUE(folder.read("way.path") == "of before");
}

TEST(PathFile, IsNotSavedWhereALinkLeads) {
  const TestFolder folder;
  folder.write("letter.txt", "precious");
  std::filesystem::create_symlink("letter.txt", folder.file("way.path"));
  EXPECT_EQ(saving(folder.file("way.path"), long_way()), "no error");
  EXPECT_TRUE(folder.read("letter.txt") == "precious");
  EXPECT_EQ(roam::positions(roam::load_path(folder.file("way.path"))), long_way());
}

TEST(PathFile, IsNotSavedWhereItCouldNotBeReadOrWritten) {
  const PathOnDisk disk;
  EXPECT_NE(saving(disk.file, {{1, 2, 3}}).find("this one has 1 places"), std::string::npos);
  EXPECT_NE(saving(disk.file, {{1, 2, 3}, {1, std::nan(""), 3}}).find("place 1 is (1, nan, 3)"), std::string::npos);
  EXPECT_NE(saving(disk.file, {{1, 2, 3e9}, {1, 2, 3}}).find("place 0"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(disk.file));
  EXPECT_NE(saving("no/such/folder/way.path", {{1, 2, 3}, {4, 5, 6}}).find("cannot write no/such"), std::string::npos);
  EXPECT_NE(saving("", {{1, 2, 3}, {4, 5, 6}}).find("has no name"), std::string::npos);
  EXPECT_THROW((void)roam::load_path(""), roam::Error);
}

}  // namespace
