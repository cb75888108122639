#pragma once
/// Stores, and sessions on them, shared by the tests of roam view.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "roam/store_build.h"
#include "scenes/user_key.h"
#include "store/tile_reader.h"
#include "store_builds.h"
#include "view_driven.h"

namespace view_stores {

namespace fs = std::filesystem;
using namespace roam;

/// Half as long as room_obj().
inline std::string short_room_obj() {
  std::string text = room_obj();
  for (std::size_t at = text.find("v 20 "); at != std::string::npos; at = text.find("v 20 ")) {
    text.replace(at, 5, "v 10 ");
  }
  return text;
}

inline StoreBuildOptions build_of(const std::string& scene, const std::string& store) {
  StoreBuildOptions build;
  build.scene = {scene};
  build.output = store;
  build.memory = StoreBuildOptions::least_memory;
  build.threads = 1;
  build.key = app::made_user_key().key;
  return build;
}

/// Changes a byte of the tile around (x, y) in a store of one page.
inline void damage_tile_at(const std::string& folder, double x, double y) {
  const auto opened = Store::open(folder);
  store::TileReader reader(opened->state());
  const store::LoadedPage page = reader.page(0);
  const auto tile = std::find_if(page.view.tiles.begin(), page.view.tiles.end(), [&](const store::TileEntry& entry) {
    return entry.lower[0] <= x && x <= entry.upper[0] && entry.lower[1] <= y && y <= entry.upper[1];
  });
  ASSERT_NE(tile, page.view.tiles.end());
  ASSERT_GT(page.view.tiles.size(), 3u);
  std::fstream file(folder + "/" + opened->state().packs.front(), std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(static_cast<std::streamoff>(tile->offset));
  const int byte = file.get();
  file.seekp(static_cast<std::streamoff>(tile->offset));
  file.put(static_cast<char>(byte ^ 1));
}

/// A session in the room, optionally with a store of it.
class Driven : public DrivenSession {
 public:
  Driven() {
    options.at = {8, 0, 0.95, 0};
    options.program = ROAM_PROGRAM;
  }

  /// The store's place beside the scene.
  std::string build() {
    const std::string scene = options.scene.scenes.front().string();
    build_store(build_of(scene, scene + ".roam"));
    return scene + ".roam";
  }
  [[nodiscard]] bool on_store() { return session->status().paging.has_value(); }
  [[nodiscard]] std::string notes() {
    const app::ViewReport report = finish();
    std::string text;
    for (const std::string& note : report.notes) text += note + "\n";
    return text;
  }
};

}  // namespace view_stores
