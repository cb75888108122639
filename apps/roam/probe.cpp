// roam probe: finds whether a body of a given size gets from one position to another.
#include "roam/probe.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "cli/standard_streams.h"
#include "cli/tell.h"
#include "cli/values.h"
#include "draw/picture_file.h"
#include "files/whole_file.h"
#include "measure/along.h"
#include "measure/slope.h"
#include "probe/picture.h"
#include "probe/text.h"
#include "roam/path_file.h"
#include "roam/profile.h"
#include "scenes/body_options.h"
#include "scenes/frame.h"
#include "scenes/recorded_body.h"
#include "scenes/surveyed.h"
#include "text/byte_order_mark.h"
#include "text/stream_of.h"
#include "verbs.h"
#include "words/probe.h"

namespace roam::app {
namespace {

struct ProbeOptions {
  SceneOptions scene;
  ProbeQuestion question;
  std::vector<double> from, to;
  std::optional<Mode> mode;
  std::optional<double> radius, height, step, slope, support_radius, spacing;
  std::optional<std::string> matrix;  ///< sizes, or a file of sizes
  std::optional<std::filesystem::path> picture, path;
  std::optional<double> narrower;  ///< m
  bool sphere = false;
  bool json = false;

  [[nodiscard]] double slope_degrees() const { return slope.value_or(45.0); }
};

/// Maximum length of a file of sizes, in bytes.
constexpr std::uint64_t longest_matrix = 1 << 20;

/// Sizes in lines, with comments behind #.
std::vector<ProbedSize> read_sizes(const std::filesystem::path& file, bool spheres) {
  const std::string text = read_input(file, longest_matrix);
  std::istringstream in = stream_of(std::string(without_byte_order_mark(text)));
  std::vector<ProbedSize> sizes;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto more = parse_sizes(line.substr(0, line.find('#')), fmt::format("{}:{}", file.string(), number), spheres);
    sizes.insert(sizes.end(), more.begin(), more.end());
  }
  return sizes;
}

/// The value of --matrix, as text or in a file. Sizes are sizes even if a file has their name.
std::vector<ProbedSize> sizes_in(const std::string& text, bool spheres) {
  if (is_standard(text)) return read_sizes(text, spheres);
  try {
    return parse_sizes(text, "--matrix", spheres);
  } catch (const UsageError& error) {
    std::error_code none;
    if (std::filesystem::is_directory(text, none))
      throw UsageError(fmt::format("--matrix {}", text), "that is a folder; name a file of sizes, or sizes");
    if (std::filesystem::exists(text, none)) return read_sizes(text, spheres);
    throw UsageError(Error::at(error.where(), fmt::format("{}; and there is no file \"{}\"", error.what(), text)));
  }
}

std::vector<ProbedSize> matrix_sizes(const std::string& text, bool spheres) {
  const std::vector<ProbedSize> sizes = sizes_in(text, spheres);
  const std::string where = text.empty() ? "--matrix \"\"" : "--matrix " + text;
  std::set<std::pair<double, double>> seen;
  for (const ProbedSize& size : sizes) {
    if (!seen.emplace(size.radius, size.height).second) {
      throw UsageError(where, fmt::format("it has the size {:g}x{:g} twice; leave one out", size.radius, size.height));
    }
  }
  if (sizes.empty()) throw UsageError(where, "there are no sizes in it");
  return sizes;
}

std::vector<ProbedSize> sizes_of(const ProbeOptions& o) {
  std::vector<ProbedSize> sizes;
  if (!o.matrix) {
    const double radius = o.radius.value_or(WalkerSettings{}.radius);
    sizes.push_back({radius, o.height.value_or(default_height(radius, o.sphere))});
  } else {
    if (o.radius || o.height) throw UsageError("--matrix", "it says all sizes; leave out --radius and --height");
    if (o.picture || o.path || o.narrower)
      throw UsageError("--matrix", "it has no one way; leave out --picture, --path and --narrower");
    sizes = matrix_sizes(*o.matrix, o.sphere);
  }
  for (const ProbedSize& size : sizes) {
    try {
      if (o.step && size.height > 2.0 * size.radius) demand_possible_step(*o.step, size.height);
      static_cast<void>(probed_body(o.question, size, o.slope_degrees()));
    } catch (const Error& error) {
      if (!o.matrix) throw UsageError(error);
      throw UsageError(fmt::format("--matrix, size {:g}x{:g}", size.radius, size.height), error.what());
    }
  }
  return sizes;
}

/// Memory per position of a search.
constexpr std::uint64_t bytes_a_place = 128;

ProbeQuestion question_of(const ProbeOptions& o) {
  ProbeQuestion q;
  q.mode = o.mode.value_or(Mode::walk);
  const auto place = [](const char* option, const std::vector<double>& value) {
    for (const double v : value) {
      if (!(std::abs(v) <= coordinate_limit))
        throw UsageError(option, fmt::format("{} is no coordinate; it must be within 1e9 m of the origin", v));
    }
    return Vec3(value[0], value[1], value[2]);
  };
  q.from = place("--from", o.from);
  q.to = place("--to", o.to);
  if (q.mode == Mode::fly && !o.sphere) throw UsageError("--mode fly", flight_is_for_spheres);
  if (q.mode == Mode::fly && (o.step || o.slope || o.support_radius))
    throw UsageError("--mode fly", "--step, --slope and --support-radius are for walking; leave them out");
  q.step = o.step.value_or(q.step);
  q.support_radius = o.support_radius.value_or(q.support_radius);
  q.spacing = o.spacing.value_or(q.spacing);
  if (o.scene.memory) q.most_places = std::min(q.most_places, *o.scene.memory / bytes_a_place);
  return q;
}

void write_path(const ProbeOptions& o, const Survey& survey, const ProbeAnswer& answer) {
  std::vector<Vec3> path = probed_path(survey, o.question, answer);
  if (path.size() == 1) path.push_back(path.front());  // the path needs a start and a goal, even if they are equal
  WalkerSettings body = probed_body(o.question, answer.size, o.slope_degrees());
  body.eye = default_eye(body.radius, body.height);
  std::string text = body_line(body, o.question.mode) + "\n";
  if (const auto frame = frame_of(o.scene)) text += frame_line(*frame) + "\n";
  for (const Vec3& p : path) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  if (is_standard(*o.path)) return write_output(text);
  files::write_whole(*o.path, text, files::Naming::exact, paths());
}

/// Measures the way with the body, or with the widest body that passes.
std::vector<words::ProbeDetails::Narrow> narrow_places(const ProbeOptions& o, const Surveyed& scene,
                                                       const ProbeAnswer& answer) {
  ProbeAnswer passing = answer;
  ProbedSize& size = passing.size;
  const bool is_sphere = size.height <= 2.0 * size.radius;
  size.radius = std::min(size.radius, answer.passage.radius);
  if (is_sphere) size.height = 2.0 * size.radius;
  const WalkerSettings settings = probed_body(o.question, size, o.slope_degrees());
  measure::Along along(scene.survey.world(), settings, o.question.mode, *o.narrower);
  along.list_narrower(*o.narrower);
  const std::vector<Vec3> path = probed_path(scene.survey, o.question, passing);
  if (!path.empty()) along.put(path.front());
  for (const Vec3& place : path) along.go(place, settings.body());
  along.finish();
  std::vector<words::ProbeDetails::Narrow> places;
  for (const measure::NarrowPlace& place : along.narrow())
    places.push_back({place, scene.name(place.left_triangle), scene.name(place.right_triangle)});
  return places;
}

/// The names of the objects at both ends of the limit's measured distance.
std::pair<std::string, std::string> names_at(const ProbeOptions& o, const Surveyed& scene, const ProbeAnswer& answer,
                                             const std::optional<ProbeLimit>& limit) {
  using Kind = ProbeLimit::Kind;
  if (limit && limit->kind == Kind::height) {
    const WalkerSettings settings = probed_body(o.question, answer.size, o.slope_degrees());
    const Body low = Body::capsule(settings.radius, std::max(2.0 * settings.radius, limit->size - measure::slimmer));
    const Vec3 centre = limit->feet + Vec3(0.0, 0.0, 0.5 * low.height());
    return {"",
            scene.name(measure::Room(scene.survey.world(), settings, o.question.mode).headroom(low, centre).triangle)};
  }
  if (!limit || limit->kind == Kind::step || limit->kind == Kind::apart) return {};
  return scene.names_at(limit->point, limit->direction, limit->size);
}

/// Between different objects there is a gap, no door.
void tell_gaps(const ProbeOptions& o, const Surveyed& scene, ProbeAnswer& answer) {
  for (std::optional<ProbeLimit>* limit : {&answer.limit, &answer.other}) {
    if (!*limit || !(*limit)->has_head) continue;
    const auto [left, right] = names_at(o, scene, answer, *limit);
    (*limit)->has_head = left == right;
  }
}

/// The ground below the feet. It is an object above the floor if most of its surroundings are lower.
words::Ground ground_at(const Surveyed& scene, const Vec3& feet) {
  constexpr double up = 0.05, below = 2.0;  // m: where the floor is looked for
  constexpr double least = 0.15;            // m: the floor around is at least this much lower
  constexpr int directions = 12;
  const auto floor_at = [&](const Vec3& place) {
    return scene.survey.floor().ray(place + Vec3(0.0, 0.0, up), {0.0, 0.0, -up - below});
  };
  std::vector<double> down;
  for (const double away : {1.5, 2.5}) {
    for (int k = 0; k < directions; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / directions;
      const Impact around = floor_at(feet + away * Vec3(std::cos(angle), std::sin(angle), 0.0));
      if (around.hit) down.push_back(feet.z - around.point.z);
    }
  }
  if (down.size() < directions) return {};
  const auto middle = down.begin() + static_cast<std::ptrdiff_t>(down.size() / 2);
  std::nth_element(down.begin(), middle, down.end());
  if (*middle < least) return {};
  const Impact stand = scene.survey.world().ray(feet + Vec3(0.0, 0.0, up), {0.0, 0.0, -up - least});
  return {stand.hit ? scene.name(stand.triangle) : std::string(), *middle};
}

words::ProbeDetails details_of(const ProbeOptions& o, const Surveyed& scene, const ProbeAnswer& answer) {
  words::ProbeDetails details;
  std::tie(details.left, details.right) = names_at(o, scene, answer, answer.limit);
  std::tie(details.other_left, details.other_right) = names_at(o, scene, answer, answer.other);
  if (o.question.mode == Mode::walk) {
    details.start = ground_at(scene, answer.start);
    details.target = ground_at(scene, answer.target);
  }
  if (!answer.passage.found) return details;
  if (o.question.mode == Mode::walk) details.slope = measure::steepest(answer.passage.way);
  if (!o.narrower) return details;
  details.narrower = *o.narrower;
  details.narrow = narrow_places(o, scene, answer);
  return details;
}

/// `details`: of a single answer.
Json report_of(const ProbeOptions& o, const Surveyed& scene, std::span<const ProbeAnswer> answers,
               const words::ProbeDetails& details) {
  const bool one = !o.matrix;
  Json json = {{"scene", o.scene.names()},
               {"frame", to_json(frame_of(o.scene))},
               {"triangles", scene.survey.triangles()},
               {"mode", to_string(o.question.mode)},
               {"from", to_json(o.question.from)},
               {"to", to_json(o.question.to)},
               {"step", o.question.step},
               {"slope", o.slope_degrees()},
               {"support_radius", o.question.support_radius},
               {"spacing", o.question.spacing}};
  if (one) {
    json.update(json_report(answers.front(), true));
    add_details(json, details);
    json["answer"] = words::report(o.question, answers.front(), details).sentences();
    return json;
  }
  Json sizes = Json::array();
  for (const ProbeAnswer& answer : answers) sizes.push_back(json_report(answer, false));
  json["sizes"] = std::move(sizes);
  return json;
}

/// Prints a note for each low capsule that is searched with a lower step than --step.
void note_low_steps(const ProbeQuestion& question, std::span<const ProbedSize> sizes) {
  constexpr double noted = 1e-3;  // m
  for (const ProbedSize& size : sizes) {
    const double climbs = climbed(question, size);
    if (question.mode == Mode::fly || climbs > std::min(question.step, size.radius) - noted) continue;
    tell(
        fmt::format("note: bodies {:g} m high are searched with steps up to {:.2f} m, their height minus a diameter of "
                    "{:g} m",
                    size.height, climbs, 2.0 * size.radius));
  }
}

ExitStatus probe(ProbeOptions o) {
  take_kept_frame(o.scene);
  o.question = question_of(o);
  const std::vector<ProbedSize> sizes = sizes_of(o);
  if (o.path) demand_one_output("--path", *o.path, o.json);
  if (o.path && !is_standard(*o.path)) check_output("--path", *o.path);
  if (o.picture) check_output("--picture", *o.picture);
  std::vector<NamedFile> inputs = named_scenes(o.scene.scenes);
  inputs.push_back({"the profile", profile_path(o.scene.scenes)});
  const NamedFile outputs[] = {{"--path", o.path.value_or(""), paths()}, {"--picture", o.picture.value_or("")}};
  demand_no_overwriting(inputs, outputs);
  note_low_steps(o.question, sizes);
  std::optional<tbb::global_control> limit;
  if (o.scene.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(o.scene.threads));
  }
  std::optional<draw::PictureFile> drawing;
  if (o.picture) drawing.emplace(*o.picture, draw::PictureFile::Views::in_metres);
  const Surveyed scene = survey_scene(o.scene, o.slope_degrees());
  double smallest = sizes.front().radius;
  for (const ProbedSize& size : sizes) smallest = std::min(smallest, size.radius);
  check_spacing(scene, o.question.spacing, 2.0 * smallest);
  std::vector<ProbeAnswer> answers;
  {
    Progress progress("looking for a way", "places");
    o.question.progress = [&](std::uint64_t places) { return progress.goes_on(places, 0); };
    try {
      answers = roam::probe(scene.survey, o.question, sizes);
    } catch (const NoRoomAtEnd& error) {
      throw Error("--" + std::string(error.where()), error.reason());  // "from" or "to", as the options are named
    }
    o.question.progress = {};
  }
  give_time_to_write(longest_writing);
  for (ProbeAnswer& answer : answers) tell_gaps(o, scene, answer);
  const ProbeAnswer& first = answers.front();
  Unwritten unwritten;
  if (o.path && first.wide_enough) unwritten.attempt([&] { write_path(o, scene.survey, first); });
  if (o.path && !first.wide_enough)
    tell(fmt::format("{}: there is no way, so it was not written{}", o.path->string(), earlier_stays(*o.path)));
  const words::ProbeDetails details = o.matrix ? words::ProbeDetails{} : details_of(o, scene, first);
  print_report(o.json, report_of(o, scene, answers, details),
               (o.matrix ? table(o.question, answers) : words::report(o.question, first, details).text()) +
                   kept_frame_line(o.scene),
               o.path.value_or(""));
  // After the report, so that Ctrl-C during the drawing does not lose it.
  if (drawing) {
    unwritten.attempt(
        [&] { drawing->draw([&] { return sheet_of(o.scene.file_names(), scene.survey, o.question, first); }); });
  }
  unwritten.raise();
  if (interrupted()) return failed;
  const bool all = std::all_of(answers.begin(), answers.end(), [](const ProbeAnswer& a) { return a.passable; });
  return all ? done : answer_no;
}

