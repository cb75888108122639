#pragma once
/// \file
/// The marked places of a walk.

#include <string>
#include <vector>

#include "draw/stations.h"
#include "draw/way.h"
#include "words/walk.h"

namespace roam::draw {

/// Ordered by importance.
enum class MarkKind : std::uint8_t { end, blocked, narrowest, nearest, start, fell };

struct Mark {
  MarkKind kind = MarkKind::start;
  Vec3 point{0.0};                 ///< the body's centre; for `blocked` the touched point
  Vec3 centre{0.0};                ///< of the body there
  double height = 0.0;             ///< of that body, metres
  double along = 0.0;              ///< metres, as WayPoint::along
  std::vector<std::string> label;  ///< its name, "start", "narrowest", ..., then more about it: "0.75 m clear"
};

/// The marks in their order along the way. `nearest`, the place of the least certified clearance, only for flying: on
/// foot that would be the ground.
[[nodiscard]] std::vector<Mark> find_marks(const words::EndedWalk& report, const Record& record, const Way& way,
                                           const RoomSurvey& survey);

/// A length for people: "0.62 m", "12.5 m", "1.79 km"; below a centimetre in millimetres: "4.2 mm".
[[nodiscard]] std::string length_text(double metres);

}  // namespace roam::draw
