#pragma once
/// \file
/// Writer of the frames of stream.h, gathered into large writes.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "import/stream.h"
#include "roam/error.h"

namespace roam::reader {

class FrameWriter {
 public:
  /// Writes to an open descriptor, and does not close it.
  explicit FrameWriter(int descriptor) : descriptor_(descriptor) {}

  void send(FrameKind kind, std::span<const std::byte> payload);
  void send(FrameKind kind, const PayloadWriter& payload) { send(kind, payload.bytes()); }
  /// Begins another stream: the next frame has number 0.
  void begin_stream() { number_ = 0; }
  /// Sends the last frame of a stream that ends with this error.
  void fail(const Error& error);
  /// Writes the gathered frames. Ends the process if the reading end is closed.
  void flush();

 private:
  /// Writes the gathered frames, then the payload.
  void write(std::span<const std::byte> payload);

  int descriptor_;
  std::uint32_t number_ = 0;
  std::vector<std::byte> gathered_;
};

}  // namespace roam::reader
