#pragma once
/// \file
/// A scene as it is to be seen, read by the child process roam-reader.
///
///     roam::DisplayReport report = roam::read_display(paths, options, [&](roam::DisplayPart&& part) {
///       give(std::move(part));   // to the thread that draws
///       return !closed;
///     });
///
/// The same readers, options and checks as import_scene: every triangle that it gives is in exactly one part, and
/// nothing else is, but for pages (see below). What a part holds is said in display_part.h: colours are material times
/// vertex colour of the file, white where there is none, so that what is seen is this colour times the texture. Images
/// have at most 4096 texels a side, unless they are compressed. Geometry of one texture comes in one part as far as it
/// takes no more than 64 MB, so that a texture is seldom sent twice; a part has about 8 MB else.
///
/// Pages. Tiles and OpenSceneGraph files that refer to pages which exist are not read here but handed on: a
/// DisplayPages whose only level is a page. PageReader (page_reader.h) reads it when it is wanted, with the same
/// readers, options and checks: what it gives are geometries and further pages.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "import/display_part.h"
#include "roam/import.h"
#include "roam/math.h"

namespace roam {

/// What there is to be seen and what is missing of it.
struct DisplayReport {
  /// Zero, or, for a scene that begins more than 10 km away from it, a place near its first triangles.
  Vec3 origin{0.0};
  Box bounds;  ///< of all parts, in the frame of the scene
  std::uint64_t parts = 0;
  std::uint64_t triangles = 0;         ///< of all parts; those of pages are not counted
  std::uint64_t textures = 0;          ///< images that were read; those of pages are not counted
  std::uint64_t missing_textures = 0;  ///< images that are absent or unreadable; what they cover is shown without
  std::vector<std::string> missing_texture_files;  ///< at most ImportReport::name_limit
  bool paged = false;                              ///< whether any part holds pages
  /// What import_scene says of the same files, but for `vertices`, which is 0; of pages only what their roots tell,
  /// so that a pattern of ImportOptions::ignore that matches nothing is not said where there are pages.
  /// Its notes also name files of materials that are absent, and images that are shown smaller.
  ImportReport import;
  /// Whole sentences for the user about what is not seen as it should be. What import_scene says of the same files is
  /// in import.notes, not here.
  std::vector<std::string> notes;
};

/// Reads files and folders for showing. Blocks, and calls `take` from the calling thread with each part as it comes;
/// a slow `take` holds the reader up, nothing piles up. When `take` or options.progress returns false, the reader is
/// ended and roam::Cancelled thrown. May be called from several threads at once.
///
/// Throws roam::Error in the cases and with the sentences of import_scene. Parts that came before stay good.
DisplayReport read_display(std::span<const std::filesystem::path> paths, const ImportOptions& options,
                           const std::function<bool(DisplayPart&&)>& take);

}  // namespace roam
