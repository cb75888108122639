#pragma once
/// \file
/// Scenes that are paged: handed on unread, for the program to load what is near.

#include <chrono>
#include <filesystem>
#include <optional>
#include <osg/Group>
#include <osg/Node>
#include <osg/ref_ptr>

#include "import/reader/display/part_graph.h"
#include "import/reader/mesh_sink.h"

namespace roam::reader {

/// Whether somewhere in `root`, which was read from `file`, a page is named that exists. Where all are missing the
/// coarse geometry is all there is, and is better read whole.
[[nodiscard]] bool refers_to_pages(osg::Node& root, const std::filesystem::path& file);

/// Gathers paged files and sends them in parts.
class Pages {
 public:
  /// `sink` must have parts; what is set there moves, turns and scales the files that are added next.
  explicit Pages(MeshSink& sink) : sink_(sink) {}

  /// Adds the file `file`, from which `root` was read. False when it says no place where it could be shown.
  bool add(osg::Node& root, const std::filesystem::path& file);
  /// Sends what is gathered.
  void send();

 private:
  MeshSink& sink_;
  std::optional<PartGraph> graph_;
  Box bounds_;
  std::chrono::steady_clock::time_point begun_;
};

}  // namespace roam::reader
