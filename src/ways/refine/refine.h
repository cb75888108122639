#pragma once
/// \file
/// From places of a lattice to a way and its width, exact to tenths of a millimetre.

#include <functional>
#include <span>

#include "roam/passage.h"
#include "ways/lattice/lattice.h"

namespace roam::ways {

/// Makes the way along `places` of a lattice as wide as possible. At each narrow place it zooms in (finer lattices
/// around it), then polishes (stations every 2 cm, each moved sideways to its widest), and joins the ridges. The result
/// is smooth enough to walk: between its points, sweeps of `radius` minus certified_margin() certify it.
[[nodiscard]] Passage refine(const Survey& survey, const Measure& measure, double spacing,
                             std::span<const Vec3> places);

/// Whether a body of `radius` goes straight from one place to the other: certified.
[[nodiscard]] bool passes(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to,
                          double radius);

/// The two sides of the opening at the narrowest place of a way.
[[nodiscard]] Opening opening_at(const Survey& survey, const Measure& measure, const Vec3& place, double radius);

/// Whether a body at the narrowest place of a way has surfaces within `reach` (m) on both sides of its opening. With
/// one side only, a larger body passes farther from it, if it can stand there. Below a lintel is floor.
[[nodiscard]] bool is_between(const Survey& survey, const Measure& measure, const Vec3& place, const Opening& opening,
                              double reach);

}  // namespace roam::ways
