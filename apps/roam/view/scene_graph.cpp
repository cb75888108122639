#include "view/scene_graph.h"

#include <osgDB/DatabasePager>
#include <osgDB/Registry>

#include "graphics/shading.h"

namespace roam::app {
namespace {

/// In so many frames without a page that came or is under way, the pager has had time to ask for all it wants: it asks
/// for one level a frame, and merges what has come in the next.
constexpr int quiet_frames_needed = 6;

}  // namespace

/// Reads the pager's pages, counts them, and remembers those that can not be read: OpenSceneGraph asks for them again
/// in every frame.
class SceneGraph::PageReader : public osgDB::ReadFileCallback {
 public:
  osgDB::ReaderWriter::ReadResult readNode(const std::string& file, const osgDB::Options* options) override {
    {
      const std::lock_guard lock(mutex_);
      if (missing_.count(file) > 0) return osgDB::ReaderWriter::ReadResult::FILE_NOT_FOUND;
    }
    ++events_;
    ++under_way_;
    auto result = osgDB::ReadFileCallback::readNode(file, options);
    if (!result.validNode()) {
      const std::lock_guard lock(mutex_);
      missing_.insert(file);
    }
    --under_way_;
    ++events_;
    return result;
  }

  [[nodiscard]] std::uint64_t missing() const {
    const std::lock_guard lock(mutex_);
    return missing_.size();
  }
  [[nodiscard]] std::uint64_t events() const { return events_; }
  [[nodiscard]] bool is_reading() const { return under_way_ > 0; }

 private:
  mutable std::mutex mutex_;
  std::set<std::string> missing_;
  std::atomic<std::uint64_t> events_ = 0;
  std::atomic<int> under_way_ = 0;
};

SceneGraph::SceneGraph(osgViewer::Viewer& viewer, osg::Group& parent, std::unique_ptr<DisplayLoader> loader,
                       Arrival arrival)
    : viewer_(viewer),
      group_(graphics::make_scene_group()),
      arrival_(arrival),
      pages_(new PageReader),
      loader_(std::move(loader)) {
  parent.addChild(group_);
  osgDB::Registry::instance()->setReadFileCallback(graphics::make_preparing_reader(pages_));
  if (arrival_ == Arrival::smooth) {
    compiler_ = new osgUtil::IncrementalCompileOperation;
    viewer_.setIncrementalCompileOperation(compiler_);
  }
}

SceneGraph::~SceneGraph() {
  // Its threads may be reading by the callback that goes now.
  if (osgDB::DatabasePager* pager = viewer_.getDatabasePager()) pager->cancel();
  osgDB::Registry::instance()->setReadFileCallback(nullptr);
}

void SceneGraph::attach(DisplayNode&& piece) {
  if (pieces_++ == 0) origin_ = piece.origin;
  bounds_.include(piece.bounds);
  if (compiler_ && !compiler_->getContextSet().empty()) {
    compiler_->add(new osgUtil::IncrementalCompileOperation::CompileSet(group_, piece.node));
  } else {
    group_->addChild(piece.node);
  }
}

void SceneGraph::update() {
  while (std::optional<DisplayNode> piece = loader_->take()) attach(std::move(*piece));
  if (!report_) report_ = loader_->take_report();
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
  const bool moved = pages_->events() != last_count_ || pages_->is_reading();
  last_count_ = pages_->events();
  quiet_frames_ = !read || merging || moved || is_compiling() ? 0 : quiet_frames_ + 1;
  const bool paged = report_ && report_->paged;
  return quiet_frames_ > (paged ? quiet_frames_needed : 1);
}

std::uint64_t SceneGraph::missing_pages() const { return pages_->missing(); }

}  // namespace roam::app
