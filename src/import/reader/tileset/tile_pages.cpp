#include "import/reader/tileset/tile_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "import/reader/display/page_token.h"
#include "import/reader/display/part_graph.h"
#include "import/reader/display/part_pool.h"
#include "import/reader/file_names.h"
#include "import/reader/named_file.h"
#include "import/reader/tileset/contents.h"
#include "import/reader/tileset/earth_place.h"
#include "import/reader/tileset/gzip.h"
#include "import/reader/tileset/tile_content.h"
#include "roam/error.h"
#include "roam/mesh.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Most contents that come together in one page. Real tiles have eight children at most, some of them without content.
constexpr std::size_t together_limit = 1000;
/// Most tiles that one page passes through or shows.
constexpr std::size_t visit_limit = 100'000;
/// Most tilesets in each other.
constexpr std::size_t tileset_limit = 64;
/// Tiles that are kept; some 300 bytes each.
constexpr std::size_t tiles_kept = 1'000'000;
constexpr float always = std::numeric_limits<float>::max();
/// Values of pages by error are multiples of the allowed error.
constexpr float allowed = 1.0f;

/// Where a tile lies, and what it has from the tiles above it.
struct Place {
  glm::dmat4 matrix{1.0};
  Refine refine = Refine::replace;
  double error = 0.0;                                        ///< metres
  Box box{Vec3(-coordinate_limit), Vec3(coordinate_limit)};  ///< before turning and scaling; all if there is none
};

double scale_of(const glm::dmat4& m) { return std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])}); }

Place place_of(const TileRef& tile, const TileTree& tree) {
  std::vector<const TreeTile*> down{&tree.tiles.at(tile.number)};
  for (std::uint32_t at = tile.number; at != 0; at = tree.tiles[at].parent) {
    down.push_back(&tree.tiles[tree.tiles[at].parent]);
  }
  Place place{tile.above, tile.refine, tile.error};
  for (auto at = down.rbegin(); at != down.rend(); ++at) {
    const TreeTile& one = **at;
    if (one.transform != nullptr) place.matrix = place.matrix * *one.transform;
    place.refine = one.refine.value_or(place.refine);
    if (one.error) place.error = *one.error * scale_of(place.matrix);
    const bool is_part = tile.implicit && &one == down.front() && one.tiling != nullptr;
    const TileVolume volume = is_part ? one.volume.part(*tile.implicit, one.tiling->dimensions) : one.volume;
    if (const auto box = volume.around(place.matrix, tile.earth)) place.box = *box;
  }
  if (tile.implicit) place.error = std::ldexp(place.error, -static_cast<int>(tile.implicit->level));
  return place;
}

/// The node of a tile: its place in the frame of the scene, without levels.
DisplayPages node_of(const Place& place, const MeshSink& sink, Box& bounds) {
  const std::array<Vec3, 4> frame = sink.placement();
  for (const Vec3& corner : {place.box.lower, place.box.upper}) {
    bounds.include(frame[0] + corner.x * frame[1] + corner.y * frame[2] + corner.z * frame[3]);
  }
  constexpr double limit = coordinate_limit;
  bounds = {glm::clamp(bounds.lower, -limit, limit), glm::clamp(bounds.upper, -limit, limit)};
  DisplayPages node;
  node.measure = DisplayMeasure::error;
  node.center = bounds.center();
  node.half = glm::vec3(0.5 * bounds.size());
  node.radius = static_cast<float>(0.5 * glm::length(bounds.size()));
  const double error = place.error * glm::length(frame[1]);
  // A NaN counts as too large.
  node.error = static_cast<float>(error <= limit ? error : limit);
  return node;
}

/// Decides what a page shows, and then reads it.
class TilePageWalk {
 public:
  TilePageWalk(SceneFiles& files, MeshSink& sink, TileTrees& trees)
      : files_(files), sink_(sink), trees_(trees), contents_(files), part_(*sink.parts()->page()) {}

  void walk(const TilePage& page) {
    bool complete = true;
    if (page.of_children) {
      const std::vector<TileRef> children = children_of(page.tile);
      for (const TileRef& child : children) complete = show(child, 0, true) && complete;
      complete = complete && !children.empty();
    } else {
      static_cast<void>(show(page.tile, 0, false));
      complete = missing_.empty() || has_anything_;
    }
    if (!complete && missing_.empty()) missing(page.tile.file.string());
    if (!complete) throw Error(missing_[0]);
    for (const Error& error : missing_) {
      sink_.report_note_once(error.what());
      sink_.report_missing_page(error.where());
    }
    for (const auto& [group, file, place] : planned_) {
      sink_.set_group(group);
      if (read_tile_content(file, place, files_, sink_)) sink_.report_missing_page(file.string());
    }
  }