constexpr const char* probe_help =
    R"(The answer is yes with the way and its narrowest place, or no with the opening that stops the body
and the missing width. The widest way decides. It is certified, and a walker follows it before the answer is yes. Exit
status 0 for yes; 3 for no, and if the walker does not get through; with --matrix, 0 if all sizes get through.

Places are of a person's feet or eyes, and are moved down to the floor; in flight, of the centre. The body steps over
anything lower than --step; a sphere climbs at most its radius, a capsule at most its height minus its diameter. --path
writes the way of the body's centre, with the body, for `roam walk --path FILE --verify`. --matrix takes sizes R or RxH,
separated by commas, or a file of them. R is a person of this radius, as with --radius; with --sphere it is a sphere.
Ways through the air are found for spheres.

Examples:
  roam probe house.glb --from 1,2,1 --to 8,3,1 --radius 0.3 --height 1.9
  roam probe mine.dae --from 5,5,1 --to 90,40,1 --radius 0.4 --height 1.9 --picture door.png
  roam probe pipe.ply --from 0,0,5 --to 9,0,5 --radius 0.5 --sphere --mode fly --json
  roam probe house.glb --from 1,2,1 --to 8,3,1 --matrix 0.25x1.9,0.4x1.9,0.4x1.2
)";

}  // namespace

