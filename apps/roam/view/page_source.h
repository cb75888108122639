#pragma once
/// \file
/// Source of the pages that OpenSceneGraph's pager requests.

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <osgDB/Callbacks>
#include <string>
#include <tuple>
#include <vector>

#include "import/page_reader.h"
#include "view/display_node.h"
#include "view/page_lod.h"

namespace roam::app {

struct PageSettings {
  double allowed_error = 16.0;        ///< pixels; see PageRules
  std::uint64_t memory = 1ull << 30;  ///< bytes that the pages may take
};

/// Handles every node that OpenSceneGraph reads, as the Registry's callback. It reads only pages, by names that it made
/// itself, in another process. A name never is a file's. It counts the reads and remembers failed pages, which
/// OpenSceneGraph requests again in every frame. Thread-safe.
///
/// Memory. Above nine tenths of the limit the pages that were not seen for longest are dropped, and above the limit no
/// more are read. If all that is left is seen, tiles are drawn coarser by and by, until it fits. Levels that are not
/// chosen by an error stay as they are: the rest is lacking.
class PageSource : public osgDB::ReadFileCallback {
 public:
  /// `objects` receives the names of the scene's objects; not null.
  PageSource(std::vector<std::filesystem::path> paths, const ImportOptions& options, const TextureQuality& quality,
             std::shared_ptr<SceneObjects> objects, const PageSettings& settings = {});

  /// The nodes of a part; the pages that it names can be read from now on. Throws roam::Error if there are more pages
  /// than any scene has.
  [[nodiscard]] osg::ref_ptr<osg::Group> make(const DisplayPart& part) { return make(part, 0); }
  /// Keeps the pages within their memory. Call it once a frame, from the thread that draws. `now`: the frame's
  /// reference time, s.
  void tend(double now);
  /// Bytes of the pages in memory.
  [[nodiscard]] std::uint64_t bytes() const { return *memory_; }
  /// Whether an error chooses the levels of some pages.
  [[nodiscard]] bool by_error() const { return by_error_; }
  /// A number that changes when other levels are drawn. Call it from the drawing thread.
  [[nodiscard]] std::uint64_t changes() const { return rules_->changes; }
  /// Whether they are as many as make unseen ones go.
  [[nodiscard]] bool is_full() const;
  /// How many times the allowed error is drawn, because more would not fit.
  [[nodiscard]] double coarser() const { return coarser_; }
  /// Whether pages did not fit, though all that could be coarser was.
  [[nodiscard]] bool lacks() const { return lacks_; }
  /// Ends every read at once, present and future ones.
  void cancel() { reader_.cancel(); }

  /// The number of pages, and of files that they refer to, that could not be read.
  [[nodiscard]] std::uint64_t missing() const;
  /// The sentences of the pages for the user, each once.
  [[nodiscard]] std::vector<std::string> notes() const;
  /// The error of the first missing one; empty if there is none.
  [[nodiscard]] std::string problem() const;
  /// A count that changes whenever a read begins or ends.
  [[nodiscard]] std::uint64_t events() const { return events_; }
  [[nodiscard]] bool is_reading() const { return under_way_ > 0; }

  using Result = osgDB::ReaderWriter::ReadResult;
  Result readNode(const std::string& name, const osgDB::Options*) override;
  Result openArchive(const std::string&, osgDB::ReaderWriter::ArchiveStatus, unsigned, const osgDB::Options*) override {
    return Result::FILE_NOT_FOUND;
  }
  Result readObject(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }
  Result readImage(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }
  Result readHeightField(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }
  Result readShader(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }
  Result readScript(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }

 private:
  struct Page {
    std::uint32_t source = 0;
    Vec3 origin{0.0};
    std::string token;
    int depth = 0;  ///< pages between it and the root
    bool missing = false;
    bool was_read = false;
  };

  osg::ref_ptr<osg::Group> make(const DisplayPart& part, int depth);
  std::string name_of(const DisplayPart& part, const std::string& token, int depth);
  /// Throws roam::Error, or roam::Cancelled.
  osg::ref_ptr<osg::Node> read(const std::string& name, const Page& page);
  void note(const std::string& name, const DisplayPart& part);
  void refuse(double now);
  void change(double factor, double now);

  PageReader reader_;
  TextureQuality quality_;
  std::shared_ptr<SceneObjects> objects_;
  PageSettings settings_;
  std::shared_ptr<PageRules> rules_;
  double kept_seconds_, coarser_ = 1.0, changed_at_ = 0.0, refused_at_ = 0.0;  ///< of the thread that draws
  int frames_since_refused_ = 0;
  bool lacks_ = false;
  std::atomic<bool> by_error_ = false;                  ///< levels of some page
  std::atomic<bool> refused_ = false;                   ///< a page, since the last tend()
  std::shared_ptr<std::atomic<std::uint64_t>> memory_;  ///< bytes of the pages in memory
  mutable std::mutex mutex_;
  std::map<std::pair<std::uint32_t, std::string>, std::string> names_;  ///< by source and token
  std::map<std::string, Page> pages_;                                   ///< by name
  std::uint64_t token_bytes_ = 0;
  std::uint64_t missing_ = 0;
  std::string problem_;
  std::vector<std::string> notes_;
  std::atomic<std::uint64_t> events_ = 0;
  std::atomic<int> under_way_ = 0;
};

}  // namespace roam::app
