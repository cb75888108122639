#include "import/reader/tileset/outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <unordered_set>
#include <utility>

#include "import/reader/named_file.h"
#include "import/reader/tileset/contents.h"
#include "import/reader/tileset/earth_place.h"
#include "import/reader/tileset/gzip.h"
#include "import/reader/tileset/subtree.h"
#include "import/reader/tileset/tile_json.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// A tileset that is being walked.
struct Tileset {
  fs::path file;
  UpAxis gltf_up = UpAxis::y;
  [[nodiscard]] fs::path folder() const { return file.parent_path(); }
};

/// Drops elements with a text that one before has. Some ten bytes of JSON may make any number of them.
template <class T, class TextOf>
void drop_repeated(std::vector<T>& list, const TextOf& text_of) {
  std::unordered_set<std::string> known;
  std::erase_if(list, [&](const T& element) { return !known.insert(text_of(element)).second; });
}

class OutlineWalk {
 public:
  OutlineWalk(SceneFiles& files, MeshSink& sink, Outline& outline)
      : files_(files), sink_(sink), outline_(outline), contents_(files) {}

  void walk(const fs::path& path, const ReadingSettings& settings) {
    const Json json = load(path);
    const Json& root = member(json, "root");
    const EarthPlace place = place_on_earth(root, transform_of(root, path.string()), path.string(), settings);
    outline_.georeference = place.georeference;
    outline_.notes = place.notes;
    open_.push_back(path);
    static_cast<void>(visit(root, tileset_of(json, path), place.to_scene, Refine::replace));
  }

 private:
  Json load(const fs::path& path) {
    outline_.files.push_back(path);
    return tileset_json(path, files_, sink_);
  }

  static Tileset tileset_of(const Json& json, const fs::path& path) { return {path, gltf_up_of(json)}; }

  /// Adds the finest contents of a tile and of the tiles below. Returns whether they are complete; if not, coarser
  /// contents should stand in for them.
  bool visit(const Json& tile, const Tileset& tileset, const glm::dmat4& parent, Refine inherited) {
    const Depth depth(*this, tileset.file);
    const glm::dmat4 matrix = parent * transform_of(tile, tileset.file.string());
    const Refine refine = refine_of(tile).value_or(inherited);
    if (auto tiling = ImplicitTiling::of(tile, tileset.file.string())) {
      tiling->contents = uris_of(tile);
      return visit_subtree(*tiling, {}, tileset, matrix, refine);
    }
    const Json& children = member(tile, "children");
    const auto visit_children = [&] {
      bool complete = true;
      for (const Json& child : children) complete = visit(child, tileset, matrix, refine) && complete;
      return complete;
    };
    return combine(refine, children.is_array() && !children.empty(), visit_children, uris_of(tile), tileset, matrix,
                   refine);
  }

  /// The rule of refinement, for explicit and implicit tiles.
  bool combine(Refine refine, bool has_children, const std::function<bool()>& visit_children,
               const std::vector<std::string>& own, const Tileset& tileset, const glm::dmat4& matrix,
               Refine inherited) {
    const auto add_own = [&] {
      bool complete = true;
      for (const std::string& uri : own) complete = add_content(uri, tileset, matrix, inherited) && complete;
      return complete;
    };
    if (!has_children) return add_own();
    if (refine == Refine::add) {
      const bool own_complete = add_own();
      return visit_children() && own_complete;
    }
    const std::size_t before = outline_.contents.size();
    const std::uint64_t stand_ins_before = outline_.stand_ins;
    if (visit_children()) return true;
    if (own.empty()) return false;
    // An incomplete level would leave holes. The coarser content replaces all of it.
    std::vector<TileContent> finer(
        std::make_move_iterator(outline_.contents.begin() + static_cast<std::ptrdiff_t>(before)),
        std::make_move_iterator(outline_.contents.end()));
    outline_.contents.resize(before);
    if (add_own()) {
      outline_.stand_ins = stand_ins_before + 1;
      return true;
    }
    outline_.contents.resize(before);
    std::move(finer.begin(), finer.end(), std::back_inserter(outline_.contents));
    return false;
  }

  bool visit_subtree(const ImplicitTiling& tiling, ImplicitTile root, const Tileset& tileset, const glm::dmat4& matrix,
                     Refine refine) {
    const std::string uri = ImplicitTiling::uri(tiling.subtrees, root);
    const fs::path file = contents_.place(tileset.folder(), uri);
    if (contents_.find(file).empty()) return missing(file.empty() ? uri : file.string());
    std::optional<std::string> bytes = whole_file(files_, file);
    if (!bytes) return missing(file.string());
    sink_.report_more_progress(bytes->size());
    outline_.files.push_back(file);
    const std::size_t before = outline_.contents.size();
    try {
      const Subtree subtree(without_gzip(std::move(*bytes), file.string()), file, tiling, files_);
      root.level_in_subtree = root.number = 0;
      return !subtree.has_tile(root) || visit_implicit(tiling, subtree, root, tileset, matrix, refine);
    } catch (const Error& error) {
      return damaged(file, before, error);
    }
  }

