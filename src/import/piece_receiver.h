#pragma once
/// \file
/// A reader's pieces on their way to a PieceSink.

#include <limits>
#include <string>

#include "import/mesh_receiver.h"

namespace roam::reader {

/// Takes the frames of one reader and passes each complete piece on.
class PieceReceiver : public MeshReceiver {
 public:
  PieceReceiver(ImportReport& report, std::size_t ignore_patterns, const PieceSink& sink)
      : MeshReceiver(report, ignore_patterns, std::numeric_limits<std::uint64_t>::max()), sink_(sink) {}

 private:
  void begin(std::string name, bool continues) override;
  std::span<Vec3> more_vertices(std::size_t count) override;
  std::span<Corners> more_triangles(std::size_t count) override;
  void finish() override;

  const PieceSink& sink_;
  // The current piece; its memory is reused.
  bool continues_ = false;
  Mesh piece_;
};

}  // namespace roam::reader
