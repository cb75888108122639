// roam sweep as a shell sees it, and the rows that it reads and writes.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "cli_scenes.h"
#include "messages.h"
#include "program.h"
#include "roam/error.h"
#include "sweep/rows.h"

namespace {

using roam::app::append_answer;
using roam::app::is_query_header;
using roam::app::parse_query;

std::string message(const std::string& row) {
  try {
    (void)parse_query(row);
  } catch (const roam::Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SweepRows, ReadASphereAndACapsule) {
  const auto sphere = parse_query("1,2,3,4,5,6,0.5");
  EXPECT_EQ(sphere.from, roam::Vec3(1, 2, 3));
  EXPECT_EQ(sphere.motion, roam::Vec3(4, 5, 6));
  EXPECT_EQ(sphere.body.radius, 0.5);
  EXPECT_EQ(sphere.body.half_height, 0.0);
  const auto capsule = parse_query(" -1e3 ,+2, .5,0,0,-1e-9,0.30000000000000004,0.6\r");
  EXPECT_EQ(capsule.from, roam::Vec3(-1000, 2, 0.5));
  EXPECT_EQ(capsule.body.radius, 0.30000000000000004);
  EXPECT_EQ(capsule.body.half_height, 0.6);
}

TEST(SweepRows, SayWhichFieldIsWrong) {
  EXPECT_TRUE(contains(message("1,2,3,4,5,6"), "found 6 fields"));
  EXPECT_TRUE(contains(message("1,2,3,4,5,6,7,8,9"), "found 9 fields"));
  EXPECT_TRUE(contains(message("1,2,3,4,five,6,7"), "column dy: 'five' is no number"));
  EXPECT_TRUE(contains(message("1,,3,4,5,6,7"), "column y: '' is no number"));
  EXPECT_TRUE(contains(message("1,2,3,4,5,6,0x1"), "column radius: '0x1' is no number"));
  EXPECT_TRUE(contains(message("1,2,nan,4,5,6,7"), "column z: 'nan' is not a finite number"));
  EXPECT_TRUE(contains(message("1,2,1e999,4,5,6,7"), "column z: '1e999' is not a finite number"));
  EXPECT_TRUE(contains(message("1,2,3,4,5,6,-7"), "column radius: -7 is negative"));
  EXPECT_TRUE(contains(message("1,2,3,4,5,6,7,-inf"), "column half_height: '-inf' is not a finite number"));
}

TEST(SweepRows, KnowTheirHeaderAndRefuseAnother) {
  EXPECT_TRUE(is_query_header("x,y,z,dx,dy,dz,radius"));
  EXPECT_TRUE(is_query_header("x, y, z, dx, dy, dz, radius, half_height\r"));
  EXPECT_FALSE(is_query_header("1,2,3,4,5,6,7"));
  EXPECT_FALSE(is_query_header("nan,2,3,4,5,6,7"));
  EXPECT_FALSE(is_query_header("+1,+2,+3,+4,+5,+6,+0.3"));
  EXPECT_THROW((void)is_query_header("y,x,z,dx,dy,dz,radius"), roam::Error);
  EXPECT_THROW((void)is_query_header("hello"), roam::Error);
}

TEST(SweepRows, WriteDigitsThatReadBackAsTheSameDouble) {
  roam::Impact hit;
  hit.hit = true;
  hit.time = 0.1 + 0.2;
  hit.point = {1.0 / 3.0, -13739.123456789012, 6.4e6};
  hit.normal = {0, 0, 1};
  hit.feature = roam::Feature::edge;
  hit.distance = 5e-324;
  hit.triangle = 12345678901234;
  std::string row;
  append_answer(row, hit);
  std::vector<std::string> f;
  std::istringstream in(row);
  for (std::string field; std::getline(in, field, ',');) f.push_back(field);
  ASSERT_EQ(f.size(), 11u);
  EXPECT_EQ(f[0], "1");
  EXPECT_EQ(std::strtod(f[1].c_str(), nullptr), hit.time);
  EXPECT_EQ(std::strtod(f[2].c_str(), nullptr), hit.point.x);
  EXPECT_EQ(std::strtod(f[3].c_str(), nullptr), hit.point.y);
  EXPECT_EQ(f[8], "12345678901234");
  EXPECT_EQ(f[9], "edge");
  EXPECT_EQ(std::strtod(f[10].c_str(), nullptr), hit.distance);
}

/// Sweeps in the room of cli_scenes.h.
struct Sweep {
  TestFolder folder;
  ProgramResult result;
  std::vector<std::string> rows;  ///< of the output, the header first

  explicit Sweep(const std::string& queries, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"sweep", folder.write("room.obj", room_obj())};
    arguments.insert(arguments.end(), more.begin(), more.end());
    result = run_program(ROAM_PROGRAM, arguments, {.input = queries});
    std::istringstream in(result.out);
    for (std::string row; std::getline(in, row);) rows.push_back(row);
  }
};

constexpr const char* out_header = "hit,t,px,py,pz,nx,ny,nz,triangle,feature,distance";

TEST(SweepVerb, AnswersEachQueryInItsLine) {
  const Sweep sweep(
      "x,y,z,dx,dy,dz,radius,half_height\n10,0,1.5,20,0,0,0.5,0\n10,0,1.5,1,0,0,0.5,0.25\n1,-1.8,1,0,0,0,0.5");
  EXPECT_EQ(sweep.result.status, 0) << sweep.result.err;
  ASSERT_EQ(sweep.rows.size(), 4u);
  EXPECT_EQ(sweep.rows[0], out_header);
  double t = 0, px = 0, nx = 0;
  ASSERT_EQ(std::sscanf(sweep.rows[1].c_str(), "1,%lf,%lf,%*f,%*f,%lf", &t, &px, &nx), 3) << sweep.rows[1];
  EXPECT_NEAR(t, 9.5 / 20, 2e-4);
  EXPECT_LE(t, 9.5 / 20);
  EXPECT_NEAR(px, 20, 2e-3);
  EXPECT_NEAR(nx, -1, 1e-6);
  EXPECT_TRUE(contains(sweep.rows[1], ",face,")) << sweep.rows[1];
  double distance = 0;
  ASSERT_EQ(std::sscanf(sweep.rows[2].c_str(), "0,1,0,0,0,0,0,0,-1,none,%lf", &distance), 1) << sweep.rows[2];
  EXPECT_GE(distance, 1.5 - 0.25 - 0.5 - 2e-3);  // at most the grid less than the truth
  EXPECT_LE(distance, 1.5 - 0.25 - 0.5);         // below and above the capsule
  ASSERT_EQ(std::sscanf(sweep.rows[3].substr(sweep.rows[3].rfind(',')).c_str(), ",%lf", &distance), 1);
  EXPECT_EQ(sweep.rows[3].substr(0, 4), "1,0,");  // starts 0.3 m inside the right wall
  EXPECT_NEAR(distance, -0.3, 3e-3);
}

TEST(SweepVerb, NeedsNoHeaderAndAnswersNothingToNothing) {
  EXPECT_EQ(Sweep("10,0,1.5,20,0,0,0.5\n").rows.size(), 2u);
  const Sweep none("");
  EXPECT_EQ(none.result.status, 0);
  EXPECT_EQ(none.result.out, std::string(out_header) + "\n");
}

TEST(SweepVerb, AcceptsAByteOrderMark) {
  EXPECT_EQ(Sweep("\xEF\xBB\xBFx,y,z,dx,dy,dz,radius\n10,0,1.5,20,0,0,0.5\n").rows.size(), 2u);
  EXPECT_EQ(Sweep("\xEF\xBB\xBF"
                  "10,0,1.5,20,0,0,0.5\n")
                .rows.size(),
            2u);
}

TEST(SweepVerb, NamesTheLineOfAMalformedRowAfterAnsweringThoseBefore) {
  const Sweep sweep("x,y,z,dx,dy,dz,radius\n10,0,1.5,20,0,0,0.5\n\n10,0,1.5,20,0,0\n10,0,1.5,20,0,0,0.5\n");
  EXPECT_EQ(sweep.result.status, 1);
  EXPECT_TRUE(contains(sweep.result.err, "line 4: found 6 fields")) << sweep.result.err;
  EXPECT_EQ(sweep.rows.size(), 2u);
}

TEST(SweepVerb, RefusesWhatTheWorldCannotAnswerByItsLine) {
  const Sweep sweep("0,0,1,1,0,0,0.5\n0,0,1,1,0,0,1e7\n");
  EXPECT_EQ(sweep.result.status, 1);
  EXPECT_TRUE(contains(sweep.result.err, "line 2: ")) << sweep.result.err;
}

TEST(SweepVerb, KeepsTheOrderOverAnyNumberOfThreads) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(1, 19);
  std::string queries;
  constexpr std::size_t count = 30'000;
  for (std::size_t i = 0; i < count; ++i) {
    queries += std::to_string(x(random)) + ",0," + std::to_string(0.6 + 0.05 * double(i % 36)) + ",30,2,1,0.25\n";
  }
  const Sweep one(queries, {"--threads", "1"});
  const Sweep three(queries, {"--threads", "3"});
  EXPECT_EQ(one.result.status, 0);
  EXPECT_EQ(one.rows.size(), count + 1);
  EXPECT_EQ(one.result.out, three.result.out);
}

TEST(SweepVerb, TellsAnErrorWhileTheOtherEndStillWaits) {
  // A producer that keeps its end open until it has seen the error: the shell's `sleep` holds the pipe.
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const std::string line = "(echo wrong; exec sleep 30) | { \"$0\" sweep \"$1\"; echo status $?; kill -TERM 0; }";
  const auto start = std::chrono::steady_clock::now();
  const ProgramResult result = run_program("/usr/bin/setsid", {"--wait", "bash", "-c", line, ROAM_PROGRAM, scene});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(25));
  EXPECT_TRUE(contains(result.out, "status 1")) << result.out << result.err;
}

TEST(SweepVerb, EndsQuietlyWhenNobodyReads) {
  const TestFolder folder;
  std::string queries;
  for (int i = 0; i < 20'000; ++i) queries += "10,0,1.5,20,0,0,0.5\n";
  const ProgramResult result = run_program(ROAM_PROGRAM, {"sweep", folder.write("room.obj", room_obj())},
                                           {.input = queries, .close_output = true});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "");
}

}  // namespace
