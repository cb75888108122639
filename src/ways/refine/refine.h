#pragma once
/// \file
/// From places of a lattice to a way and a width in tenths of a millimetre.

#include <functional>
#include <span>

#include "roam/passage.h"
#include "ways/lattice/lattice.h"

namespace roam::ways {

/// The way along `places` of a lattice, made as wide as it goes: at each place below the best it zooms in (finer
/// lattices around it), then polishes (stations of 2 cm, each moved sideways to its widest), and joins the ridges. The
/// result is smooth enough to be walked: certified by sweeps of `radius` less 0.5 mm between its points.
[[nodiscard]] Passage refine(const Survey& survey, const Measure& measure, double spacing,
                             std::span<const Vec3> places);

/// Whether a body of `radius` goes straight from one place to the other: certified.
[[nodiscard]] bool passes(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to,
                          double radius);

/// The opening at the narrowest place of a way there: its two sides.
[[nodiscard]] Opening opening_at(const Survey& survey, const Measure& measure, const Vec3& place, double radius);

}  // namespace roam::ways
