#pragma once
/// \file
/// Paged scenes: passed on unread, then read page by page on demand.

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
#include "import/reader/scene_files.h"
#include "import/reader/scene_graph.h"

namespace roam::reader {

/// Whether `root`, which was read from `file`, names a page that is a file of the scene. If all pages are missing,
/// there is only the coarse geometry, which is better read whole.
[[nodiscard]] bool refers_to_pages(osg::Node& root, const std::filesystem::path& file, const SceneFiles& files);

/// Gathers paged files and sends them in parts.
class Pages {
 public:
  /// `sink` must have parts. Its settings move, turn and scale the files added later.
  explicit Pages(MeshSink& sink) : sink_(sink) {}

  /// Adds `file`, from which `root` was read. False if it has no usable bounds.
  bool add(osg::Node& root, const std::filesystem::path& file);
  /// Sends the files gathered so far.
  void send();

 private:
  MeshSink& sink_;
  std::optional<PartGraph> graph_;
  std::chrono::steady_clock::time_point begun_;
};

/// State that pages inherit from nodes in the files on the path to them; kept for the life of the process. Number 0 is
/// no state.
using PageStates = std::vector<osg::ref_ptr<osg::StateSet>>;

/// Walks a page. Its geometry goes into the page of the sink's parts (PartPool::begin_page), and its PagedLODs that
/// name pages become pages.
class PageWalk : public SceneGraphWalk {
 public:
  PageWalk(MeshSink& sink, const PageContext& page, PageStates& states);

  /// Walks the graph that was read from the page's file.
  void walk(osg::Node& root);

 private:
  void meet(osg::LOD& lod, osg::PagedLOD* paged) override;
  [[nodiscard]] bool is_replaced(const osg::LOD& lod) override;
  bool add(osg::PagedLOD& lod);
  std::uint32_t state_here();

  MeshSink& sink_;
  const PageContext& page_;
  PageStates& states_;
};

}  // namespace roam::reader
