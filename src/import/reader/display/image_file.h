#pragma once
/// \file
/// Image files: search, reading and decoding.

#include <filesystem>
#include <osg/Image>
#include <osg/ref_ptr>
#include <string>

#include "import/reader/scene_files.h"

namespace roam::reader {

/// The file that a scene in `folder` refers to by `name`. Paths of other machines and systems are tried in the folders
/// that exporters use. Empty if there is none among the scene's files. A file outside is left out and reported.
[[nodiscard]] std::filesystem::path find_image_file(SceneFiles& files, const std::filesystem::path& folder,
                                                    const std::string& name);

/// The contents of a file from find_image_file; empty if it cannot be read or is too large for an image.
[[nodiscard]] std::string image_bytes(SceneFiles& files, const std::filesystem::path& file);

/// Decodes an image, its lowest row first; null if `bytes` are no image. `name` gives the format where the bytes do
/// not. DDS images have their top row first. OpenSceneGraph leaves them so; `turn_dds` turns them.
[[nodiscard]] osg::ref_ptr<osg::Image> decode_image(const std::string& bytes, const std::string& name, bool turn_dds);

/// Upper bound of the sides of a displayed image, in texels.
inline constexpr int image_size_limit = 4096;
/// Halves the image by averaging until no side is longer than that. Returns whether it did. Images whose channels are
/// not bytes stay as they are.
bool reduce_image(osg::ref_ptr<osg::Image>& image);

}  // namespace roam::reader
