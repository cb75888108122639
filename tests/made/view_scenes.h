#pragma once
// Shared by the tests of roam view: scenes, pictures, and the report.

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <osg/Image>
#include <osgDB/Registry>
#include <set>
#include <string>

#include "cli_scenes.h"
#include "import_files.h"
#include "messages.h"
#include "program.h"

/// A picture file.
struct Shot {
  osg::ref_ptr<osg::Image> image;

  explicit Shot(const std::string& file) {
    // Read by the plugin itself: during a session, OpenSceneGraph reads only the session's input.
    auto* png = osgDB::Registry::instance()->getReaderWriterForExtension("png");
    if (png) image = png->readImage(file).getImage();
    if (!image) throw std::runtime_error("no picture: " + file);
  }
  [[nodiscard]] int width() const { return image->s(); }
  [[nodiscard]] int height() const { return image->t(); }
  /// Red, green and blue in [0, 1].
  [[nodiscard]] osg::Vec4 at(int x, int y) const {
    return image->getColor(static_cast<unsigned>(x), static_cast<unsigned>(y));
  }
  /// The number of colours that an eye distinguishes: a blank picture has one.
  [[nodiscard]] std::size_t colours() const {
    std::set<int> seen;
    for (int y = 0; y < height(); y += 2) {
      for (int x = 0; x < width(); x += 2) {
        const osg::Vec4 c = at(x, y);
        seen.insert(static_cast<int>(c.r() * 15) * 256 + static_cast<int>(c.g() * 15) * 16 +
                    static_cast<int>(c.b() * 15));
      }
    }
    return seen.size();
  }
  /// The share of pixels as blue as the sky: the scenes of the tests are grey.
  [[nodiscard]] double sky() const {
    int blue = 0;
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) blue += at(x, y).b() > at(x, y).r() + 0.1f;
    }
    return static_cast<double>(blue) / (width() * height());
  }
};

/// Hides the settings and bookmarks of the user who runs the tests.
inline void use_no_settings(const TestFolder& folder) { setenv("XDG_CONFIG_HOME", folder.file("config").c_str(), 1); }

inline std::string all(const nlohmann::json& lines) {
  std::string text;
  for (const auto& line : lines) text += line.get<std::string>() + "\n";
  return text;
}
