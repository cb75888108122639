// If memory runs out at the start of a child, the call throws, and no child and no open file is left.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>

#include "fallible_calls.h"
#include "process/child.h"

// Instrumented builds have an operator new of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

TEST(ChildAllocations, LeaveNoChildWhereverOneFails) {
  fail_calls({{"start",
               [] {
                 roam::process::Child child("/bin/sleep", {"60"}, {});
                 child.end(std::chrono::milliseconds(0));
                 return std::string("started");
               },
               [](bool /*failed*/) {
                 int status = 0;
                 EXPECT_TRUE(::waitpid(-1, &status, WNOHANG) == -1 && errno == ECHILD);
               }}});
}

}  // namespace
#endif
