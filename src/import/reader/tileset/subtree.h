#pragma once
/// \file
/// Implicit tiling: quadtrees and octrees whose tiles are bits of subtree files.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/reader/json.h"
#include "import/reader/scene_files.h"
#include "roam/error.h"

namespace roam::reader {

/// A tile of an implicit tree. Its number counts the tiles of its level within its subtree along the Morton curve.
struct ImplicitTile {
  std::uint64_t level = 0, x = 0, y = 0, z = 0;
  std::uint64_t level_in_subtree = 0, number = 0;
};

struct ImplicitTiling {
  unsigned dimensions = 2;  ///< 2: quadtree, 3: octree
  std::uint64_t subtree_levels = 0, levels = 0;
  std::string subtrees;               ///< template of the URIs of subtrees
  std::vector<std::string> contents;  ///< templates of the URIs of contents

  /// That of a tile; unset if it is an explicit tile. `contents` stays empty. Throws roam::Error at `place` if it is
  /// damaged.
  [[nodiscard]] static std::optional<ImplicitTiling> of(const Json& tile, const std::string& place);

  /// The number of children of a tile.
  [[nodiscard]] unsigned children() const { return 1u << dimensions; }
  [[nodiscard]] ImplicitTile child(const ImplicitTile& tile, unsigned which) const;
  /// A template with the tile's numbers in place of {level}, {x}, {y} and {z}.
  [[nodiscard]] static std::string uri(const std::string& from, const ImplicitTile& tile);
};

class Subtree {
 public:
  /// `bytes`: a .subtree file, or its JSON form. `file`: for messages; its folder has the buffers that it names. Throws
  /// roam::Error if it is damaged.
  Subtree(std::string bytes, const std::filesystem::path& file, const ImplicitTiling& tiling, SceneFiles& files);
  Subtree(const Subtree&) = delete;
  Subtree& operator=(const Subtree&) = delete;

  [[nodiscard]] bool has_tile(const ImplicitTile& tile) const;
  /// Whether the tile has the content of that number.
  [[nodiscard]] bool has_content(const ImplicitTile& tile, std::size_t which) const;
  /// Whether a tile one level below this subtree is the root of another one.
  [[nodiscard]] bool has_subtree(const ImplicitTile& tile) const;

 private:
  struct Bits {
    bool constant = false;
    std::string_view bytes{};  ///< empty: all are `constant`
    [[nodiscard]] bool operator[](std::uint64_t i) const;
  };
  [[nodiscard]] Bits bits(const Json& availability, std::uint64_t count);
  [[nodiscard]] std::string_view buffer(std::uint64_t index);
  [[nodiscard]] Error damaged(const char* what) const;
  [[nodiscard]] std::uint64_t index_of(const ImplicitTile& tile) const;

  const ImplicitTiling& tiling_;
  std::filesystem::path file_;
  SceneFiles& files_;
  std::string bytes_;
  std::string_view chunk_;
  Json json_;
  std::vector<std::optional<std::string>> buffers_;
  Bits tiles_, subtrees_;
  std::vector<Bits> contents_;
};

}  // namespace roam::reader
