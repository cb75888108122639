// Where memory runs out, a path is read or written whole, or the call throws. Instrumented builds have an operator new
// of their own.
#include <gtest/gtest.h>

#include <sstream>

#include "failing_allocations.h"
#include "import_files.h"
#include "roam/path_file.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

TEST(PathAllocations, APathIsReadWholeOrNotWhereverOneFails) {
  const std::string text = "0 0 0\n1 2 3\n4 5 6\n7 8 9\n1 1 1 # a comment\n2 2 x";
  for (const std::string& some : {text.substr(0, text.rfind('\n')), text}) {
    EXPECT_GT(fail_each([&] {
                std::istringstream in(some);
                EXPECT_EQ(roam::read_path(in, "a name that is too long for no allocation").size(), 5U);
              }),
              3);
  }
}

TEST(PathAllocations, AFileIsWholeOrAsItWasWhereverOneFails) {
  const roam::test::TemporaryFolder folder;
  const std::filesystem::path file = folder.write("a.path", "1 2 3\n4 5 6\n");
  const std::vector<roam::Vec3> before{{1, 2, 3}, {4, 5, 6}}, wanted{{7, 8, 9}, {0, 0, 0}, {1, 1, 1}};
  EXPECT_GT(fail_each([&] { roam::save_path(file, wanted); }, 1,
                      [&] {
                        const auto held = roam::positions(roam::load_path(file));
                        EXPECT_TRUE(held == before || held == wanted);
                        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
                        roam::save_path(file, before);
                      }),
            5);
}

}  // namespace
#endif
