#pragma once
/// \file
/// A building of the generated city: facades with window recesses, a door into two rooms, a passage from front to back,
/// bays that overhang the street, a roof behind a parapet.

#include <cstdint>

#include "generate/surface.h"

namespace roam::generate {

/// How one kind of building looks. Lengths in metres.
struct BuildingDesign {
  int bays = 4, side_bays = 3, storeys = 5;
  double bay = 4.0, side_bay = 4.0, storey = 3.2;
  double window_width = 1.4, window_height = 1.4;
  int overhanging_bay = -1;  ///< number of the bay of the front, above the ground floor; -1: none
  bool passage = false;      ///< through the last bay, from the front to the back
  bool windows = true;

  [[nodiscard]] double width() const;
  [[nodiscard]] double depth() const;
  [[nodiscard]] double height() const;
};

/// m: the highest that design() makes.
inline constexpr double greatest_building_height = 40.0;
/// m: how far a bay overhangs the front.
inline constexpr double overhang = 0.9;

/// Design `number` of a city.
[[nodiscard]] BuildingDesign design(std::uint64_t seed, int number, bool windows);

/// Position of a building: its front runs from `corner` along `ahead`, its depth to the left of that.
struct Site {
  Vec3 corner{0.0};
  Vec3 ahead{1.0, 0.0, 0.0}, aside{0.0, 1.0, 0.0};
};

/// Facades, roof and passage, closed except for the front door.
[[nodiscard]] Part facades(const BuildingDesign& design, const Site& site, double cell);
/// The front door, the first room and the second. Shares its border with the facades.
[[nodiscard]] Part interior(const BuildingDesign& design, const Site& site, double cell);

}  // namespace roam::generate
