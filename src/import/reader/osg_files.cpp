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

/// Answers for every kind of image inside other files before osgDB loads a decoder for it: what is walked on has no
/// colour, and image files are a favourite of attackers.
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
    if (quiet_) return result;
    sink_.count_file();
    std::error_code unseen;
    const auto bytes = std::filesystem::file_size(file, unseen);
    sink_.report_more_progress(unseen ? 0 : bytes);
    return result;
  }
  Result readObject(const std::string& file, const osgDB::Options* options) override { return readNode(file, options); }
  Result readImage(const std::string& file, const osgDB::Options* options) override {
    if (!images_) return Result::FILE_NOT_FOUND;
    std::filesystem::path folder;
    if (options != nullptr && !options->getDatabasePathList().empty()) folder = options->getDatabasePathList().front();
    osg::ref_ptr<osg::Image> image = sink_.parts()->textures().find(folder, file);
    return image == nullptr ? Result(Result::FILE_NOT_FOUND) : Result(image.get());
  }
  Result readShader(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }
  Result readScript(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }

  void expect_main() { next_is_main_ = true; }
  void set_images(bool wanted) { images_ = wanted; }
  void set_quiet(bool quiet) { quiet_ = quiet; }

 private:
  Result missing(const std::string& file) {
    if (!quiet_) sink_.report_missing_page(file);
    return Result::FILE_NOT_FOUND;
  }

  MeshSink& sink_;
  int nesting_ = 0;
  bool next_is_main_ = false;
  bool images_ = false;
  bool quiet_ = false;
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
osg::ref_ptr<NoImages> no_images;
osg::ref_ptr<Complaints> complaints;

void set_images(bool wanted) {
  osgDB::Registry* registry = osgDB::Registry::instance();
  guard->set_images(wanted);
  registry->removeReaderWriter(no_images);
  if (!wanted) registry->addReaderWriter(no_images);
}

}  // namespace

void prepare_osg(MeshSink& sink, bool images) {
  complaints = new Complaints;
  osg::setNotifyLevel(osg::WARN);
  osg::setNotifyHandler(complaints);
  osgDB::Registry* registry = osgDB::Registry::instance();
  no_images = new NoImages;
  guard = new GuardedReading(sink);
  registry->setReadFileCallback(guard);
  set_images(images);
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

osg::ref_ptr<osg::Node> read_again_with_images(const std::filesystem::path& path) {
  set_images(true);
  guard->set_quiet(true);
  osg::ref_ptr<osg::Node> node = read_osg_file(path, false);
  guard->set_quiet(false);
  return node;
}

std::string last_osg_complaint() {
  std::string text = complaints->last();
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

}  // namespace roam::reader
