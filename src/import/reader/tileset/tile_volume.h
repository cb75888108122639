#pragma once
/// \file
/// Bounding volumes of tiles.

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>

#include "import/reader/json.h"
#include "import/reader/tileset/subtree.h"
#include "roam/math.h"

namespace roam::reader {

class TileVolume {
 public:
  /// That of a tile: a box, a sphere or a region.
  explicit TileVolume(const Json& tile);

  /// That of an implicit tile below the tile of this volume. The standard divides boxes and regions.
  [[nodiscard]] TileVolume part(const ImplicitTile& tile, unsigned dimensions) const;
  /// The box around it along the axes. `matrix`: the transform of the tile; `earth`: that of Earth-centred coordinates,
  /// which regions have. Unset if there is no volume that can be read.
  [[nodiscard]] std::optional<Box> around(const glm::dmat4& matrix, const glm::dmat4& earth) const;

 private:
  enum class Kind : std::uint8_t { none, box, sphere, region };
  Kind kind_ = Kind::none;
  std::array<double, 12> n_{};  ///< the numbers of the standard
};

}  // namespace roam::reader
