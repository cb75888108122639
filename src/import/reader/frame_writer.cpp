#include "import/reader/frame_writer.h"

#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>

namespace roam::reader {
namespace {

/// Small frames are gathered up to this many bytes. Larger payloads are written directly.
constexpr std::size_t gather_bytes = 1u << 16;

}  // namespace

void FrameWriter::send(FrameKind kind, std::span<const std::byte> payload) {
  FrameHeader header;
  header.kind = kind;
  header.number = number_++;
  header.bytes = static_cast<std::uint32_t>(payload.size());
  const auto* first = reinterpret_cast<const std::byte*>(&header);
  gathered_.insert(gathered_.end(), first, first + sizeof(header));
  if (payload.size() >= gather_bytes) return write(payload);
  gathered_.insert(gathered_.end(), payload.begin(), payload.end());
  if (gathered_.size() >= gather_bytes) flush();
}

void FrameWriter::write(std::span<const std::byte> payload) {
  std::span<const std::byte> before = gathered_;
  while (before.size() + payload.size() > 0) {
    const std::array<iovec, 2> parts{{{const_cast<std::byte*>(before.data()), before.size()},
                                      {const_cast<std::byte*>(payload.data()), payload.size()}}};
    const ssize_t n = writev(descriptor_, parts.data(), static_cast<int>(parts.size()));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) _exit(EXIT_FAILURE);
    const auto written = static_cast<std::size_t>(n);
    const std::size_t of_before = std::min(written, before.size());
    before = before.subspan(of_before);
    payload = payload.subspan(written - of_before);
  }
  gathered_.clear();
}

void FrameWriter::fail(const Error& error) {
  send(FrameKind::failure, PayloadWriter().add_text(error.where()).add_text(error.what()));
  flush();
}

void FrameWriter::flush() { write({}); }

}  // namespace roam::reader
