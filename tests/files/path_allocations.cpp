// Where memory runs out, a path is read or written whole, or the call throws. Instrumented builds have an operator new
// of their own.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <new>
#include <sstream>

#include "counted_allocations.h"
#include "fallible_calls.h"
#include "import_files.h"
#include "roam/path_file.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

// A process makes its list of unfinished files with the first one. So each try has its own process, and no test before
// this one writes a file.
TEST(PathAllocations, TheFirstFileOfAProcessIsWholeOrNotThereWhereverOneFails) {
  const roam::test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.path";
  for (long at = 1;; ++at) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      failing_on = true;
      failing_allocation = allocations + at;
      int status = 0;
      try {
        roam::save_path(file, std::vector<roam::Vec3>{{1, 2, 3}, {4, 5, 6}});
      } catch (const std::bad_alloc&) {
        status = 1;
      }
      ::_exit(status);
    }
    int ended = 0;
    ASSERT_EQ(::waitpid(child, &ended, 0), child);
    ASSERT_TRUE(WIFEXITED(ended)) << at << ": " << WTERMSIG(ended);
    const bool saved = WEXITSTATUS(ended) == 0;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), saved ? 1 : 0) << at;
    if (!saved) continue;
    EXPECT_GT(at, 10);
    EXPECT_EQ(roam::load_path(file).size(), 2U);
    break;
  }
}

TEST(PathAllocations, APathIsReadWholeOrNotWhereverOneFails) {
  const std::string text = "0 0 0\n1 2 3\n4 5 6\n7 8 9\n1 1 1 # a comment\n2 2 x";
  const auto read = [](const std::string& some) {
    std::istringstream in(some);
    return roam::read_path(in, "a name that is too long for no allocation").size();
  };
  fail_calls({
      {"read_path", [&] { return std::string(Bits() << read(text.substr(0, text.rfind('\n')))); }},
      {"read_path of a wrong line", [&] { return refusal_of([&] { static_cast<void>(read(text)); }); }},
  });
}

TEST(PathAllocations, AFileIsWholeOrAsItWasWhereverOneFails) {
  const roam::test::TemporaryFolder folder;
  const std::filesystem::path file = folder.write("a.path", "1 2 3\n4 5 6\n");
  const std::vector<roam::Vec3> before{{1, 2, 3}, {4, 5, 6}}, wanted{{7, 8, 9}, {0, 0, 0}, {1, 1, 1}};
  fail_calls({{"save_path",
               [&] {
                 roam::save_path(file, wanted);
                 return std::string("saved");
               },
               [&](bool failed) {
                 EXPECT_EQ(roam::positions(roam::load_path(file)), failed ? before : wanted);
                 EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
                 roam::save_path(file, before);
               }}});
}

}  // namespace
#endif
