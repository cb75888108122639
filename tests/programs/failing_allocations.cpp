// Preloaded into a program, lets its operator new fail:
//
//   FAILING_PROGRAM=NAME  only in processes of this program
//   FAILING_AT=N          the N-th allocation, over all threads (0: none, they are only counted)
//   FAILING_ON=1          all later ones, too
//   FAILING_COUNT=FILE    the number of allocations is written there when the process ends
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "counted_allocations.h"

namespace {

bool is_meant() {
  const char* const program = std::getenv("FAILING_PROGRAM");
  return program != nullptr && std::strcmp(program, program_invocation_short_name) == 0;
}

struct FromEnvironment {
  FromEnvironment() {
    const char* const at = std::getenv("FAILING_AT");
    if (!is_meant() || at == nullptr) return;
    failing_on = std::getenv("FAILING_ON") != nullptr;
    failing_allocation = std::atol(at);
  }
  ~FromEnvironment() {
    const char* const name = std::getenv("FAILING_COUNT");
    if (!is_meant() || name == nullptr) return;
    if (std::FILE* const file = std::fopen(name, "w")) {
      std::fprintf(file, "%ld\n", allocations.load());
      std::fclose(file);
    }
  }
};
const FromEnvironment from_environment;

}  // namespace
