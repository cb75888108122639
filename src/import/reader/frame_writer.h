#pragma once
/// \file
/// Sends frames of stream.h, gathered into large writes.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "import/stream.h"

namespace roam::reader {

class FrameWriter {
 public:
  /// Writes to an open descriptor, which it does not close.
  explicit FrameWriter(int descriptor) : descriptor_(descriptor) {}

  void send(FrameKind kind, std::span<const std::byte> payload);
  void send(FrameKind kind, const PayloadWriter& payload) { send(kind, payload.bytes()); }
  /// The next frame is the first of another stream.
  void begin_stream() { number_ = 0; }
  /// Writes out what is gathered. Ends the process when nobody listens any more.
  void flush();

 private:
  /// Writes what is gathered, and then the payload.
  void write(std::span<const std::byte> payload);

  int descriptor_;
  std::uint32_t number_ = 0;
  std::vector<std::byte> gathered_;
};

}  // namespace roam::reader