 private:
  struct Planned {
    std::uint32_t group = 0;
    fs::path file;
    TilePlace place;
  };

  const TileTree& tree_of(const TileRef& tile) {
    const TileTree& tree = trees_.of(tile.file, files_, sink_);
    if (tile.number >= tree.tiles.size()) throw Error(tile.file.string(), "this tileset has changed; open it anew.");
    return tree;
  }
  const TreeTile& tree_tile(const TileRef& tile) { return tree_of(tile).tiles[tile.number]; }

  bool missing(Error error) {
    if (missing_.size() < ImportReport::name_limit) missing_.push_back(std::move(error));
    return false;
  }
  bool missing(const std::string& file) { return missing(Error(file, "this tile is absent or cannot be read.")); }

  /// The subtree of an implicit tile, whose numbers in it are set; null if it is missing.
  const Subtree* subtree_of(const TileRef& ref, ImplicitTile& tile);
  std::vector<std::string> uris_of(const TileRef& tile);
  std::vector<TileRef> children_of(TileRef tile);

  /// Plans a tile and what is below. `together`: it replaces a coarser one with others of this page, so that nothing
  /// may be missing, and nothing be left to other pages before the first content on each way down. Returns whether
  /// nothing is missing.
  bool show(TileRef tile, std::uint32_t group, bool together);
  bool show_within_depth(TileRef tile, std::uint32_t group, bool together);
  bool show_tilesets(const std::vector<TileRef>& tilesets, std::uint32_t group, bool together);
  void add_page(std::uint32_t group, const TilePage& page, const Place& place);
  /// Adds a node whose levels are a group for the tile's own contents, if there are any, and what is finer.
  std::uint32_t add_node(std::uint32_t group, const TileRef& tile, const Place& place, bool has_content,
                         const std::vector<TileRef>& children);

  SceneFiles& files_;
  MeshSink& sink_;
  TileTrees& trees_;
  TileContents contents_;
  PartGraph& part_;
  /// Null: missing. One file may serve several tilings, each of which says how long its parts are.
  std::map<std::pair<const ImplicitTiling*, fs::path>, std::unique_ptr<Subtree>> subtrees_;
  std::vector<Planned> planned_;
  std::vector<Error> missing_;
  bool has_anything_ = false;
  std::size_t depth_ = 0;    ///< tiles in each other
  std::size_t visited_ = 0;  ///< tiles
};

const Subtree* TilePageWalk::subtree_of(const TileRef& ref, ImplicitTile& tile) {
  const TreeTile& of = tree_tile(ref);
  if (of.tiling == nullptr) throw Error(ref.file.string(), "this tileset has changed; open it anew.");
  const ImplicitTiling& tiling = *of.tiling;
  tile.level_in_subtree = tile.level % tiling.subtree_levels;
  const std::uint64_t shift = tile.level_in_subtree;
  const ImplicitTile root{tile.level - shift, tile.x >> shift, tile.y >> shift, tile.z >> shift};
  tile.number = 0;
  for (std::uint64_t bit = shift; bit-- > 0;) {
    const std::uint64_t which = (tile.x >> bit & 1) | (tile.y >> bit & 1) << 1 | (tile.z >> bit & 1) << 2;
    tile.number = (tile.number << tiling.dimensions) + which;
  }
  const std::string uri = ImplicitTiling::uri(tiling.subtrees, root);
  const fs::path file = contents_.place(ref.file.parent_path(), uri);
  const auto [at, is_new] = subtrees_.try_emplace({&tiling, file.empty() ? fs::path(uri) : file});
  if (!is_new) return at->second.get();
  std::optional<std::string> bytes = contents_.find(file).empty() ? std::nullopt : whole_file(files_, file);
  try {
    if (!bytes) throw Error(file.empty() ? uri : file.string(), "this subtree is absent or cannot be read.");
    at->second = std::make_unique<Subtree>(without_gzip(std::move(*bytes), file.string()), file, tiling, files_);
  } catch (const Error& error) {
    missing(error);
  }
  return at->second.get();
}