void add_probe(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("probe", "Find out whether a body of a given size gets from A to B");
  verb->footer(probe_help);
  const auto options = std::make_shared<ProbeOptions>();
  ProbeOptions& o = *options;
  add_surveyed_to(*verb, o.scene);
  verb->option_defaults()->group("Way");
  const auto place = [&](const char* name, std::vector<double>& value, const char* text) {
    add_place(*verb, name, value, text)->required();
  };
  place("--from", o.from, "Start");
  place("--to", o.to, "Target");
  verb->add_option("--spacing", o.spacing,
                   "Metres between tested places (default: 0.2); openings under 0.7 of it may be missed")
      ->check(from_to(0.001, 100.0))
      ->type_name("M");
  verb->option_defaults()->group("Body, in metres");
  verb->add_option("--radius", o.radius, "Radius (default: 0.3)")->check(positive())->type_name("R");
  verb->add_option("--height", o.height, "Whole height (default: a person's 1.8, but at least 2 R)")
      ->check(positive())
      ->type_name("H");
  add_sphere_to(*verb, o.sphere);
  verb->add_option("--matrix", o.matrix, "Several sizes in one run: 0.3,0.4x1.9 or a file of them")->type_name("SIZES");
  add_mode_to(*verb, o.mode, {Mode::walk, Mode::fly}, "walk: on the ground; fly: through the air (default: walk)");
  verb->add_option("--step", o.step, "Highest step (stair, kerb) that the body climbs, at most H / 2 (default: 0.3)")
      ->check(from_to(0.0, 1000.0))
      ->type_name("M");
  verb->add_option("--slope", o.slope, "Slope that the body climbs, in degrees (default: 45)")
      ->check(from_to(0.0, 89.0))
      ->type_name("DEG");
  verb->add_option("--support-radius", o.support_radius,
                   "Radius of the support disc, which carries the body over cracks (default: none)")
      ->check(positive())
      ->type_name("RS");
  verb->option_defaults()->group("Results");
  verb->add_option("--narrower", o.narrower, "List all places of the way that are narrower than W metres")
      ->check(from_to(0.01, 100.0))
      ->type_name("W");
  verb->add_option("--path", o.path, "Write the way as a path file, for `roam walk` (-: standard output)")
      ->type_name("FILE");
  verb->add_option("--picture", o.picture, "Draw the opening that decides (.svg, .png or .dxf)")->type_name("FILE");
  verb->add_flag("--json", o.json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return probe(*options); }; });
}

}  // namespace roam::app
