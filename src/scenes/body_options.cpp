#include "scenes/body_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "cli/exit_status.h"
#include "cli/values.h"
#include "math/step_limit.h"

namespace roam::app {

double default_height(double radius, bool sphere) {
  const double least = 2.0 * radius;
  return sphere ? least : std::max(WalkerSettings{}.height, least);
}

double default_eye(double radius, double height) {
  return std::max(std::min(WalkerSettings{}.eye, height - radius), 0.0);
}

BodySizes sizes_of(const RecordedBody& recorded) {
  const WalkerSettings& s = recorded.settings;
  return {s.radius, s.height, s.eye, s.step, s.slope_degrees, s.support_radius};
}

BodySizes sizes_of(const Profile& profile) {
  return {profile.radius, profile.height, std::nullopt, profile.step, profile.slope_degrees, profile.support_radius};
}

void add_mode_to(CLI::App& verb, std::optional<Mode>& mode, std::initializer_list<Mode> modes,
                 const std::string& description) {
  std::vector<std::string> names;
  for (const Mode one : modes) names.emplace_back(to_string(one));
  verb.add_option_function<std::string>(
          "--mode", [&mode](const std::string& name) { mode = mode_named(name); }, description)
      ->check(one_of(names))
      ->type_name("MODE");
}

void demand_possible_step(double step, double height) {
  if (step <= step_limit(height)) return;
  throw UsageError(fmt::format("--step {:g}", step),
                   fmt::format("a body {:g} m high steps up at most {:g} m; take a smaller step or a higher body",
                               height, step_limit(height)));
}

void add_sphere_to(CLI::App& verb, bool& sphere) {
  verb.add_flag("--sphere", sphere, "A sphere instead of a person")->excludes("--height");
}

void BodyOptions::add_to(CLI::App& verb) {
  // The ranges are those of check(WalkerSettings).
  verb.add_option("--radius", radius, "Radius (default: as trained, or 0.3)")->type_name("R");
  verb.add_option("--height", height, "Whole height (default: as trained, or a person's 1.8, but at least 2 R)")
      ->type_name("H");
  add_sphere_to(verb, sphere);
  verb.add_option("--support-radius", support_radius,
                  "Radius of the support disc, which carries the body over cracks (default: as trained, or none)")
      ->type_name("RS");
  verb.add_option("--eye", eye, "Height of the camera above the body's lowest point (default: 1.6, at most H - R)")
      ->type_name("E");
  verb.add_option("--step", step,
                  "Highest step (stair, kerb) that the body climbs (default: as trained, or 0.3, at most H / 2)")
      ->type_name("M");
  verb.add_option("--slope", slope, "Slope that the body climbs, in degrees (default: as trained, or 45)")
      ->type_name("DEG");
}

WalkerSettings body_of(const BodyOptions& options, const BodySizes& known) {
  const BodySizes body = options.describe_a_body() ? BodySizes{} : known;
  WalkerSettings s;
  s.radius = options.radius.value_or(body.radius.value_or(s.radius));
  s.height = options.height.value_or(body.height.value_or(default_height(s.radius, options.sphere)));
  const auto fitted = [&](double value, double most) { return options.height ? std::min(value, most) : value; };
  s.eye = options.eye.value_or(body.eye ? fitted(*body.eye, s.height) : default_eye(s.radius, s.height));
  const double highest = step_limit(s.height);
  s.step = options.step.value_or(body.step ? fitted(*body.step, highest) : std::min(s.step, highest));
  s.slope_degrees = options.slope.value_or(body.slope.value_or(s.slope_degrees));
  s.support_radius = options.support_radius.value_or(body.support_radius.value_or(s.support_radius));
  return s;
}

}  // namespace roam::app