std::vector<std::string> TilePageWalk::uris_of(const TileRef& ref) {
  const TreeTile& tile = tree_tile(ref);
  if (!ref.implicit) return tile.uris;
  ImplicitTile at = *ref.implicit;
  const Subtree* subtree = subtree_of(ref, at);
  std::vector<std::string> uris;
  for (std::size_t i = 0; subtree != nullptr && i < tile.tiling->contents.size(); ++i) {
    if (subtree->has_content(at, i)) uris.push_back(ImplicitTiling::uri(tile.tiling->contents[i], at));
  }
  return uris;
}

std::vector<TileRef> TilePageWalk::children_of(TileRef ref) {
  const TreeTile& tile = tree_tile(ref);
  std::vector<TileRef> children;
  if (tile.tiling != nullptr) {
    const ImplicitTiling& tiling = *tile.tiling;
    ImplicitTile at = ref.implicit.value_or(ImplicitTile{});
    const Subtree* subtree = subtree_of(ref, at);
    const bool last_of_subtree = at.level_in_subtree + 1 == tiling.subtree_levels;
    for (unsigned i = 0; subtree != nullptr && i < tiling.children() && at.level + 1 < tiling.levels; ++i) {
      const ImplicitTile child = tiling.child(at, i);
      if (!(last_of_subtree ? subtree->has_subtree(child) : subtree->has_tile(child))) continue;
      ref.implicit = child;
      children.push_back(ref);
    }
    return children;
  }
  for (const std::uint32_t child : tile.children) {
    ref.number = child;
    children.push_back(ref);
  }
  return children;
}

bool TilePageWalk::show(TileRef ref, std::uint32_t group, bool together) {
  if (depth_ == tile_depth_limit || ++visited_ > visit_limit) {
    return missing(Error(ref.file.string(), "too many tiles without a content are nested in it; it is damaged."));
  }
  ++depth_;
  const bool complete = show_within_depth(std::move(ref), group, together);
  --depth_;
  return complete;
}

bool TilePageWalk::show_within_depth(TileRef ref, std::uint32_t group, bool together) {
  if (tree_tile(ref).tiling != nullptr && !ref.implicit) ref.implicit = ImplicitTile{};
  if (ref.implicit) {
    const Subtree* subtree = subtree_of(ref, *ref.implicit);
    if (subtree == nullptr) return false;
    if (!subtree->has_tile(*ref.implicit)) return true;
  }
  const TileTree& tree = tree_of(ref);
  const Place place = place_of(ref, tree);
  bool own_complete = true;
  std::vector<fs::path> meshes;
  std::vector<TileRef> tilesets;
  for (const std::string& uri : uris_of(ref)) {
    const fs::path file = contents_.place(ref.file.parent_path(), uri);
    const TileContents::State state = is_finite(place.matrix) ? contents_.state_of(file) : TileContents::State::missing;
    if (state == TileContents::State::missing) {
      own_complete = missing(file.empty() ? uri : file.string());
    } else if (state == TileContents::State::points) {
      sink_.report_note_once(fmt::format("{}: point clouds have no surface; they are left out.", file.string()));
    } else if (state == TileContents::State::mesh) {
      meshes.push_back(file);
    } else {
      TileRef root{file, 0, {}, place.matrix, ref.earth, place.refine, place.error, ref.around};
      root.around.push_back(hash_of(ref.file));
      tilesets.push_back(std::move(root));
    }
  }
  const std::vector<TileRef> children = children_of(ref);
  has_anything_ = has_anything_ || !meshes.empty() || !children.empty();
  const bool passes_through = meshes.empty() && (together || children.empty());
  if (!passes_through) {
    if (!children.empty()) group = add_node(group, ref, place, !meshes.empty(), children);
    for (const fs::path& file : meshes) planned_.push_back({group, file, {place.matrix, tree.gltf_up}});
  }
  const bool are_replaced = passes_through && !children.empty() && place.refine == Refine::replace;
  const bool tilesets_complete = are_replaced || show_tilesets(tilesets, group, together);
  if (!passes_through || children.empty()) return own_complete && tilesets_complete;
  if (planned_.size() > together_limit) {
    for (const TileRef& child : children) add_page(group, {child, false}, place_of(child, tree));
    return are_replaced || (own_complete && tilesets_complete);
  }
  bool complete = true;
  for (const TileRef& child : children) complete = show(child, group, true) && complete;
  return complete && (are_replaced || (own_complete && tilesets_complete));
}

bool TilePageWalk::show_tilesets(const std::vector<TileRef>& tilesets, std::uint32_t group, bool together) {
  bool complete = true;
  for (const TileRef& root : tilesets) {
    try {
      const std::uint64_t own = hash_of(root.file);
      if (std::find(root.around.begin(), root.around.end(), own) != root.around.end() ||
          root.around.size() > tileset_limit) {
        throw Error(root.file.string(), "this tileset contains itself, or is in too many others; it is left out.");
      }
      static_cast<void>(tree_of(root));
    } catch (const Error& error) {
      complete = missing(error);
      continue;
    }
    complete = show(root, group, together) && complete;
  }
  return complete;
}

