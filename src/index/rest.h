#pragma once
/// \file
/// First impacts in an index of which triangles are passed over: in a file of their own, so that the compiler makes of
/// the traversal what it made of it alone.

#include "index/traverse.h"

namespace roam::index {

/// first_impact() with what is left; Index::skip is not null.
[[nodiscard]] Impact first_impact_of_rest(const Index& index, const Piece& piece, double until);
[[nodiscard]] Impact first_impact_of_rest(const Index& index, std::span<const Root> roots, const Piece& piece,
                                          double until);

}  // namespace roam::index
