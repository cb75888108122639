#pragma once
/// \file
/// The checks that a reader's frames must pass on their way into a scene.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "import/stream.h"
#include "roam/import.h"

namespace roam::reader {

/// Takes the frames of one reader and appends what they say to a scene.
class Assembler {
 public:
  /// `mesh_bytes`: most bytes of vertices and triangles that this reader may still send.
  Assembler(Scene& scene, std::size_t ignore_patterns, std::uint64_t mesh_bytes);

  /// Takes the next bytes of the stream. Throws StreamDamaged, MeshesTooLarge, or Failure.
  void take(std::span<const std::byte> bytes);

  /// Whether the reader has said that it is done; nothing may follow.
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] std::uint64_t bytes_read() const { return bytes_read_; }
  [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
  /// For each pattern of ImportOptions::ignore whether an object's name matched it; known once ended.
  [[nodiscard]] const std::vector<bool>& matched() const { return matched_; }

  /// The stream breaks its own rules: the reader is broken.
  struct StreamDamaged {
    std::string how;
  };
  /// More than mesh_bytes arrived.
  struct MeshesTooLarge {};
  /// What the reader itself says is wrong with the file.
  struct Failure {
    std::string sentence;
  };

 private:
  void handle(const FrameHeader& header, std::span<const std::byte> payload);
  void take_vertices(std::span<const std::byte> payload);
  void take_triangles(std::span<const std::byte> payload);
  void take_left_out(PayloadReader& fields);
  void take_end(PayloadReader& fields);
  void finish_mesh();
  void count_bytes(std::size_t bytes);

  Scene& scene_;
  std::size_t ignore_patterns_;
  std::uint64_t mesh_bytes_left_;
  std::vector<std::byte> pending_;
  std::uint32_t next_number_ = 0;
  bool ended_ = false;
  std::uint64_t bytes_read_ = 0, vertices_ = 0, triangles_ = 0;
  std::vector<bool> matched_;

  // The mesh in the making, in the pieces it came in: joined once their number is known, never grown by copying.
  bool in_mesh_ = false;
  std::string name_;
  std::uint64_t mesh_vertices_ = 0;
  std::vector<std::vector<Vec3>> vertex_pieces_;
  std::vector<std::vector<std::array<std::uint32_t, 3>>> triangle_pieces_;
};

}  // namespace roam::reader
