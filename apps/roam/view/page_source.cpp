#include "view/page_source.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <new>
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
constexpr std::size_t notes_limit = 20;

// How pages are kept within their memory.
constexpr double full = 0.9;             // share of the memory from which pages are dropped
constexpr double longest_kept = 60.0;    // s without being seen, before one that is dropped first
constexpr double shortest_kept = 0.1;    // s; what was seen since then counts as seen
constexpr double sooner = 0.8;           // factor of that time in each frame that is full
constexpr double coarsest = 64.0;        // times the allowed error
constexpr double coarser_step = 1.2;     // factor, which takes half as many pages again at most
constexpr double coarser_seconds = 0.2;  // between two steps, for pages to be dropped
constexpr double roomy = 0.5;            // share of the memory below which tiles become finer again,
constexpr double calm = 5.0;             // s after the last step, or the last page that was refused
constexpr int steady_frames = 6;         // without a refused page, until the next one is the first again

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
                       const TextureQuality& quality, std::shared_ptr<SceneObjects> objects,
                       const PageSettings& settings)
    : reader_(std::move(paths), options),
      quality_(quality),
      objects_(std::move(objects)),
      settings_(settings),
      rules_(std::make_shared<PageRules>(PageRules{settings.allowed_error})),
      kept_seconds_(longest_kept),
      memory_(std::make_shared<std::atomic<std::uint64_t>>(0)) {}

std::uint64_t PageSource::missing() const {
  const std::lock_guard lock(mutex_);
  return missing_;
}

std::vector<std::string> PageSource::notes() const {
  const std::lock_guard lock(mutex_);
  return notes_;
}

std::string PageSource::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

osg::ref_ptr<osg::Group> PageSource::make(const DisplayPart& part, int depth) {
  const auto is_by_error = [](const DisplayPages& pages) { return pages.measure == DisplayMeasure::error; };
  if (std::any_of(part.pages.begin(), part.pages.end(), is_by_error)) by_error_ = true;
  return make_node(
      part, quality_, [&](const std::string& token) { return name_of(part, token, depth); }, *objects_, rules_);
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

bool PageSource::is_full() const {
  return static_cast<double>(*memory_) > full * static_cast<double>(settings_.memory);
}

void PageSource::tend(double now) {
  const auto memory = static_cast<double>(settings_.memory), used = static_cast<double>(*memory_);
  const bool is_full = this->is_full();
  kept_seconds_ = is_full ? std::max(sooner * kept_seconds_, shortest_kept) : coarser_ > 1.0 ? calm : longest_kept;
  const bool drops = is_full || coarser_ > 1.0;
  rules_->drop_before = drops ? now - kept_seconds_ : -std::numeric_limits<double>::infinity();
  // Unseen pages must have had their time to go.
  if (kept_seconds_ > shortest_kept) changed_at_ = now;
  if (refused_.exchange(false)) {
    // Pages of the view before are still there when the first one is refused.
    if (frames_since_refused_ > steady_frames) changed_at_ = now;
    frames_since_refused_ = 0;
    refuse(now);
  } else if (coarser_ > 1.0 && used < roomy * memory && now - refused_at_ > calm) {
    refused_at_ = now;
    change(1.0 / coarser_step, now);
  } else {
    ++frames_since_refused_;
  }
}

/// After a page was refused. Counts an event only if more may come, so that who waits for an end finds one.
void PageSource::refuse(double now) {
  refused_at_ = now;
  const bool waits = now - changed_at_ <= coarser_seconds, changes = by_error_ && coarser_ < coarsest;
  if (waits || changes) ++events_;
  if (waits) return;
  if (changes) {
    change(coarser_step, now);
  } else {
    lacks_ = true;
  }
}

void PageSource::change(double factor, double now) {
  coarser_ = std::clamp(factor * coarser_, 1.0, coarsest);
  changed_at_ = now;
  const double least = coarser_ > 1.0 && settings_.allowed_error <= 0.0 ? 1.0 : settings_.allowed_error;  // pixels
  rules_->allowed_error = coarser_ * least;
}

osg::ref_ptr<osg::Node> PageSource::read(const std::string& name, const Page& page) {
  if (page.depth >= depth_limit) throw Error("pages are nested without end; the scene is damaged.");
  const DisplayPart part = reader_.read(page.source, page.origin, page.token);
  note(name, part);
  osg::ref_ptr<osg::Group> node = make(part, page.depth + 1);
  node->setUserData(new Counted(memory_, part.bytes()));
  return node;
}

/// Counts what is missing in a page that was read, once.
void PageSource::note(const std::string& name, const DisplayPart& part) {
  const std::lock_guard lock(mutex_);
  if (std::exchange(pages_[name].was_read, true)) return;
  for (const std::string& sentence : part.notes) {
    const bool known = std::find(notes_.begin(), notes_.end(), sentence) != notes_.end();
    if (!known && notes_.size() < notes_limit) notes_.push_back(sentence);
  }
  if (part.missing == 0) return;
  if (missing_ == 0 && !part.notes.empty()) problem_ = part.notes.front();
  missing_ += part.missing;
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
  if (*memory_ > settings_.memory) {
    refused_ = true;
    return nothing;
  }
  ++events_;
  ++under_way_;
  osg::ref_ptr<osg::Node> node;
  try {
    node = read(name, page);
  } catch (const std::exception& problem) {
    // The coarser page stays visible.
    const std::lock_guard lock(mutex_);
    pages_[name].missing = true;
    ++missing_;
    try {
      if (problem_.empty()) problem_ = problem.what();
    } catch (const std::bad_alloc&) {
      // The next one may name its reason.
    }
  }
  --under_way_;
  ++events_;
  return node == nullptr ? nothing : Result(node.get());
}

}  // namespace roam::app
