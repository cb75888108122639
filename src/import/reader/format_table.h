#pragma once
/// \file
/// The formats that roam reads, and the library for each.

#include <array>
#include <string_view>

namespace roam::reader {

enum class Family { obj, stl, ply, osg, gltf, tileset, assimp };

struct Format {
  std::string_view extension;  ///< lower case, without the dot
  Family family;
  std::string_view plugin = {};  ///< name of OpenSceneGraph's plugin osgdb_NAME; "osg" reads four formats
};

/// If both libraries know a format, the table has the one that reads more files in practice. OpenSceneGraph refuses
/// Collada of some exporters, and assimp has no hierarchy in 3DS.
inline constexpr std::array<Format, 29> formats{{{"obj", Family::obj},         {"stl", Family::stl},
                                                 {"ply", Family::ply},         {"ive", Family::osg, "ive"},
                                                 {"osg", Family::osg, "osg"},  {"osgb", Family::osg, "osg"},
                                                 {"osgt", Family::osg, "osg"}, {"osgx", Family::osg, "osg"},
                                                 {"3ds", Family::osg, "3ds"},  {"flt", Family::osg, "openflight"},
                                                 {"dae", Family::assimp},      {"ac", Family::osg, "ac"},
                                                 {"dxf", Family::osg, "dxf"},  {"lwo", Family::osg, "lwo"},
                                                 {"x", Family::osg, "x"},      {"iv", Family::osg, "iv"},
                                                 {"glb", Family::gltf},        {"gltf", Family::gltf},
                                                 {"json", Family::tileset},    {"b3dm", Family::tileset},
                                                 {"i3dm", Family::tileset},    {"cmpt", Family::tileset},
                                                 {"3tz", Family::tileset},     {"zip", Family::tileset},
                                                 {"fbx", Family::assimp},      {"ifc", Family::assimp},
                                                 {"off", Family::assimp},      {"3mf", Family::assimp},
                                                 {"blend", Family::assimp}}};

/// A kind of image that other files may name or contain. It may have several entries.
struct ImageFormat {
  std::string_view extension;    ///< lower case, without the dot
  std::string_view plugin = {};  ///< name of OpenSceneGraph's plugin osgdb_NAME; empty: never decoded
  std::string_view start = {};   ///< first bytes of every such file; empty: known only by the extension
};

inline constexpr std::array<ImageFormat, 27> image_formats{{{"jpg", "jpeg", "\xff\xd8\xff"},
                                                            {"jpeg", "jpeg", "\xff\xd8\xff"},
                                                            {"jpe", "jpeg", "\xff\xd8\xff"},
                                                            {"png", "png", "\x89PNG"},
                                                            {"tif", "tiff", std::string_view("II*\0", 4)},
                                                            {"tiff", "tiff", std::string_view("MM\0*", 4)},
                                                            {"dds", "dds", "DDS "},
                                                            {"gif", "gif", "GIF8"},
                                                            {"bmp", "bmp", "BM"},
                                                            {"sgi", "rgb", "\x01\xda"},
                                                            {"rgb", "rgb"},
                                                            {"rgba", "rgb"},
                                                            {"sgi", "rgb"},
                                                            {"bw", "rgb"},
                                                            {"int", "rgb"},
                                                            {"inta", "rgb"},
                                                            {"tga", "tga"},
                                                            {"pnm", "pnm"},
                                                            {"ppm", "pnm"},
                                                            {"pgm", "pnm"},
                                                            {"pbm", "pnm"},
                                                            {"hdr", "hdr"},
                                                            {"ktx"},
                                                            {"pic"},
                                                            {"attr"},
                                                            {"webp"},
                                                            {"pvr"}}};

/// Null for a format that roam does not read.
constexpr const Format* format_of(std::string_view extension) {
  for (const Format& format : formats) {
    if (format.extension == extension) return &format;
  }
  return nullptr;
}

}  // namespace roam::reader
