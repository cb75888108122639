#pragma once
/// \file
/// The body of a verb: as its options describe it, else as a path or a profile states it, else a person.

#include <initializer_list>
#include <optional>
#include <string>

#include "roam/profile.h"
#include "roam/walker_settings.h"
#include "scenes/recorded_body.h"

namespace CLI {
class App;
}

namespace roam::app {

/// Height of a body without a given one, in m: a person's 1.8, but at least 2 * radius; of a sphere 2 * radius.
[[nodiscard]] double default_height(double radius, bool sphere);

/// Height of the camera of a body without a given one, in m: a person's 1.6, but on the axis, a radius away from every
/// surface.
[[nodiscard]] double default_eye(double radius, double height);

/// Adds --mode with the names of these modes. `mode` stays empty without it.
void add_mode_to(CLI::App& verb, std::optional<Mode>& mode, std::initializer_list<Mode> modes,
                 const std::string& description);

/// Throws UsageError if no body of that height steps as high, both in m.
void demand_possible_step(double step, double height);

/// The reason why `--mode fly` of a search demands --sphere.
inline constexpr const char* flight_is_for_spheres = "ways through the air are found for spheres; add --sphere";

/// The known sizes of a body: lengths in m, the slope in degrees.
struct BodySizes {
  std::optional<double> radius, height, eye, step, slope, support_radius;
};
[[nodiscard]] BodySizes sizes_of(const RecordedBody& recorded);
/// A profile has no eye.
[[nodiscard]] BodySizes sizes_of(const Profile& profile);

/// Adds --sphere, which excludes --height. Call it after adding --height.
void add_sphere_to(CLI::App& verb, bool& sphere);

/// The options that describe a body that moves.
struct BodyOptions : BodySizes {
  bool sphere = false;

  /// Adds --radius, --height, --sphere, --support-radius, --eye, --step and --slope.
  void add_to(CLI::App& verb);
  /// Whether they describe a body of their own, in place of a recorded or trained one.
  [[nodiscard]] bool describe_a_body() const { return radius || sphere; }
};

/// The body of these options. What they leave open is as `known`, unless they describe a body of their own; the rest is
/// that of a person. A given height lowers known eye and step to fit. Does not check the values.
[[nodiscard]] WalkerSettings body_of(const BodyOptions& options, const BodySizes& known);

}  // namespace roam::app
