#pragma once
/// \file
/// Receiver of display parts.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "import/display.h"
#include "import/stream_receiver.h"

namespace roam::reader {

/// Takes the frames of one reader, passes each complete part on, and adds it to the report.
class PartReceiver : public StreamReceiver {
 public:
  /// `origin`: that of all parts, unset before the first. `part_bytes`: most bytes of parts that this reader may still
  /// send. A part of more than half the remaining bytes is refused, because its bytes and the part decoded from them
  /// are in memory together for a moment. `take` throws Cancelled if `give` returns false.
  PartReceiver(DisplayReport& report, std::optional<Vec3>& origin, std::size_t ignore_patterns,
               std::uint64_t part_bytes, const std::function<bool(DisplayPart&&)>& give);

  [[nodiscard]] std::uint64_t triangles() const override { return triangles_; }
  /// Bytes of the parts received, and of their nodes.
  [[nodiscard]] std::uint64_t bytes_taken() const { return bytes_taken_; }

 private:
  void take_content(FrameKind kind, std::span<const std::byte> payload) override;
  void finish_content(const Totals& totals) override;
  void begin_part(std::span<const std::byte> payload);
  void finish_part();

  DisplayReport& display_;
  std::optional<Vec3>& origin_;
  const std::function<bool(DisplayPart&&)>& give_;
  const std::uint64_t part_bytes_;
  std::uint64_t triangles_ = 0;

  DisplayPart part_;
  std::vector<std::byte> bytes_;  ///< bytes of part_ so far
  std::uint64_t bytes_taken_ = 0;
  std::uint64_t bytes_missing_ = 0;  ///< bytes of part_ still to come
};

}  // namespace roam::reader
