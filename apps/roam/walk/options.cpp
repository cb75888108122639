#include "walk/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "check/check.h"
#include "cli/exit_status.h"
#include "cli/output_file.h"
#include "cli/standard_streams.h"
#include "cli/trace_file.h"
#include "cli/values.h"
#include "measure/room.h"
#include "roam/error.h"
#include "roam/profile.h"
#include "roam/wander.h"
#include "scenes/web_options.h"
#include "walk/certificate.h"

namespace roam::app {

void take_profile(WalkOptions& options) {
  if (options.scene.no_profile || options.body.describe_a_body()) return;
  options.profile = find_scene_profile(options.scene, options.walker_mode(), options.recorded);
  options.scene.identify = options.profile.has_value();
}

WalkerSettings walker_settings(const WalkOptions& options) {
  BodySizes known;
  if (options.recorded) {
    known = sizes_of(*options.recorded);
  } else if (options.profile) {
    known = sizes_of(options.profile->profile);
  }
  WalkerSettings settings = body_of(options.body, known);
  settings.speed = options.route.speed;
  try {
    check(settings);
  } catch (const Error& error) {
    throw UsageError(error);
  }
  return settings;
}

double path_length(std::span<const Vec3> points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += glm::distance(points[i - 1], points[i]);
  return sum;
}

double reach_of_steps(const WalkOptions& options, const Space& space) {
  constexpr double ahead = 0.5;  // s
  const WalkerSettings& body = options.settings;
  const measure::Room room(space, body, options.walker_mode());
  return std::max({options.route.speed * std::max(ahead, 2.0 * options.route.dt), body.radius + room.reach(),
                   (1.0 + measure::height_reach) * body.height, options.wander ? Wander::look_around : 0.0});
}

void check_way(const WalkOptions& options) {
  if (options.path.empty() && !options.wander)
    throw UsageError("walk", "where to? Give it a --path FILE, or --wander S for S seconds");
}

void check_outputs(const WalkOptions& options) {
  demand_one_output("--trace", options.trace, options.json);
  std::vector<NamedFile> inputs = named_scenes(options.scene.scenes);
  for (const NamedFile& scene : named_scenes(options.against.scenes)) inputs.push_back(scene);
  inputs.push_back({"the path", options.path});
  inputs.push_back({"the profile", profile_path(options.scene.scenes)});
  const NamedFile outputs[] = {{"--trace", options.trace, traces()},
                               {"--picture", options.picture},
                               {"--certify", options.certify, certificates()}};
  demand_no_overwriting(inputs, outputs);
  if (!options.trace.empty() && !is_standard(options.trace)) check_output("--trace", options.trace);
  if (!options.picture.empty()) check_output("--picture", options.picture);
  if (options.certify.empty()) return;
  check_output("--certify", options.certify);
  if (options.scene.name_a_store() && options.against.scenes.empty()) {
    throw UsageError("--certify", "a store keeps triangles to within 2 mm only; name its scene by --against, too");
  }
}

void WalkOptions::add_to(CLI::App& verb) {
  scene.add_to(verb);
  add_web_options(verb, *verb.get_option("SCENE"), scene.web);
  verb.option_defaults()->group("Way");
  auto* way =
      verb.add_option("--path", path, "Follow the waypoints of this file (-: standard input)")->type_name("FILE");
  auto* wandering = verb.add_option("--wander", wander, "Instead of --path: explore for S seconds")
                        ->excludes(way)
                        ->check(positive())
                        ->type_name("S");
  add_place(verb, "--from", from, "With --wander: start here (default: a roomy place within walls)")->needs(wandering);
  verb.add_option("--speed", route.speed, "Metres per second (default: 1.4)")->check(positive())->type_name("V");
  verb.add_option("--dt", route.dt, "Length of one time step, in seconds, at least 1e-6 (default: 1/60)")
      ->check(positive())
      ->type_name("S");
  verb.option_defaults()->group("Body, in metres");
  add_mode_to(verb, mode, {Mode::fly, Mode::walk, Mode::ghost},
              "walk: on the ground; fly: without gravity; ghost: through walls (default: walk)");
  body.add_to(verb);
  verb.option_defaults()->group("Results");
  verb.add_option("--trace", trace, "Write every step to this CSV file (-: standard output)")->type_name("FILE");
  verb.add_option("--picture", picture, "Draw plan and section of the way (.svg, .png or .dxf)")->type_name("FILE");
  verb.add_option("--certify", certify, "Write a certificate of every move, which `roam check` can check, to this file")
      ->type_name("FILE");
  verb.add_flag("--verify", verify, "Check every move against all triangles, in higher precision, without the index");
  verb.add_option("--against", against.scenes,
                  "For a store: check every move against the triangles of the scene that it was made of")
      ->type_name("SCENE");
  verb.add_flag("--stats", stats, "Print times of a step, certified clearances and counts, too");
  verb.add_flag("--json", json, "Print one JSON object");
}

}  // namespace roam::app
