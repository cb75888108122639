#pragma once
/// \file
/// The images of a scene: looked for where exporters leave them, decoded when they are needed, each one once.

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

/// How an image goes on beyond its edges, across and up.
struct Wrapping {
  DisplayWrap across = DisplayWrap::repeat;
  DisplayWrap up = DisplayWrap::repeat;
};

class Textures {
 public:
  Textures(FrameWriter& frames, SceneFiles& files) : frames_(frames), files_(files) {}

  /// The files that images may be read from.
  [[nodiscard]] SceneFiles& files() { return files_; }

  /// The image that a file in `folder` calls `name`. It is looked for when it is needed.
  TextureId add_file(const std::filesystem::path& folder, const std::string& name, Wrapping wrapping);
  /// An encoded image inside a scene's file. `key` tells it from others; `read` gives the bytes of the image.
  TextureId add_encoded(const std::string& key, std::function<std::string()> read, Wrapping wrapping);
  /// An image that is decoded already.
  TextureId add_image(osg::Image& image, Wrapping wrapping);

  /// The image, decoded anew each time; null when there is none, which is reported once.
  [[nodiscard]] osg::ref_ptr<osg::Image> load(TextureId texture);
  [[nodiscard]] Wrapping wrapping(TextureId texture) const { return sources_.at(texture).wrapping; }
  /// Lets go of the images of find and add_image; the latter's numbers must not be used any more.
  void forget_images();

  /// The image of that name, for files that OpenSceneGraph reads itself; null when there is none, which is reported.
  [[nodiscard]] osg::ref_ptr<osg::Image> find(const std::filesystem::path& folder, const std::string& name);

  [[nodiscard]] std::uint64_t read() const { return read_; }
  [[nodiscard]] std::uint64_t missing() const { return missing_.size(); }

 private:
  struct Source {
    std::string name;
    std::function<osg::ref_ptr<osg::Image>()> decode;
    osg::ref_ptr<osg::Image> image;  ///< where there is nothing to decode
    Wrapping wrapping;
    bool counted = false;
  };

  TextureId add(const std::string& key, Source&& source);
  void report_missing(const std::string& name);

  FrameWriter& frames_;
  SceneFiles& files_;
  std::vector<Source> sources_;
  std::map<std::string, TextureId> known_;
  std::map<std::string, osg::ref_ptr<osg::Image>> found_;
  std::set<std::string> missing_;
  std::uint64_t read_ = 0;
  bool reduced_ = false;
};

}  // namespace roam::reader
