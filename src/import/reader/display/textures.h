#pragma once
/// \file
/// The images of a scene: found where exporters leave them, decoded on demand, each one once.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <osg/Image>
#include <osg/ref_ptr>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "import/display_part.h"
#include "import/reader/display/look.h"
#include "import/reader/frame_writer.h"
#include "import/reader/scene_files.h"

namespace roam::reader {

/// How an image continues beyond its edges, across and up.
struct Wrapping {
  DisplayWrap across = DisplayWrap::repeat;
  DisplayWrap up = DisplayWrap::repeat;
};

class Textures {
 public:
  Textures(FrameWriter& frames, SceneFiles& files) : frames_(frames), files_(files) {}

  /// The files from which images may be read.
  [[nodiscard]] SceneFiles& files() { return files_; }

  /// Adds the image that a file in `folder` refers to as `name`. The file is searched on demand.
  TextureId add_file(const std::filesystem::path& folder, const std::string& name, Wrapping wrapping);
  /// Adds an encoded image embedded in a scene's file. `key` identifies it; `read` returns its bytes.
  TextureId add_encoded(const std::string& key, std::function<std::string()> read, Wrapping wrapping);
  /// Adds a decoded image.
  TextureId add_image(osg::Image& image, Wrapping wrapping);

  /// Notes, once, that images are left out whose coordinates only a graphics card computes.
  void leave_out_generated();

  /// The first of all images that are the same file with the same wrapping, however its name is written.
  [[nodiscard]] TextureId first_of(TextureId texture);
  /// The image, decoded anew each time. Null if there is none, which is reported once.
  [[nodiscard]] osg::ref_ptr<osg::Image> load(TextureId texture);
  [[nodiscard]] Wrapping wrapping(TextureId texture) const { return sources_.at(texture).wrapping; }
  /// Frees the images of find and add_image. Numbers from add_image must not be used any more.
  void forget_images();

  /// The image of that name, for files that OpenSceneGraph reads itself. Null if there is none, which is reported.
  [[nodiscard]] osg::ref_ptr<osg::Image> find(const std::filesystem::path& folder, const std::string& name);

  [[nodiscard]] std::uint64_t read() const { return read_; }
  [[nodiscard]] std::uint64_t missing() const { return missing_.size(); }

 private:
  struct Source {
    std::string name;
    std::function<osg::ref_ptr<osg::Image>()> decode;
    osg::ref_ptr<osg::Image> image;  ///< for images that are already decoded
    Wrapping wrapping;
    std::function<std::filesystem::path()> find = {};  ///< the file, not yet searched; then `decode` is set
    TextureId first = {};                              ///< the first image of the same file and wrapping
    bool counted = false;
  };

  TextureId add(const std::string& key, Source&& source);
  void report_missing(const std::string& name);

  FrameWriter& frames_;
  SceneFiles& files_;
  std::vector<Source> sources_;
  std::map<std::string, TextureId> known_;
  std::map<std::string, std::filesystem::path> spelt_;     ///< the file of each name in find(); empty if there is none
  std::map<std::string, osg::ref_ptr<osg::Image>> found_;  ///< by file
  std::set<std::string> missing_;
  std::uint64_t read_ = 0;
  bool reduced_ = false, left_out_generated_ = false;
};

}  // namespace roam::reader
