#include "import/reader/paged_vertices.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "import/reader/file_names.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

/// A triangle's corners lie in three blocks, and the last block stays.
constexpr std::uint64_t least_slots = 16;

Error refused(const char* verb, int reason) {
  return Error(fmt::format(
      "{}: the vertices of a large scene cannot be {} there: {}. Free some space, or name a folder that has some by "
      "the environment variable TMPDIR, or allow more memory.",
      temporary_folder(), verb, std::strerror(reason)));
}

/// A file that has no name, and is gone when it is closed; -1 when there can be none.
int open_unnamed_file() {
  const std::string folder = temporary_folder();
#ifdef O_TMPFILE
  if (const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600); file >= 0) return file;
#endif
  std::string name = folder + "/roam-vertices-XXXXXX";
  const int file = mkstemp(name.data());
  if (file >= 0) unlink(name.c_str());
  return file;
}

}  // namespace

PagedVertices::PagedVertices(std::uint64_t memory)
    : slot_limit_(static_cast<std::size_t>(std::clamp<std::uint64_t>(memory / sizeof(Block), least_slots, none))),
      file_(open_unnamed_file()),
      why_no_file_(errno) {}

PagedVertices::~PagedVertices() {
  if (file_ >= 0) close(file_);
}

void PagedVertices::clear() {
  size_ = 0;
  slot_of_.clear();
  written_.clear();
  filled_slots_ = 0;
  last_ = nullptr;
}

void PagedVertices::begin_block() {
  const std::uint32_t slot = free_slot();
  slots_[slot].block = slot_of_.size();
  slots_[slot].used = true;
  last_ = slots_[slot].vertices.get();
  slot_of_.push_back(slot);
  written_.push_back(false);
}

std::uint32_t PagedVertices::free_slot() {
  if (filled_slots_ < slot_limit_) {
    if (filled_slots_ == slots_.size()) slots_.push_back({std::make_unique_for_overwrite<Block>()});
    return static_cast<std::uint32_t>(filled_slots_++);
  }
  // The clock of Corbato (1968): what was used since the hand passed gets one round more. The last block is still
  // being filled; there are others.
  const std::uint64_t last = slot_of_.size() - 1;
  while (slots_[hand_].used || (slots_[hand_].block == last && size_ % block_size != 0)) {
    slots_[hand_].used = false;
    hand_ = (hand_ + 1) % slot_limit_;
  }
  const auto slot = static_cast<std::uint32_t>(hand_);
  hand_ = (hand_ + 1) % slot_limit_;
  const std::uint64_t block = slots_[slot].block;
  if (!written_[block]) write(block, *slots_[slot].vertices);
  slot_of_[block] = none;
  return slot;
}

void PagedVertices::write(std::uint64_t block, const Block& vertices) {
  if (file_ < 0) throw refused("kept", why_no_file_);
  const char* bytes = reinterpret_cast<const char*>(vertices.data());
  for (std::size_t done = 0; done < sizeof(Block);) {
    const ssize_t n =
        pwrite(file_, bytes + done, sizeof(Block) - done, static_cast<off_t>(block * sizeof(Block) + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw refused("kept", errno);
    done += static_cast<std::size_t>(n);
  }
  written_[block] = true;
}

std::uint32_t PagedVertices::load(std::uint64_t block) {
  const std::uint32_t slot = free_slot();
  char* bytes = reinterpret_cast<char*>(slots_[slot].vertices->data());
  for (std::size_t done = 0; done < sizeof(Block);) {
    const ssize_t n =
        pread(file_, bytes + done, sizeof(Block) - done, static_cast<off_t>(block * sizeof(Block) + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw refused("read", errno);
    done += static_cast<std::size_t>(n);
  }
  slots_[slot].block = block;
  slot_of_[block] = slot;
  return slot;
}

}  // namespace roam::reader
