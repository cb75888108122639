#include "view/scene_graph.h"

#include <osgDB/DatabasePager>
#include <osgDB/Registry>
#include <utility>

#include "graphics/shading.h"
#include "view/shown_objects.h"

namespace roam::app {
namespace {

/// Frames without a new or pending page until the pager has requested all that it needs. It requests one level a frame,
/// and merges the results in the next.
constexpr int quiet_frames_needed = 6;
/// SceneObjects::version() before the first change.
constexpr std::uint64_t first_version = 1;

}  // namespace

SceneGraph::SceneGraph(osgViewer::Viewer& viewer, osg::Group& parent, std::unique_ptr<DisplayLoader> loader,
                       std::shared_ptr<SceneObjects> objects, Arrival arrival)
    : viewer_(viewer),
      group_(graphics::make_scene_group()),
      arrival_(arrival),
      objects_(std::move(objects)),
      objects_version_(objects_->version()),
      loader_(std::move(loader)) {
  parent.addChild(group_);
  osgDB::Registry::instance()->setReadFileCallback(&loader_->pages());
  if (arrival_ == Arrival::smooth) {
    compiler_ = new osgUtil::IncrementalCompileOperation;
    viewer_.setIncrementalCompileOperation(compiler_);
  }
}

SceneGraph::~SceneGraph() {
  // The pager's threads may still use the callback: end their reads first.
  loader_->cancel();
  if (osgDB::DatabasePager* pager = viewer_.getDatabasePager()) pager->cancel();
  osgDB::Registry::instance()->setReadFileCallback(nullptr);
}

void SceneGraph::attach(DisplayNode&& piece) {
  if (pieces_++ == 0) origin_ = piece.origin;
  bounds_.include(piece.bounds);
  paged_ = paged_ || piece.paged;
  if (compiler_ && !compiler_->getContextSet().empty()) {
    compiler_->add(new osgUtil::IncrementalCompileOperation::CompileSet(group_, piece.node));
  } else {
    group_->addChild(piece.node);
  }
}

void SceneGraph::update() {
  state_ = loader_->state();
  while (std::optional<DisplayNode> piece = loader_->take()) attach(std::move(*piece));
  if (!report_) report_ = loader_->take_report();
  if (osgDB::DatabasePager* pager = viewer_.getDatabasePager()) {
    // Memory limits the pages (PageLod::removeExpiredChildren), not their number.
    pager->setTargetMaximumNumberOfPageLOD(0);
    loader_->pages().tend(viewer_.getFrameStamp()->getReferenceTime());
  }
  hide_objects();
}

void SceneGraph::hide_objects() {
  // A piece or page that was made before a change may arrive after it.
  constexpr int check_frames = 15;
  const std::uint64_t version = objects_->version();
  const bool changed = version != std::exchange(objects_version_, version);
  if (changed) frames_until_check_ = 0;
  if (version == first_version || --frames_until_check_ > 0) return;
  frames_until_check_ = check_frames;
  const bool unsettled = paged_ || !is_over(state_) || is_compiling();
  // Once more after the last piece: it may have come since the last check.
  if ((changed || unsettled || unsettled_) && show_objects(*group_, *objects_->flags())) ++shown_;
  unsettled_ = unsettled;
}

bool SceneGraph::is_compiling() const {
  if (!compiler_) return false;
  const OpenThreads::ScopedLock<OpenThreads::Mutex> waiting(*compiler_->getToCompiledMutex());
  if (!compiler_->getToCompile().empty()) return true;
  const OpenThreads::ScopedLock<OpenThreads::Mutex> ready(*compiler_->getCompiledMutex());
  return !compiler_->getCompiled().empty();
}

bool SceneGraph::is_complete() {
  const LoadState::Phase phase = loader_->state().phase;
  const bool read = report_.has_value() || phase == LoadState::Phase::failed;
  const auto* pager = viewer_.getDatabasePager();
  const bool merging =
      pager != nullptr && (pager->getDataToCompileListSize() > 0 || pager->getDataToMergeListSize() > 0);
  const bool moved = loader_->pages().events() != last_count_ || loader_->pages().is_reading();
  last_count_ = loader_->pages().events();
  quiet_frames_ = !read || merging || moved || is_compiling() ? 0 : quiet_frames_ + 1;
  const bool paged = report_ && report_->paged;
  return quiet_frames_ > (paged ? quiet_frames_needed : 1);
}

std::uint64_t SceneGraph::missing_pages() const { return loader_->pages().missing(); }

std::string SceneGraph::page_problem() const { return loader_->pages().problem(); }

}  // namespace roam::app
