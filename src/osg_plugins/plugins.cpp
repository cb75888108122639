#include "osg_plugins/plugins.h"

#include <dlfcn.h>

#include <filesystem>
#include <osg/Version>
#include <osgDB/Callbacks>
#include <osgDB/Registry>
#include <string>
#include <system_error>
#include <utility>

namespace roam::osg_plugins {
namespace {

namespace fs = std::filesystem;

/// The folder of the plugins: beside the library itself. Empty if the system cannot say.
fs::path plugin_folder() {
  Dl_info library{};
  // Any function of the library will do.
  const auto function = &osgDB::Registry::instance;
  if (dladdr(reinterpret_cast<const void*>(function), &library) == 0 || library.dli_fname == nullptr) return {};
  std::error_code none;
  const fs::path file = fs::absolute(library.dli_fname, none);
  return file.parent_path() / ("osgPlugins-" + std::string(osgGetVersion()));
}

class ClosedDoor : public osgDB::FindFileCallback {
 public:
  explicit ClosedDoor(FindFile find) : find_(std::move(find)) {}
  /// Returns a path without a library. An empty path would make OpenSceneGraph try the bare name in the current folder.
  std::string findLibraryFile(const std::string&, const osgDB::Options*, osgDB::CaseSensitivity) override {
    return "/dev/null/no-library";
  }
  std::string findDataFile(const std::string& name, const osgDB::Options* options, osgDB::CaseSensitivity) override {
    return find_(name, options);
  }

 private:
  FindFile find_;
};

}  // namespace

bool load(std::string_view name) {
  static const fs::path folder = plugin_folder();
  const fs::path file = folder / ("osgdb_" + std::string(name) + ".so");
  std::error_code none;
  if (folder.empty() || !fs::is_regular_file(file, none)) return false;
  return osgDB::Registry::instance()->loadLibrary(file.string()) != osgDB::Registry::NOT_LOADED;
}

void close_door(FindFile find) { osgDB::Registry::instance()->setFindFileCallback(new ClosedDoor(std::move(find))); }

}  // namespace roam::osg_plugins
