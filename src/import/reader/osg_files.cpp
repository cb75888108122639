#include "import/reader/osg_files.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <osg/NodeVisitor>
#include <osg/Notify>
#include <osg/ProxyNode>
#include <osgDB/Options>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "import/reader/file_names.h"
#include "import/reader/format_table.h"
#include "osg_plugins/plugins.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;
using Result = osgDB::ReaderWriter::ReadResult;

/// Limit of files that name files.
constexpr std::size_t nesting_limit = 64;

/// Claims all formats of images and finds no image, so that osgDB loads no decoder for an image inside another file.
/// Collision needs no colours, and image decoders are a common target of attacks.
class NoImages : public osgDB::ReaderWriter {
 public:
  NoImages() {
    for (const ImageFormat& image : image_formats) supportsExtension(std::string(image.extension), "left out");
  }
  const char* className() const override { return "no images"; }
  Result readImage(const std::string&, const osgDB::Options*) const override { return Result::FILE_NOT_FOUND; }
  Result readImage(std::istream&, const osgDB::Options*) const override { return Result::FILE_NOT_FOUND; }
};

/// Formats whose files may name files of all these formats. Files of other formats name only images.
constexpr std::array<std::string_view, 5> naming{"ive", "osg", "osgb", "osgt", "osgx"};

/// Libraries whose classes a file of the plugin "osg" may name.
constexpr std::array<std::string_view, 10> class_libraries{"osg",          "osgsim",    "osgtext",    "osgfx",
                                                           "osgparticle",  "osgshadow", "osgterrain", "osgvolume",
                                                           "osganimation", "osgutil"};

bool names_files(std::string_view extension) {
  return std::find(naming.begin(), naming.end(), extension) != naming.end();
}

/// The path of a file that another file names. An absolute name is returned as it is. Otherwise tries the name, then
/// its last part, in the folders of the files that name it. Returns the first that exists, else a path outside of the
/// scene if the name leads there, else the path where the file would be.
fs::path place_of(const std::string& name, const osgDB::Options* options, SceneFiles& files) {
  std::string spelling = name;
  std::replace(spelling.begin(), spelling.end(), '\\', '/');
  const fs::path path(spelling);
  if (path.is_absolute()) return path;
  fs::path first, outside;
  for (const fs::path& wanted : {path, path.filename()}) {
    for (const std::string& folder : options == nullptr ? osgDB::FilePathList() : options->getDatabasePathList()) {
      const fs::path place = fs::path(folder) / wanted;
      if (first.empty()) first = place;
      if (outside.empty() && !files.resolve(place)) outside = place;
      if (!files.look_up(place).empty()) return place;
    }
  }
  return outside.empty() ? first : outside;
}

/// Adds the files of the proxies that OpenSceneGraph's pager would load while it draws.
class LoadDeferredProxies : public osg::NodeVisitor {
 public:
  /// Reads a file that a proxy names, from its folder.
  using Read = std::function<osg::ref_ptr<osg::Node>(const std::string& folder, const std::string& file)>;
  explicit LoadDeferredProxies(Read read) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), read_(std::move(read)) {}

  void apply(osg::Node& node) override {
    // A damaged graph may contain itself.
    if (visited_.insert(&node).second) traverse(node);
  }
  void apply(osg::ProxyNode& proxy) override {
    apply(static_cast<osg::Node&>(proxy));
    if (proxy.getLoadingExternalReferenceMode() != osg::ProxyNode::DEFER_LOADING_TO_DATABASE_PAGER) return;
    // A file that names this one shall not load these again.
    proxy.setLoadingExternalReferenceMode(osg::ProxyNode::LOAD_IMMEDIATELY);
    for (unsigned i = proxy.getNumChildren(); i < proxy.getNumFileNames(); ++i) {
      if (proxy.getFileName(i).empty()) continue;
      const osg::ref_ptr<osg::Node> file = read_(proxy.getDatabasePath(), proxy.getFileName(i));
      if (file != nullptr) proxy.addChild(file);
    }
  }

 private:
  Read read_;
  std::set<const osg::Node*> visited_;
};

class GuardedReading : public osgDB::ReadFileCallback {
 public:
  GuardedReading(MeshSink& sink, SceneFiles& files) : sink_(sink), files_(files) {}

