#pragma once
/// \file
/// What is to be seen, gathered by its look and sent in parts.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "import/reader/display/part_graph.h"
#include "import/reader/display/surface.h"
#include "import/reader/display/textures.h"
#include "import/reader/frame_writer.h"

namespace roam::reader {

class PartPool {
 public:
  /// `origin`: that of the paths before; unset, the first geometry decides it.
  PartPool(FrameWriter& frames, SceneFiles& files, std::optional<Vec3> origin)
      : frames_(frames), textures_(frames, files), origin_(origin) {}

  [[nodiscard]] Textures& textures() { return textures_; }

  /// Adds triangles, their vertices in the frame of the scene, and sends what is enough for a part.
  void add(std::span<const Vec3> vertices, std::span<const VertexLook> looks, std::span<const Corners> triangles,
           const Look& look);
  /// Sends all that is gathered: what follows has other textures.
  void finish_file();

  /// Chooses the origin, unless it is known, for a scene that has these places.
  const Vec3& origin_near(std::span<const Vec3> places);
  /// Sends a part that is made already.
  void send(const PartGraph& graph, const Box& bounds, std::uint64_t triangles, bool paged);

 private:
  using Key = std::pair<Look, bool>;  ///< and whether there are normals
  using Gathered = std::map<Key, Surface>;

  void add_to(Surface& surface, std::span<const Vec3> vertices, std::span<const VertexLook> looks,
              std::span<const Corners> triangles, const Look& look, bool normals);
  void send_where(const std::function<bool(const Look&)>& wanted);

  FrameWriter& frames_;
  Textures textures_;
  std::optional<Vec3> origin_;
  Gathered gathered_;
  std::size_t plain_bytes_ = 0, textured_bytes_ = 0;  ///< gathered without and with texture

  /// The index in the surface of each vertex of the mesh that is being added, where its mark is the current one.
  struct Index {
    std::uint32_t mark = 0;
    std::uint32_t index = 0;
  };
  std::vector<Index> index_;
  std::uint32_t mark_ = 0;
};

}  // namespace roam::reader
