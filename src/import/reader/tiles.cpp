#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/reader/display/pages.h"
#include "import/reader/formats.h"
#include "import/reader/numbers.h"
#include "import/reader/osg_files.h"
#include "import/reader/scene_graph.h"
#include "roam/error.h"
#include "text/reference_system.h"

// The layout of ContextCapture, which most photogrammetry programs export:
// metadata.xml and Data/Tile_*/Tile_*.osgb, each the root of a tree of pages in its own folder.

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

std::string text_of(const tinyxml2::XMLElement& parent, const char* name) {
  const tinyxml2::XMLElement* element = parent.FirstChildElement(name);
  const char* text = element == nullptr ? nullptr : element->GetText();
  return text == nullptr ? "" : std::string(trimmed(text));
}

std::optional<Vec3> three_numbers(std::string_view text) {
  Vec3 v{0.0};
  for (int k = 0; k < 3; ++k) {
    const auto comma = text.find(',');
    if ((comma == std::string_view::npos) != (k == 2)) return std::nullopt;
    if (!parse(trimmed(text.substr(0, comma)), v[k]) || !std::isfinite(v[k])) return std::nullopt;
    text = k == 2 ? std::string_view() : text.substr(comma + 1);
  }
  return v;
}

std::optional<Georeference> georeference_in(const fs::path& file, SceneFiles& files, MeshSink& sink) {
  if (files.open(file).empty()) return std::nullopt;
  tinyxml2::XMLDocument document;
  if (document.LoadFile(file.string().c_str()) == tinyxml2::XML_SUCCESS) {
    if (const tinyxml2::XMLElement* root = document.FirstChildElement("ModelMetadata")) {
      const std::string origin_text = text_of(*root, "SRSOrigin");
      if (const auto origin = three_numbers(origin_text)) return Georeference{text_of(*root, "SRS"), *origin};
    }
  }
  sink.report_note(
      fmt::format("{}: this file holds no SRSOrigin of three numbers; where the scene lies in the world is "
                  "not known.",
                  file.string()));
  return std::nullopt;
}

/// Whether the folder exists in the scene. A link that leads outside is reported, and not followed.
bool is_folder(const fs::path& path, SceneFiles& files) {
  const std::optional<fs::path> place = files.resolve(path);
  if (!place) files.leave_out(path);
  std::error_code none;
  return place && fs::is_directory(fs::symlink_status(*place, none));
}

/// The root files of all tiles in `folder`: the `missing` ones, then the others, each sorted by name.
std::vector<fs::path> tile_roots(const fs::path& folder, SceneFiles& files, std::size_t& missing) {
  std::vector<fs::path> roots;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("Tile_") || !is_folder(entry.path(), files)) continue;
    roots.push_back(entry.path() / (name + ".osgb"));
  }
  std::sort(roots.begin(), roots.end());
  const auto present =
      std::stable_partition(roots.begin(), roots.end(), [&](const fs::path& root) { return files.find(root).empty(); });
  missing = static_cast<std::size_t>(present - roots.begin());
  const fs::path own = folder / (folder.filename().string() + ".osgb");
  if (present == roots.end() && !files.find(own).empty()) roots.push_back(own);
  return roots;
}

/// Whether a folder has files of tiles by themselves.
bool holds_osgb(const fs::path& folder) {
  std::error_code none;
  const fs::directory_iterator entries(folder, none);
  return std::any_of(fs::begin(entries), fs::end(entries),
                     [](const fs::directory_entry& entry) { return entry.path().extension() == ".osgb"; });
}

/// Removes all roots except that of one tile, which counts as missing if it has disappeared.
void keep_only(const std::string& tile, std::vector<fs::path>& roots, std::size_t& missing) {
  const auto wanted =
      std::find_if(roots.begin(), roots.end(), [&](const fs::path& root) { return root.stem() == tile; });
  const bool present = wanted - roots.begin() >= static_cast<std::ptrdiff_t>(missing) && wanted != roots.end();
  const fs::path root = wanted == roots.end() ? fs::path(tile + ".osgb") : *wanted;
  roots.assign(1, root);
  missing = present ? 0 : 1;
}

/// Sets the sink's offset to the position of this folder in the frame of the scene.
void place(const Georeference& georeference, const std::string& folder, const ReadingSettings& settings,
           MeshSink& sink) {
  const std::string origin =
      fmt::format("({}, {}, {})", georeference.origin.x, georeference.origin.y, georeference.origin.z);
  if (!settings.frame) {
    sink.report_georeference(georeference);
    sink.report_note(fmt::format("{}: coordinates are those of its tiles; in '{}' the scene's zero lies at {}.", folder,
                                 reference_name(georeference.srs), origin));
    return;
  }
  if (settings.frame->srs != georeference.srs) {
    throw Error(
        folder,
        fmt::format(
            "its tiles are in the reference system '{}', those before in '{}'; bring them into one system first.",
            reference_name(georeference.srs), reference_name(settings.frame->srs)));
  }
  const Vec3 offset = georeference.origin - settings.frame->origin;
  sink.set_offset(offset);
  sink.report_note(
      fmt::format("{}: its tiles are moved by ({}, {}, {}), the difference of its SRSOrigin {} and that of "
                  "the first folder.",
                  folder, offset.x, offset.y, offset.z, origin));
}

}  // namespace

void read_tiles(const fs::path& path, SceneFiles& files, MeshSink& sink, const ReadingSettings& settings) {
  fs::path folder = fs::absolute(path).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const bool has_data = is_folder(folder / "Data", files);
  const fs::path metadata = (folder.filename() == "Data" ? folder.parent_path() : folder) / "metadata.xml";
  std::size_t missing = 0;
  std::vector<fs::path> roots = tile_roots(has_data ? folder / "Data" : folder, files, missing);
  if (roots.size() == missing) {
    const bool has_files = holds_osgb(folder);
    throw Error(path.string(),
                has_files ? "this folder holds .osgb files, but no Data/Tile_*/Tile_*.osgb; name its files: " +
                                (path / "*.osgb").string()
                          : "this folder holds no Data/Tile_*/Tile_*.osgb and no tileset.json; name a folder of tiles, "
                            "or the scene's file.");
  }
  if (const auto georeference = georeference_in(metadata, files, sink)) {
    place(*georeference, path.string(), settings, sink);
  } else if (settings.frame) {
    sink.report_note(
        fmt::format("{}: its place relative to the folders before is not known; its coordinates are taken "
                    "as they are.",
                    path.string()));
  }
  if (settings.only_list) {
    for (std::size_t i = 0; i < roots.size(); ++i) sink.report_tile(roots[i].string(), i >= missing);
    return;
  }
  if (!settings.tile.empty()) keep_only(settings.tile, roots, missing);
  for (std::size_t i = 0; i < missing; ++i) sink.report_missing_page(roots[i].string());
  roots.erase(roots.begin(), roots.begin() + static_cast<std::ptrdiff_t>(missing));
  // A paged tile is opened here only for its bounds, which need no image.
  prepare_osg(sink, files, false);
  Pages pages(sink);
  for (const fs::path& root : roots) {
    osg::ref_ptr<osg::Node> node = read_osg_file(root, false);
    if (node == nullptr) continue;
    if (sink.parts() != nullptr) {
      if (refers_to_pages(*node, root, files) && pages.add(*node, root)) continue;
      node = read_again_with_images(root);
      if (node == nullptr) continue;
    }
    SceneGraphWalk(sink).walk(*node, root);
    sink.send_parts();
  }
  pages.send();
}

}  // namespace roam::reader
