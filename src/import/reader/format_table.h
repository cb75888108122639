#pragma once
/// \file
/// The formats that roam reads, each with the library that reads it.

#include <array>
#include <string_view>

namespace roam::reader {

enum class Family { obj, stl, ply, osg, assimp };

struct Format {
  std::string_view extension;  ///< lower case, without the dot
  Family family;
  std::string_view plugin = {};  ///< OpenSceneGraph's, osgdb_NAME; "osg" reads four formats
};

/// Where both libraries know a format, the one that reads more of the files that are about: OpenSceneGraph refuses some
/// exporters' Collada, and assimp knows no 3DS hierarchy.
inline constexpr std::array<Format, 23> formats{{{"obj", Family::obj},         {"stl", Family::stl},
                                                 {"ply", Family::ply},         {"ive", Family::osg, "ive"},
                                                 {"osg", Family::osg, "osg"},  {"osgb", Family::osg, "osg"},
                                                 {"osgt", Family::osg, "osg"}, {"osgx", Family::osg, "osg"},
                                                 {"3ds", Family::osg, "3ds"},  {"flt", Family::osg, "openflight"},
                                                 {"dae", Family::assimp},      {"ac", Family::osg, "ac"},
                                                 {"dxf", Family::osg, "dxf"},  {"lwo", Family::osg, "lwo"},
                                                 {"x", Family::osg, "x"},      {"iv", Family::osg, "iv"},
                                                 {"glb", Family::assimp},      {"gltf", Family::assimp},
                                                 {"fbx", Family::assimp},      {"ifc", Family::assimp},
                                                 {"off", Family::assimp},      {"3mf", Family::assimp},
                                                 {"blend", Family::assimp}}};

/// Null for a format that roam does not read.
constexpr const Format* format_of(std::string_view extension) {
  for (const Format& format : formats) {
    if (format.extension == extension) return &format;
  }
  return nullptr;
}

}  // namespace roam::reader
