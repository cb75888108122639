// roam bench labels as a shell sees it.
#include <gtest/gtest.h>

#include "messages.h"
#include "program.h"

#ifdef ROAM_HAS_BENCH
namespace {

ProgramResult labels(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"bench", "labels"});
  return run_program(ROAM_PROGRAM, arguments);
}

TEST(BenchLabels, WritesOverNoOtherFile) {
  const TestFolder folder;
  const std::string scene =
      folder.write("scene.ply", "ply, or any other file that somebody needs, in some more than a line");
  const ProgramResult refused = labels({scene, "--count", "9"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(refused.err, "another file")) << refused.err;
  EXPECT_TRUE(contains(folder.read("scene.ply"), "somebody needs"));
  const std::string made = folder.file("sweeps.npy");
  for (const char* count : {"9", "1800"}) EXPECT_EQ(labels({made, "--count", count}).status, 0) << count;
  EXPECT_EQ(labels({made, "--count", "9", "--seed", "-1"}).status, 2);
  EXPECT_EQ(labels({made, "--judge", scene, "--count", "9"}).status, 2);
}

}  // namespace
#endif