void TilePageWalk::add_page(std::uint32_t group, const TilePage& page, const Place& place) {
  Box bounds;
  DisplayPages node = node_of(place, sink_, bounds);
  node.group = group;
  std::string token = token_of(page);
  if (token.empty()) {
    missing(page.tile.file.string());
    return;
  }
  node.levels.push_back({0.0f, always, 0, std::move(token)});
  part_.add_pages(std::move(node), bounds);
}

std::uint32_t TilePageWalk::add_node(std::uint32_t group, const TileRef& tile, const Place& place, bool has_content,
                                     const std::vector<TileRef>& children) {
  Box bounds;
  DisplayPages node = node_of(place, sink_, bounds);
  node.group = group;
  const bool replaces = has_content && place.refine == Refine::replace;
  const std::uint32_t own = part_.add_group();
  node.levels.push_back({0.0f, replaces ? allowed : always, own, {}});
  std::uint32_t finer = 0;
  if (replaces) {
    if (std::string token = token_of(TilePage{tile, true}); !token.empty()) {
      node.levels.push_back({allowed, always, 0, std::move(token)});
    } else {
      missing(tile.file.string());
    }
  } else {
    finer = part_.add_group();
    node.levels.push_back({allowed, always, finer, {}});
  }
  part_.add_pages(std::move(node), bounds);
  if (!replaces) {
    for (const TileRef& child : children) add_page(finer, {child, false}, place_of(child, tree_of(child)));
  }
  return own;
}

}  // namespace

bool hand_on_pages(const fs::path& tileset, SceneFiles& files, MeshSink& sink, const ReadingSettings& settings) {
  const fs::path file = fs::absolute(tileset).lexically_normal();
  const Json json = tileset_json(file, files, sink);
  const TileTree tree = tree_of(json, file);
  const TreeTile& root = tree.tiles[0];
  const auto is_tileset = [](const std::string& uri) { return extension_of(uri) == "json"; };
  const bool has_more =
      tree.tiles.size() > 1 || root.tiling != nullptr || std::any_of(root.uris.begin(), root.uris.end(), is_tileset);
  if (!has_more) return false;
  const glm::dmat4 transform = root.transform == nullptr ? glm::dmat4(1.0) : *root.transform;
  const EarthPlace earth = place_on_earth(member(json, "root"), transform, tileset.string(), settings);
  TileRef ref{file, 0, {}, earth.to_scene, earth.to_scene};
  // Without any error the finer tiles are always drawn.
  const double error = number(member(json, "geometricError"), 0.0);
  ref.error = error > 0.0 ? error : coordinate_limit;
  if (!root.volume.around(earth.to_scene * transform, earth.to_scene)) return false;
  for (const std::string& note : earth.notes) sink.report_note(note);
  if (earth.georeference) sink.report_georeference(*earth.georeference);
  Box bounds;
  DisplayPages node = node_of(place_of(ref, tree), sink, bounds);
  node.levels.push_back({0.0f, always, 0, token_of(TilePage{ref, false})});
  if (node.levels[0].page.empty()) return false;
  const Vec3 center = bounds.center();
  PartGraph part(sink.parts()->textures(), sink.parts()->origin_near({&center, 1}));
  part.add_pages(std::move(node), bounds);
  sink.parts()->send(part);
  return true;
}

const TileTree& TileTrees::of(const fs::path& file, SceneFiles& files, MeshSink& sink) {
  last_ = file;
  const auto known = trees_.find(file);
  if (known != trees_.end()) return known->second;
  TileTree tree = tree_of(tileset_json(file, files, sink), file);
  tiles_ += tree.tiles.size();
  return trees_.emplace(file, std::move(tree)).first->second;
}

void TileTrees::shrink() {
  if (tiles_ <= tiles_kept) return;
  std::erase_if(trees_, [this](const auto& tree) { return tree.first != last_; });
  tiles_ = trees_.empty() ? 0 : trees_.begin()->second.tiles.size();
}

void read_tile_page(const TilePage& page, SceneFiles& files, MeshSink& sink, TileTrees& trees) {
  trees.shrink();
  sink.parts()->begin_page();
  TilePageWalk(files, sink, trees).walk(page);
}

}  // namespace roam::reader
