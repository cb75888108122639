#pragma once
/// \file
/// Tokens that identify pages: the inherited transform, name and state, which the page's own file does not have.

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
  osg::Matrixd to_world;             ///< of the nodes above it, in all files on the path to it
  std::string name;                  ///< of the innermost of these nodes with a name
  std::uint32_t state = 0;           ///< number of the state of these nodes in this process's PageStates
  std::vector<std::uint64_t> above;  ///< hashes of the files on the path to it
};

[[nodiscard]] std::uint64_t hash_of(const std::filesystem::path& file);

/// The value of DisplayLevel::page; empty if it would be too long.
[[nodiscard]] std::string token_of(const PageContext& page);
/// The page of a token. Empty if the token is invalid.
[[nodiscard]] std::optional<PageContext> page_of(std::string_view token);

}  // namespace roam::reader
