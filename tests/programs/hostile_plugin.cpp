// A library that leaves a mark where it is loaded, as the plugin of a hostile scene would.

#include <fcntl.h>
#include <unistd.h>

namespace {

struct Mark {
  Mark() {
    const int file = open("PWNED-by-so", O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    if (file >= 0) close(file);
  }
} mark;

}  // namespace
