#pragma once
/// \file
/// Scenes that are paged: handed on unread, and read page by page when the program wants what is near.

#include <chrono>
#include <filesystem>
#include <optional>
#include <osg/Node>
#include <osg/PagedLOD>
#include <osg/ref_ptr>
#include <vector>

#include "import/reader/display/page_token.h"
#include "import/reader/display/part_graph.h"
#include "import/reader/mesh_sink.h"
#include "import/reader/scene_graph.h"

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
  std::chrono::steady_clock::time_point begun_;
};

/// What pages inherit from nodes in the files through which they are reached; kept as long as the process lives. Number
/// 0 is none.
using PageStates = std::vector<osg::ref_ptr<osg::StateSet>>;

/// Walks a page: what is in it goes into the page of the sink's parts (PartPool::begin_page), and its PagedLODs that
/// name pages become pages again.
class PageWalk : public SceneGraphWalk {
 public:
  PageWalk(MeshSink& sink, const PageContext& page, PageStates& states);

  /// Walks what was read from the page's file.
  void walk(osg::Node& root);

 private:
  void meet(osg::LOD& lod, osg::PagedLOD* paged) override;
  [[nodiscard]] bool stands_for(const osg::LOD& coarser) const override;
  bool add(osg::PagedLOD& lod);
  std::uint32_t state_here();

  MeshSink& sink_;
  const PageContext& page_;
  PageStates& states_;
};

}  // namespace roam::reader
