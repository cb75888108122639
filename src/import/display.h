#pragma once
/// \file
/// Reading a scene for display, in the child process roam-reader.
///
///     roam::DisplayReport report = roam::read_display(paths, options, [&](roam::DisplayPart&& part) {
///       give(std::move(part));   // to the thread that draws
///       return !closed;
///     });
///
/// Uses the readers, options and checks of import_scene. Every triangle that import_scene gives is in exactly one part,
/// and nothing else is, except for pages (see below). display_part.h describes a part. Colours are material times
/// vertex colour of the file, or white if it has none; the displayed colour is this times the texture. Images have at
/// most 4096 texels a side, unless they are compressed. Geometry of one texture comes in one part if it takes at most
/// 64 MB, so that a texture is seldom sent twice. Other parts have about 8 MB.
///
/// Pages. Tilesets of several tiles, and tiles and OpenSceneGraph files that refer to existing pages, are not read here.
/// They are passed on as DisplayPages whose only level is a page. PageReader (page_reader.h) reads that page on demand,
/// with the same readers, options and checks. A page contains geometries and further pages.

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

/// Totals of the parts, and missing files.
struct DisplayReport {
  /// Zero, or a point near the first triangles if these are more than 10 km from zero.
  Vec3 origin{0.0};
  Box bounds;  ///< of all parts, in the frame of the scene
  std::uint64_t parts = 0;
  std::uint64_t triangles = 0;         ///< of all parts; pages are not counted
  std::uint64_t textures = 0;          ///< images that were read; pages are not counted
  std::uint64_t missing_textures = 0;  ///< images that are absent or unreadable; their surfaces are shown without them
  std::vector<std::string> missing_texture_files;  ///< at most ImportReport::name_limit
  bool paged = false;                              ///< whether any part has pages
  /// The report of import_scene for the same files, with these differences. `vertices` is 0. Pages count only with the
  /// data of their root files. If there are pages, patterns of ImportOptions::ignore that match nothing are not
  /// reported. The notes also name absent material files, and images that are shown smaller.
  ImportReport import;
  /// Sentences for the user about things that are not shown as they should be. Notes of import_scene on the same files
  /// are in import.notes.
  std::vector<std::string> notes;
};

/// Reads files and folders for display. Blocks, and calls `take` from the calling thread with each part. A slow `take`
/// slows the reader down; parts do not accumulate. If `take` or options.progress returns false, the reader is ended and
/// roam::Cancelled thrown. Several threads may call it at once.
///
/// Throws roam::Error in the cases and with the messages of import_scene. Parts passed to `take` before stay valid.
DisplayReport read_display(std::span<const std::filesystem::path> paths, const ImportOptions& options,
                           const std::function<bool(DisplayPart&&)>& take);

}  // namespace roam
