// Addresses of web servers: their secrets are in no message, and nothing is written to them.

#include <gtest/gtest.h>

#include <future>

#include "messages.h"
#include "program.h"

namespace {

TEST(Addresses, NoMessageHoldsASecret) {
  const TestFolder folder;
  const std::string file = folder.write("a.ply", "ply\n"), place = "://127.0.0.1:1/a";
  std::vector<std::future<ProgramResult>> all;
  for (const std::string scheme : {"http", "HTTP", "https"}) {
    const std::string address = scheme + place + "?sig=SECRET", login = scheme + "://me:SEC/RET@127.0.0.1:1/a";
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"info", address},
                                               {"info", login},
                                               {"info", address, "--json"},
                                               {"publish", file, address},
                                               {"build", address},
                                               {"build", login},
                                               {"build", file, "-o", address},
                                               {"check", file, address},
                                               {"walk", file, "--path", file, "--against", address},
                                               {"verify", file, address}}) {
      // All at once: most of them try for 20 s to connect.
      all.push_back(std::async(std::launch::async, [arguments] { return run_program(ROAM_PROGRAM, arguments); }));
    }
  }
  for (auto& one : all) {
    const ProgramResult told = one.get();
    EXPECT_NE(told.status, 0) << told.err;
    for (const std::string& text : {told.out, told.err}) {
      EXPECT_EQ(text.find("SECRET"), std::string::npos) << text;
      EXPECT_EQ(text.find("SEC/RET"), std::string::npos) << text;
    }
  }
}

TEST(Addresses, NothingIsWrittenToThem) {
  const TestFolder folder;
  const std::string file = folder.write("a.ply", "ply\n");
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"build", file, "-o", "http://127.0.0.1:1/a.roam"}, {"publish", file, "HTTP://127.0.0.1:1/a.roam"}}) {
    const ProgramResult told = run_program(ROAM_PROGRAM, arguments);
    EXPECT_EQ(told.status, 2) << told.err;
    EXPECT_NE(told.err.find("a web server cannot be written to"), std::string::npos) << told.err;
  }
  EXPECT_EQ(run_program(ROAM_PROGRAM, {"publish", file, ""}).status, 2) << "nor to a folder without a name";
}

TEST(Addresses, AreRefusedAlikeWhereAFileIsNeeded) {
  const TestFolder folder;
  const std::string file = folder.write("a.ply", "ply\n");
  for (const auto& [address, help] :
       {std::pair<std::string, std::string>{"http://127.0.0.1:1/a", "a scene is downloaded first"},
        {"ftp://127.0.0.1:1/a", "all else is copied here first"}}) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"build", address}, {"check", file, address}, {"walk", file, "--path", file, "--against", address}}) {
      const ProgramResult told = run_program(ROAM_PROGRAM, arguments);
      EXPECT_EQ(told.status, 1) << told.err;
      EXPECT_TRUE(contains(told.err, address + ": there is no such file or folder. ")) << told.err;
      EXPECT_TRUE(contains(told.err, help)) << told.err;
    }
  }
}

TEST(Addresses, HaveNoProfileBesideThem) {
  const ProgramResult told = run_program(ROAM_PROGRAM, {"train", "http://127.0.0.1:1/a"});
  EXPECT_EQ(told.status, 2) << told.err;
  EXPECT_TRUE(contains(told.err, "no profile can be written beside an address")) << told.err;
}

}  // namespace
