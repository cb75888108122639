#pragma once
/// \file
/// Measuring by clicks: points, distances, and the room around the body.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "graphics/overlay.h"
#include "osgRoam/Manipulator.h"
#include "view/pick.h"
#include "view/status.h"

namespace roam::app {

/// One point, or two.
struct Measurement {
  Pick a;
  std::optional<Pick> b;
};

/// From the first point to the second; lengths in metres.
struct Span {
  double distance = 0.0;
  double level = 0.0;          ///< seen from above
  double height = 0.0;         ///< of the second point above the first
  double slope_degrees = 0.0;  ///< [-90, 90]
};
[[nodiscard]] Span span_of(const Vec3& a, const Vec3& b);

/// "floor, slope 3\u00b0", "wall facing 135\u00b0 (SE)": what a surface with this unit normal, towards the eye, is to a
/// person.
[[nodiscard]] std::string surface_text(const Vec3& normal);

/// The measurements of a session. The points are those of the collision data: exact to Space::largest_error(). Needs no
/// window. Call all members from one thread, between two frames.
class Measuring {
 public:
  explicit Measuring(const osgRoam::Manipulator& roamer) : roamer_(roamer) {}

  /// Takes a clicked point: the first of a measurement, or the second.
  void take(const Pick& pick);
  /// Forgets the points that are shown; the report keeps them.
  void clear() { shown_ = from_body_ = false; }
  /// A single point is the end of a way that a probe finds from the body: it is called B until the next click.
  void probe_from_body() { from_body_ = true; }

  /// Adds the points, their distance, and the free width and headroom at the body.
  void fill(Status& status);
  /// Adds the points and the line between them. `origin`: see Arrival::Seen.
  void add_to(graphics::Marks& marks, const Vec3& origin) const;
  /// The measurement that is shown; null: none.
  [[nodiscard]] const Measurement* shown() const { return shown_ ? &all_.back() : nullptr; }
  [[nodiscard]] const std::vector<Measurement>& all() const { return all_; }

 private:
  void name(Pick& pick) const;

  const osgRoam::Manipulator& roamer_;
  std::vector<Measurement> all_;
  std::weak_ptr<const Space> space_;  ///< of the last point
  bool shown_ = false;                ///< the last measurement is
  bool from_body_ = false;
};

/// "A 12.345, 5.600, 1.200, Door_12, wall facing 135° (SE)", and of two points also "; B ...; 2.100 m: ...".
[[nodiscard]] std::string text_of(const Measurement& measurement);

/// "1.20 m wide, 2.45 m high": free space across the gaze and above the feet. Needs a walker.
[[nodiscard]] std::string room_text(const osgRoam::Manipulator& roamer);

}  // namespace roam::app