  bool visit_implicit(const ImplicitTiling& tiling, const Subtree& subtree, const ImplicitTile& tile,
                      const Tileset& tileset, const glm::dmat4& matrix, Refine refine) {
    const Depth depth(*this, tileset.file);
    std::vector<std::string> own;
    for (std::size_t i = 0; i < tiling.contents.size(); ++i) {
      if (subtree.has_content(tile, i)) own.push_back(ImplicitTiling::uri(tiling.contents[i], tile));
    }
    const bool last_of_subtree = tile.level_in_subtree + 1 == tiling.subtree_levels;
    std::vector<ImplicitTile> children;
    for (unsigned i = 0; i < tiling.children() && tile.level + 1 < tiling.levels; ++i) {
      const ImplicitTile child = tiling.child(tile, i);
      if (last_of_subtree ? subtree.has_subtree(child) : subtree.has_tile(child)) children.push_back(child);
    }
    const auto visit_children = [&] {
      bool complete = true;
      for (const ImplicitTile& child : children) {
        complete = (last_of_subtree ? visit_subtree(tiling, child, tileset, matrix, refine)
                                    : visit_implicit(tiling, subtree, child, tileset, matrix, refine)) &&
                   complete;
      }
      return complete;
    };
    return combine(refine, !children.empty(), visit_children, own, tileset, matrix, refine);
  }

  /// Returns whether the content is complete.
  bool add_content(const std::string& uri, const Tileset& tileset, const glm::dmat4& matrix, Refine inherited) {
    const fs::path file = contents_.place(tileset.folder(), uri);
    if (!is_finite(matrix)) {
      sink_.report_note_once(fmt::format("{}: the transforms of its tile overflow; it is left out.", file.string()));
      return missing(file.string());
    }
    switch (contents_.state_of(file)) {
      case TileContents::State::missing:
        return missing(file.empty() ? uri : file.string());
      case TileContents::State::points:
        ++outline_.points;
        if (outline_.point_files.size() < ImportReport::name_limit) outline_.point_files.push_back(file.string());
        return true;
      case TileContents::State::tileset:
        return visit_external(file, matrix, inherited);
      case TileContents::State::mesh:
        break;
    }
    outline_.contents.push_back({file, {matrix, tileset.gltf_up}});
    return true;
  }

  bool visit_external(const fs::path& file, const glm::dmat4& matrix, Refine inherited) {
    if (std::find(open_.begin(), open_.end(), file) != open_.end()) {
      sink_.report_note_once(fmt::format("{}: this tileset contains itself; it is read once.", file.string()));
      return missing(file.string());
    }
    const std::size_t before = outline_.contents.size();
    open_.push_back(file);
    bool complete = false;
    try {
      const Json json = load(file);
      complete = visit(member(json, "root"), tileset_of(json, file), matrix, inherited);
    } catch (const Error& error) {
      complete = damaged(file, before, error);
    }
    open_.pop_back();
    return complete;
  }

  bool missing(const std::string& file) {
    if (outline_.missing++ == 0) outline_.first_missing = file;
    sink_.report_missing_page(file);
    return false;
  }

  /// Leaves out a file, with all contents from `before` on.
  bool damaged(const fs::path& file, std::size_t before, const Error& error) {
    outline_.contents.resize(before);
    sink_.report_note_once(error.what());
    return missing(file.string());
  }

  /// Counts the tiles in each other.
  class Depth {
   public:
    Depth(OutlineWalk& walk, const fs::path& file) : walk_(walk) {
      if (walk_.depth_ >= tile_depth_limit) {
        throw Error(file.string(),
                    fmt::format("its tiles are nested more than {} deep; the tileset is damaged.", tile_depth_limit));
      }
      ++walk_.depth_;
    }
    ~Depth() { --walk_.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;

   private:
    OutlineWalk& walk_;
  };

  SceneFiles& files_;
  MeshSink& sink_;
  Outline& outline_;
  TileContents contents_;
  std::vector<fs::path> open_;  ///< the tilesets being walked, each named by the one before
  std::size_t depth_ = 0;
};

}  // namespace

Outline outline_of(const fs::path& tileset, SceneFiles& files, MeshSink& sink, const ReadingSettings& settings) {
  Outline outline;
  OutlineWalk(files, sink, outline).walk(tileset, settings);
  drop_repeated(outline.contents, [](const TileContent& content) { return token_of(content, {}); });
  drop_repeated(outline.files, [](const fs::path& file) { return file.string(); });
  return outline;
}

}  // namespace roam::reader
