#pragma once
/// \file
/// Image files: where they lie, and what is in them.

#include <filesystem>
#include <osg/Image>
#include <osg/ref_ptr>
#include <string>

#include "import/reader/scene_files.h"

namespace roam::reader {

/// The file that a scene in `folder` means by `name`: names of other machines and systems are tried in the folders
/// that exporters use. Empty when there is none among the scene's files; one that lies outside is left out and
/// reported.
[[nodiscard]] std::filesystem::path find_image_file(SceneFiles& files, const std::filesystem::path& folder,
                                                    const std::string& name);

/// The content of a file that find_image_file found; empty when it cannot be read or is larger than any image that
/// means well.
[[nodiscard]] std::string image_bytes(SceneFiles& files, const std::filesystem::path& file);

/// The image that `bytes` encode, its first row the lowest; null when they encode none. `name` says the format where
/// the bytes do not. DDS images have their first row on top; `turn_dds` turns them, which OpenSceneGraph itself does
/// not.
[[nodiscard]] osg::ref_ptr<osg::Image> decode_image(const std::string& bytes, const std::string& name, bool turn_dds);

/// No side of an image that is shown is longer.
inline constexpr int image_size_limit = 4096;
/// Whether the image was larger and has been halved, by averaging, until it is not. Kinds that are no bytes for each
/// channel stay as they are.
bool reduce_image(osg::ref_ptr<osg::Image>& image);

}  // namespace roam::reader
