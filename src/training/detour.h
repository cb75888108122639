#pragma once
/// \file
/// Whether a body can walk around a crack.

#include <optional>

#include "roam/train.h"
#include "training/layout.h"

namespace roam::training {

/// The places on both sides of a crack, if every examined way between them crosses a gap of the floor. None if there is
/// a way around, or if one side is not reached.
[[nodiscard]] std::optional<Ends> must_be_crossed(const Survey& survey, const Layout& layout,
                                                  const ReachedFloor& reached, const Crack& crack);

}  // namespace roam::training
