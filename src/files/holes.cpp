#include "files/holes.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace roam::files {

DataRange next_data([[maybe_unused]] int descriptor, std::int64_t from, std::int64_t size) noexcept {
#if defined(SEEK_HOLE) && defined(SEEK_DATA)
  if (from >= size) return {size, size};
  const off_t begin = ::lseek(descriptor, from, SEEK_DATA);
  if (begin < 0 && errno == ENXIO) return {size, size};  // a hole up to the end
  if (begin >= from) {
    const off_t end = ::lseek(descriptor, begin, SEEK_HOLE);
    return {std::min<std::int64_t>(begin, size), end > begin ? std::min<std::int64_t>(end, size) : size};
  }
#endif
  return {from, size};
}

bool is_mostly_holes(int descriptor) noexcept {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return false;
  const std::int64_t size = status.st_size;
  std::int64_t data = 0;
  for (DataRange range = next_data(descriptor, 0, size); range.begin < range.end;
       range = next_data(descriptor, range.end, size)) {
    data += range.end - range.begin;
  }
  ::lseek(descriptor, 0, SEEK_SET);
  const auto holes = static_cast<std::uint64_t>(std::max<std::int64_t>(size - data, 0));
  return holes > most_holes && (holes - most_holes) / holes_per_byte > static_cast<std::uint64_t>(data);
}

}  // namespace roam::files
