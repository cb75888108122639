#pragma once
/// \file
/// Checks of a reader's meshes or pieces.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "import/stream_receiver.h"

namespace roam::reader {

/// Takes the frames of one reader that sends objects, whole or in pieces. Derived classes keep them.
class MeshReceiver : public StreamReceiver {
 public:
  using StreamReceiver::StreamReceiver;
  [[nodiscard]] std::uint64_t triangles() const override { return triangles_; }
  [[nodiscard]] std::uint64_t vertices() const override { return vertices_; }

 protected:
  using Corners = std::array<std::uint32_t, 3>;

  virtual void begin(std::string name, bool continues) = 0;
  /// Room for so many more of the object or piece. All of it is filled.
  virtual std::span<Vec3> more_vertices(std::size_t count) = 0;
  virtual std::span<Corners> more_triangles(std::size_t count) = 0;
  /// The object or piece is complete.
  virtual void finish() = 0;

 private:
  void take_content(FrameKind kind, std::span<const std::byte> payload) override;
  void finish_content(const Totals& totals) override;
  void begin_object(std::span<const std::byte> payload);
  void take_vertices(std::span<const std::byte> payload);
  void take_triangles(std::span<const std::byte> payload);
  void finish_object();

  std::uint64_t vertices_ = 0, triangles_ = 0;
  bool in_object_ = false;
  std::uint64_t object_vertices_ = 0;
};

}  // namespace roam::reader
