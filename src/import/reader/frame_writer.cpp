#include "import/reader/frame_writer.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace roam::reader {
namespace {

/// Small frames are gathered up to this many bytes.
constexpr std::size_t gather_bytes = 1u << 20;

}  // namespace

void FrameWriter::send(FrameKind kind, std::span<const std::byte> payload) {
  FrameHeader header;
  header.kind = kind;
  header.number = number_++;
  header.bytes = static_cast<std::uint32_t>(payload.size());
  const auto* first = reinterpret_cast<const std::byte*>(&header);
  gathered_.insert(gathered_.end(), first, first + sizeof(header));
  gathered_.insert(gathered_.end(), payload.begin(), payload.end());
  if (gathered_.size() >= gather_bytes) flush();
}

void FrameWriter::flush() {
  std::size_t written = 0;
  while (written < gathered_.size()) {
    const ssize_t n = write(descriptor_, gathered_.data() + written, gathered_.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) _exit(EXIT_FAILURE);
    written += static_cast<std::size_t>(n);
  }
  gathered_.clear();
}

}  // namespace roam::reader
