#pragma once
/// \file
/// First impacts in an index with skipped triangles. They have a file of their own, so that the compiler optimizes the
/// plain traversal as if they did not exist.

#include "index/traverse.h"

namespace roam::index {

/// first_impact() with the triangles that are not skipped; Index::skip must not be null.
[[nodiscard]] Impact first_impact_of_rest(const Index& index, const Piece& piece, double until);
[[nodiscard]] Impact first_impact_of_rest(const Index& index, std::span<const Root> roots, const Piece& piece,
                                          double until);

}  // namespace roam::index
