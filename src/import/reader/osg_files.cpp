#include "import/reader/osg_files.h"

#include <cstdio>
#include <osg/Notify>
#include <osgDB/Options>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <string>
#include <system_error>

namespace roam::reader {
namespace {

using Result = osgDB::ReaderWriter::ReadResult;

/// Files that read files that read files: more than this is a circle.
constexpr int nesting_limit = 64;

/// Answers for every kind of image before osgDB loads a decoder for it: what is walked on has no colour, and image
/// files are a favourite of attackers.
class NoImages : public osgDB::ReaderWriter {
 public:
  NoImages() {
    for (const char* extension :
         {"jpg", "jpeg", "jpe", "png", "tif", "tiff", "dds", "bmp", "gif", "tga", "rgb",  "rgba", "sgi",
          "int", "inta", "bw",  "ktx", "pic", "pnm",  "ppm", "pgm", "pbm", "hdr", "attr", "webp", "pvr"}) {
      supportsExtension(extension, "left out");
    }
  }
  const char* className() const override { return "no images"; }
  Result readImage(const std::string&, const osgDB::Options*) const override { return Result::FILE_NOT_FOUND; }
  Result readImage(std::istream&, const osgDB::Options*) const override { return Result::FILE_NOT_FOUND; }
};

class GuardedReading : public osgDB::ReadFileCallback {
 public:
  explicit GuardedReading(MeshSink& sink) : sink_(sink) {}

  Result readNode(const std::string& file, const osgDB::Options* options) override {
    if (file.find("://") != std::string::npos || nesting_ >= nesting_limit) return missing(file);
    ++nesting_;
    const bool main = std::exchange(next_is_main_, false);
    Result result = osgDB::ReadFileCallback::readNode(file, options);
    --nesting_;
    if (!result.validNode()) return main ? result : missing(file);
    sink_.count_file();
    std::error_code unseen;
    const auto bytes = std::filesystem::file_size(file, unseen);
    sink_.report_more_progress(unseen ? 0 : bytes);
    return result;
  }
  Result readObject(const std::string& file, const osgDB::Options* options) override { return readNode(file, options); }
  Result readImage(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }
  Result readShader(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }
  Result readScript(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }

  void expect_main() { next_is_main_ = true; }

 private:
  Result missing(const std::string& file) {
    sink_.report_missing_page(file);
    return Result::FILE_NOT_FOUND;
  }

  MeshSink& sink_;
  int nesting_ = 0;
  bool next_is_main_ = false;
};

/// Keeps the last complaint for the message of a failure, and passes all on to the standard error.
class Complaints : public osg::NotifyHandler {
 public:
  void notify(osg::NotifySeverity, const char* message) override {
    std::fputs(message, stderr);
    last_ = message;
  }
  [[nodiscard]] const std::string& last() const { return last_; }

 private:
  std::string last_;
};

osg::ref_ptr<GuardedReading> guard;
osg::ref_ptr<Complaints> complaints;

}  // namespace

void prepare_osg(MeshSink& sink) {
  complaints = new Complaints;
  osg::setNotifyLevel(osg::WARN);
  osg::setNotifyHandler(complaints);
  osgDB::Registry* registry = osgDB::Registry::instance();
  registry->addReaderWriter(new NoImages);
  guard = new GuardedReading(sink);
  registry->setReadFileCallback(guard);
  // Readers of other formats optimise with it; it would reorder triangles.
  registry->setBuildKdTreesHint(osgDB::Options::DO_NOT_BUILD_KDTREES);
}

osg::ref_ptr<osg::Node> read_osg_file(const std::filesystem::path& path, bool main) {
  const std::string file = path.string();
  osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
  options->setObjectCacheHint(osgDB::Options::CACHE_NONE);
  options->setDatabasePath(path.parent_path().string());
  if (main) guard->expect_main();
  return osgDB::readRefNodeFile(file, options.get());
}

std::string last_osg_complaint() {
  std::string text = complaints->last();
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

}  // namespace roam::reader
