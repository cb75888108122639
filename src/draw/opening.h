#pragma once
/// \file
/// Pictures of the places that limit a body: `roam probe --picture` and `roam train --picture`. For each door, lintel,
/// gap or crack: a plan and a section to the same scale, with the body and the measured width.
///
///     draw::PictureFile file("door.png");  // before the long work: it may not be writable
///     file.write(draw::opening_sheet("dam.ply", openings, survey.meshes()));

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "draw/overview.h"
#include "draw/sheet.h"
#include "roam/mesh.h"
#include "roam/walker.h"

namespace roam::draw {

/// A place that limits a body, and the body.
struct OpeningView {
  enum class Kind : std::uint8_t {
    passage,  ///< walls on both sides, or a surface above
    crack,    ///< a gap of the floor
    beside,   ///< a wall on one side; `width` is the distance from it to the body's axis
    step,     ///< the floor rises or falls by `width` at once
    apart,    ///< two parts come near each other without a connection; `width` is 0
  };
  Kind kind = Kind::passage;
  std::string heading;  ///< "Door 0.52 m wide"
  std::string text;     ///< a sentence or two, for people
  Vec3 point{0.0};      ///< its middle; for a crack at the level of the rim
  Vec3 direction{0.0};  ///< unit, from one side to the other
  double width = 0.0;   ///< metres along `direction`
  /// Level, the direction of travel; needed only if `direction` is upright. 0: unknown.
  Vec3 heading_to{0.0};
  Mode mode = Mode::walk;
  double floor = 0.0;  ///< z of the feet there, metres; flying: of the body's lowest point
  double radius = 0.0;
  double height = 0.0;          ///< of the body, metres: at least twice the radius
  double step = 0.3;            ///< on foot: the body walks over obstacles lower than this above the feet
  double support_radius = 0.0;  ///< of the support disc, metres; 0: none
  /// The drawn body's position, of the feet (flying: the centre), if it is not in the middle of the opening.
  std::optional<Vec3> body;
  /// Metres along the way over which the opening is this narrow. Walls within it are shown as faces in the section.
  double depth = 0.0;
  bool fits = false;  ///< the body passes, or does not fall: drawn blue, else red
};

/// Plans and sections one below the other, under the overview and `text` if there are any. An empty list gives a sheet
/// with only its title. Throws roam::Cancelled after Ctrl-C.
[[nodiscard]] Sheet opening_sheet(const std::string& title, std::span<const OpeningView> openings,
                                  std::span<const Mesh> meshes, const std::string& text = {},
                                  const std::optional<Overview>& overview = {});

}  // namespace roam::draw
