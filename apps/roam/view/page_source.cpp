#include "view/page_source.h"

#include <exception>
#include <osg/Referenced>
#include <utility>

#include "roam/error.h"

namespace roam::app {
namespace {

/// Limits against endless names from a reader.
constexpr int depth_limit = 64;
constexpr std::uint64_t token_bytes_limit = 1u << 30;
/// Bytes per name besides the token.
constexpr std::uint64_t name_bytes = 400;

/// Adds `bytes` to a shared sum while it exists.
class Counted : public osg::Referenced {
 public:
  Counted(std::shared_ptr<std::atomic<std::uint64_t>> sum, std::uint64_t bytes) : sum_(std::move(sum)), bytes_(bytes) {
    *sum_ += bytes_;
  }

 protected:
  ~Counted() override { *sum_ -= bytes_; }

 private:
  std::shared_ptr<std::atomic<std::uint64_t>> sum_;
  std::uint64_t bytes_;
};

}  // namespace

PageSource::PageSource(std::vector<std::filesystem::path> paths, const ImportOptions& options,
                       const TextureQuality& quality, std::shared_ptr<SceneObjects> objects)
    : reader_(std::move(paths), options),
      quality_(quality),
      objects_(std::move(objects)),
      memory_limit_(options.memory_limit),
      memory_(std::make_shared<std::atomic<std::uint64_t>>(0)) {}

std::uint64_t PageSource::missing() const {
  const std::lock_guard lock(mutex_);
  return missing_;
}

std::string PageSource::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

osg::ref_ptr<osg::Group> PageSource::make(const DisplayPart& part, int depth) {
  return make_node(
      part, quality_, [&](const std::string& token) { return name_of(part, token, depth); }, *objects_);
}

std::string PageSource::name_of(const DisplayPart& part, const std::string& token, int depth) {
  const std::lock_guard lock(mutex_);
  // A dropped page gets its old name when it is read again.
  const auto [at, is_new] = names_.try_emplace({part.source, token});
  if (is_new) {
    token_bytes_ += token.size() + name_bytes;
    if (token_bytes_ > token_bytes_limit) throw Error("the scene has more pages than roam can show; it is damaged.");
    at->second = "page-" + std::to_string(names_.size());
    pages_[at->second] = {part.source, part.origin, token, depth};
  }
  return at->second;
}

osg::ref_ptr<osg::Node> PageSource::read(const Page& page) {
  if (page.depth >= depth_limit) throw Error("pages are nested without end; the scene is damaged.");
  const DisplayPart part = reader_.read(page.source, page.origin, page.token);
  osg::ref_ptr<osg::Group> node = make(part, page.depth + 1);
  node->setUserData(new Counted(memory_, part.bytes()));
  return node;
}

PageSource::Result PageSource::readNode(const std::string& name, const osgDB::Options*) {
  Page page;
  {
    const std::lock_guard lock(mutex_);
    const auto at = pages_.find(name);
    if (at == pages_.end()) return Result::FILE_NOT_FOUND;
    page = at->second;
  }
  // An empty result, without a warning from OpenSceneGraph: the session reports missing pages.
  const Result nothing(Result::FILE_LOADED);
  if (page.missing) return nothing;
  // The pager will drop pages, and request this one again.
  if (*memory_ > memory_limit_) return nothing;
  ++events_;
  ++under_way_;
  osg::ref_ptr<osg::Node> node;
  try {
    node = read(page);
  } catch (const std::exception& problem) {
    // The coarser page stays visible.
    const std::lock_guard lock(mutex_);
    pages_[name].missing = true;
    if (missing_++ == 0) problem_ = problem.what();
  }
  --under_way_;
  ++events_;
  return node == nullptr ? nothing : Result(node.get());
}

}  // namespace roam::app