  Result readNode(const std::string& name, const osgDB::Options* options) override {
    const bool main = std::exchange(next_is_main_, false);
    const fs::path place = place_of(name, options, files_);
    if (name.find("://") != std::string::npos || place.empty()) return missing(name);
    if (!files_.resolve(place)) {
      files_.leave_out(place);
      return Result::FILE_NOT_FOUND;
    }
    osgDB::ReaderWriter* reader = reader_for(place);
    if (reader == nullptr) return missing(name);
    const fs::path file = files_.open(place);
    // A file that names a file still being read makes a circle.
    const bool circle = std::find(reading_.begin(), reading_.end(), file) != reading_.end();
    if (file.empty() || circle || reading_.size() >= nesting_limit) return missing(name);
    reading_.push_back(file);
    const osg::ref_ptr<osgDB::Options> own = options == nullptr ? new osgDB::Options : options->cloneOptions();
    own->getDatabasePathList().push_front(file.parent_path().string());
    Result result = reader->readNode(file.string(), own);
    if (osg::Node* node = result.getNode()) {
      LoadDeferredProxies load([&](const std::string& folder, const std::string& named) {
        const osg::ref_ptr<osgDB::Options> below = own->cloneOptions();
        below->getDatabasePathList().push_front((file.parent_path() / folder).string());
        return osg::ref_ptr<osg::Node>(readNode(named, below).getNode());
      });
      node->accept(load);
    }
    reading_.pop_back();
    if (!result.validNode()) return main ? result : missing(name);
    if (quiet_) return result;
    sink_.count_file();
    std::error_code unseen;
    const auto bytes = fs::file_size(file, unseen);
    sink_.report_more_progress(unseen ? 0 : bytes);
    return result;
  }
  Result readObject(const std::string& file, const osgDB::Options* options) override { return readNode(file, options); }
  Result readImage(const std::string& file, const osgDB::Options* options) override {
    if (!images_) return Result::FILE_NOT_FOUND;
    fs::path folder;
    if (options != nullptr && !options->getDatabasePathList().empty()) folder = options->getDatabasePathList().front();
    osg::ref_ptr<osg::Image> image = sink_.parts()->textures().find(folder, file);
    return image == nullptr ? Result(Result::FILE_NOT_FOUND) : Result(image.get());
  }
  Result openArchive(const std::string&, osgDB::ReaderWriter::ArchiveStatus, unsigned, const osgDB::Options*) override {
    return Result::FILE_NOT_FOUND;
  }
  Result readHeightField(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }
  Result readShader(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }
  Result readScript(const std::string&, const osgDB::Options*) override { return Result::FILE_NOT_FOUND; }

  /// Finds a file for a plugin that opens it by itself.
  std::string find(const std::string& name, const osgDB::Options* options) {
    const fs::path place = place_of(name, options, files_);
    if (!place.empty() && !files_.resolve(place)) files_.leave_out(place);
    return place.empty() ? "" : files_.open(place).string();
  }

  void expect_main() { next_is_main_ = true; }
  void set_images(bool wanted) { images_ = wanted; }
  void set_quiet(bool quiet) { quiet_ = quiet; }

 private:
  /// The loaded plugin for a file, by its extension; null for all other formats.
  static osgDB::ReaderWriter* reader_for(const fs::path& file) {
    const std::string extension = extension_of(file);
    const Format* format = format_of(extension);
    if (format == nullptr || format->family != Family::osg) return nullptr;
    return osgDB::Registry::instance()->getReaderWriterForExtension(extension);
  }
  Result missing(const std::string& file) {
    if (!quiet_) sink_.report_missing_page(file);
    return Result::FILE_NOT_FOUND;
  }

  MeshSink& sink_;
  SceneFiles& files_;
  std::vector<fs::path> reading_;  ///< the files being read, each named by the one before
  bool next_is_main_ = false;
  bool images_ = false;
  bool quiet_ = false;
};

/// Keeps the last message of osgDB for the report of a failure. Passes all messages on to the standard error.
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

void load_osg_plugins(const std::string& extension) {
  const bool all = extension.empty() || names_files(extension);
  for (const Format& format : formats) {
    // The library of Inventor is large, and no other format names its files.
    const bool wanted = format.extension == extension || (all && format.extension != "iv");
    if (format.family == Family::osg && wanted) osg_plugins::load(format.plugin);
  }
  if (!all) return;
  for (const std::string_view library : class_libraries) {
    osg_plugins::load("serializers_" + std::string(library));
    osg_plugins::load("deprecated_" + std::string(library));
  }
}

void load_image_plugins() {
  for (const ImageFormat& image : image_formats) {
    if (!image.plugin.empty()) osg_plugins::load(image.plugin);
  }
}

void close_osg_door() {
  osg_plugins::close_door([](const std::string& name, const osgDB::Options* options) {
    return guard == nullptr ? std::string() : guard->find(name, options);
  });
}

void prepare_osg(MeshSink& sink, SceneFiles& files, bool images) {
  complaints = new Complaints;
  osg::setNotifyLevel(osg::WARN);
  osg::setNotifyHandler(complaints);
  osgDB::Registry* registry = osgDB::Registry::instance();
  no_images = new NoImages;
  guard = new GuardedReading(sink, files);
  registry->setReadFileCallback(guard);
  set_images(images);
  // Readers of other formats would build kd-trees, which reorder triangles.
  registry->setBuildKdTreesHint(osgDB::Options::DO_NOT_BUILD_KDTREES);
}

osg::ref_ptr<osg::Node> read_osg_file(const fs::path& path, bool main) {
  osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
  options->setObjectCacheHint(osgDB::Options::CACHE_NONE);
  options->setDatabasePath(path.parent_path().string());
  if (main) guard->expect_main();
  Result result = guard->readNode(path.string(), options);
  if (!result.validNode() && !result.message().empty()) OSG_WARN << result.message() << std::endl;
  return result.getNode();
}

osg::ref_ptr<osg::Node> read_osg_file_quietly(const fs::path& path) {
  guard->set_quiet(true);
  osg::ref_ptr<osg::Node> node = read_osg_file(path, false);
  guard->set_quiet(false);
  return node;
}

osg::ref_ptr<osg::Node> read_again_with_images(const fs::path& path) {
  set_images(true);
  return read_osg_file_quietly(path);
}

std::string last_osg_complaint() {
  std::string text = complaints->last();
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

}  // namespace roam::reader
