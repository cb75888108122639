#pragma once
/// \file
/// Checks of a reader's pieces on their way to a PieceSink.

#include <cstddef>
#include <cstdint>
#include <span>

#include "import/stream_receiver.h"

namespace roam::reader {

/// Takes the frames of one reader and passes each complete piece on.
class PieceReceiver : public StreamReceiver {
 public:
  PieceReceiver(ImportReport& report, std::size_t ignore_patterns, const PieceSink& sink);

  [[nodiscard]] std::uint64_t triangles() const override { return triangles_; }

 private:
  void take_content(FrameKind kind, std::span<const std::byte> payload) override;
  void finish_content(const Totals& totals) override;
  void begin_piece(std::span<const std::byte> payload);
  void take_vertices(std::span<const std::byte> payload);
  void take_triangles(std::span<const std::byte> payload);
  void finish_piece();

  const PieceSink& sink_;
  std::uint64_t vertices_ = 0, triangles_ = 0;

  // The current piece; its memory is reused.
  bool in_piece_ = false;
  bool continues_ = false;
  Mesh piece_;
};

}  // namespace roam::reader
