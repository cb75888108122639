#include "files/holes.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

namespace roam::files {

bool is_mostly_holes([[maybe_unused]] int descriptor) noexcept {
#if defined(SEEK_HOLE) && defined(SEEK_DATA)
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return false;
  const auto size = static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
  if (size <= most_holes) return false;
  std::uint64_t data = 0;
  for (off_t at = 0; at < status.st_size;) {
    const off_t begin = ::lseek(descriptor, at, SEEK_DATA);
    if (begin < at) break;  // a hole up to the end, or not supported
    const off_t end = ::lseek(descriptor, begin, SEEK_HOLE);
    if (end <= begin) {
      data = size;  // not supported
      break;
    }
    data += static_cast<std::uint64_t>(std::min(end, status.st_size) - begin);
    at = end;
  }
  const bool unsupported = data == 0 && ::lseek(descriptor, 0, SEEK_HOLE) < 0;
  ::lseek(descriptor, 0, SEEK_SET);
  return !unsupported && size - data > most_holes && (size - data - most_holes) / holes_per_byte > data;
#else
  return false;
#endif
}

}  // namespace roam::files
