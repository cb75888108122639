#pragma once
/// \file
/// What a page is asked for by: all that its own file does not say of where and how it is shown.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <osg/Matrixd>
#include <string>
#include <string_view>
#include <vector>

#include "roam/math.h"

namespace roam::reader {

struct PageContext {
  std::filesystem::path file;
  Vec3 offset{0.0};                  ///< MeshSink::set_offset
  osg::Matrixd to_world;             ///< of the nodes above it, in the files through which it is reached
  std::string name;                  ///< of the innermost of these that has one
  std::uint32_t state = 0;           ///< number of what these say of looks, where this process keeps it
  std::vector<std::uint64_t> above;  ///< hashes of these files
};

[[nodiscard]] std::uint64_t hash_of(const std::filesystem::path& file);

/// What DisplayLevel::page holds; empty where it would be too long.
[[nodiscard]] std::string token_of(const PageContext& page);
/// Nothing where the token is none.
[[nodiscard]] std::optional<PageContext> page_of(std::string_view token);

}  // namespace roam::reader
