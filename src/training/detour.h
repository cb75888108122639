#pragma once
/// \file
/// Whether a crack can be walked around.

#include <optional>

#include "roam/train.h"
#include "training/layout.h"

namespace roam::training {

/// The places on both sides of a crack, where every way from one to the other that was looked at goes over a gap of the
/// floor; none where there is a way around, or one side is not reached.
[[nodiscard]] std::optional<Ends> must_be_crossed(const Survey& survey, const Layout& layout, const Reached& reached,
                                                  const Crack& crack);

}  // namespace roam::training
