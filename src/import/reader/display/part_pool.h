#pragma once
/// \file
/// Display geometry, gathered by look and sent in parts.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "import/reader/display/part_graph.h"
#include "import/reader/display/surface.h"
#include "import/reader/display/textures.h"
#include "import/reader/frame_writer.h"

namespace roam::reader {

class PartPool {
 public:
  /// `origin`: that of the previous paths. If unset, the first geometry sets it.
  PartPool(FrameWriter& frames, SceneFiles& files, std::optional<Vec3> origin)
      : frames_(frames), textures_(frames, files), origin_(origin) {}

  [[nodiscard]] Textures& textures() { return textures_; }

  /// Triangles from now on are of the object with these names: DisplayPart::objects.
  void begin_object(std::string names);
  /// Adds triangles with vertices in the frame of the scene. Sends a part when there is enough geometry.
  void add(std::span<const Vec3> vertices, std::span<const VertexLook> looks, std::span<const Corners> triangles,
           const Look& look);
  /// Sends all geometry gathered, because the next file has other textures. Of a page it becomes part of the page.
  void finish_file();

  /// Returns the origin. If it is unset, chooses it for a scene with these points.
  const Vec3& origin_near(std::span<const Vec3> places);
  /// Sends a complete part.
  void send(const PartGraph& graph);

  /// Begins a page: from now on all geometry belongs to one part, which end_page sends. Triangles go into the group
  /// that was set last, at first 0.
  PartGraph& begin_page();
  /// Sends the page that has begun, if there is one. Call finish_file before.
  void end_page();
  /// Null unless a page has begun.
  [[nodiscard]] PartGraph* page() { return page_ ? &*page_ : nullptr; }
  void set_group(std::uint32_t group) { group_ = group; }
  [[nodiscard]] std::uint32_t group() const { return group_; }

 private:
  struct Key {
    Look look;
    std::uint32_t group = 0;
    bool normals = false;
    auto operator<=>(const Key&) const = default;
  };
  using Gathered = std::map<Key, Surface>;

  void add_to(Surface& surface, std::span<const Vec3> vertices, std::span<const VertexLook> looks,
              std::span<const Corners> triangles, const Look& look, bool normals);
  void send_enough(const Look& look, std::size_t bytes);
  void send_where(const std::function<bool(const Look&)>& wanted);

  FrameWriter& frames_;
  Textures textures_;
  std::optional<Vec3> origin_;
  Gathered gathered_;
  std::vector<std::string> objects_;  ///< by number, since the last finish_file
  std::unordered_map<std::string, std::uint32_t> object_numbers_;
  std::string object_name_;              ///< of the triangles to come
  std::optional<std::uint32_t> object_;  ///< its number, once it has triangles
  std::optional<PartGraph> page_;
  std::uint32_t group_ = 0;
  std::size_t plain_bytes_ = 0, textured_bytes_ = 0;  ///< gathered without and with textures

  /// The surface index of each vertex of the mesh being added; valid if `mark` is the current one.
  struct Index {
    std::uint32_t mark = 0;
    std::uint32_t index = 0;
  };
  std::vector<Index> index_;
  std::uint32_t mark_ = 0;
};

}  // namespace roam::reader
