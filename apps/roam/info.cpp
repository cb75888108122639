// roam info: shows the contents of a scene and the memory of its world.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "cli/progress.h"
#include "cli/report.h"
#include "cli/standard_streams.h"
#include "cli/tell.h"
#include "measure/edges.h"
#include "roam/profile.h"
#include "roam/store.h"
#include "scenes/frame.h"
#include "scenes/scene_options.h"
#include "scenes/web_options.h"
#include "store/tile_reader.h"
#include "verbs.h"
#include "words/lines.h"
#include "words/measures.h"

namespace roam::app {
namespace {

Json left_out(const std::vector<LeftOutObject>& objects) {
  Json list = Json::array();
  for (const LeftOutObject& object : objects) {
    list.push_back({{"name", object.name}, {"vertices", object.vertices}, {"triangles", object.triangles}});
  }
  return list;
}

Json import_report(const ImportReport& report) {
  Json json = {{"files", report.files},
               {"vertices", report.vertices},
               {"bad_vertices", report.bad_vertices},
               {"bad_triangles", report.bad_triangles},
               {"ignored_triangles", report.ignored_triangles},
               {"missing_pages", report.missing_pages},
               {"bad_objects", left_out(report.bad_objects)},
               {"ignored_objects", left_out(report.ignored_objects)},
               {"missing_page_files", report.missing_page_files},
               {"outside_references", report.outside_references},
               {"outside_files", report.outside_files},
               {"reader", nullptr},
               {"georeference", nullptr},
               {"notes", report.notes}};
  if (const auto& walls = report.confinement) {
    json["reader"] = {{"landlock", walls->landlock},
                      {"seccomp", walls->system_calls},
                      {"no_new_privs", walls->no_new_privileges},
                      {"limits", walls->limits},
                      {"empty_folder", walls->empty_folder}};
  }
  if (report.georeference) {
    json["georeference"] = {{"srs", report.georeference->srs}, {"origin", to_json(report.georeference->origin)}};
  }
  return json;
}

Json json_report(const SceneOptions& options, const LoadedScene& scene, const measure::Edges& edges) {
  const WorldStats& stats = scene.world.stats();
  return {{"scene", options.names()},
          {"frame", to_json(frame_of(options))},
          {"likely_up", scene.likely_up ? Json(to_string(*scene.likely_up)) : Json(nullptr)},
          {"format", "scene"},
          {"triangles", stats.triangles},
          {"objects", stats.objects},
          {"bounds", to_json(scene.bounds)},
          {"tiles", stats.tiles},
          {"bytes", stats.bytes},
          {"bytes_per_triangle", static_cast<double>(stats.bytes) / static_cast<double>(stats.triangles)},
          {"largest_error_m", stats.largest_error},
          {"hash", scene.identity.hash},
          {"read_s", scene.read_seconds},
          {"build_s", scene.build_seconds},
          {"edges", {{"all", edges.all}, {"open", edges.open}, {"hole", edges.hole ? to_json(*edges.hole) : nullptr}}},
          {"import", import_report(scene.report)}};
}

/// "47.9 x 102.3 x 12.0 m, 499,936 triangles in 1 object".
std::string size_words(const Box& bounds, std::uint64_t triangles, std::uint64_t objects) {
  const Vec3 size = bounds.size();
  return fmt::format("{:.2f} x {:.2f} x {:.2f} m, {} in {}", size.x, size.y, size.z,
                     words::counted(triangles, "triangle"), words::counted(objects, "object"));
}

std::string up_words(const SceneOptions& options) {
  const std::optional<SceneFrame> frame = frame_of(options);
  if (!frame) return "y of glTF files, z of the others (--up says another)";
  const std::string axis = fmt::format("{} of the file", to_string(frame->up));
  if (!options.frame_file.empty()) return axis + ", as " + printable_part(options.frame_file.string()) + " says";
  if (!options.up.empty()) return axis + ", as --up says";
  return axis + (frame->up == UpAxis::y ? ", as in all glTF" : " (--up says another)");
}

std::string unit_words(const SceneOptions& options) {
  if (options.unit.empty()) return "metre (--unit says another)";
  return options.unit + (options.frame_file.empty() ? ", as --unit says" : ", as the same file says");
}

std::string closed_words(const measure::Edges& edges) {
  if (edges.open == 0) return "yes: every edge joins two triangles or more";
  return fmt::format("no: {} of {} edges belong to one triangle only, e.g. at {}", words::grouped(edges.open),
                     words::grouped(edges.all), words::at(*edges.hole));
}

std::string left_out_words(const ImportReport& report) {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", words::grouped(count), what);
  };
  add(report.bad_triangles, "bad triangles");
  add(report.ignored_triangles, "triangles by --ignore");
  add(report.missing_pages, "files that are missing or unreadable");
  add(report.outside_references, "references to files outside of the scene's folder (--allow)");
  return text.empty() ? "nothing" : text;
}

std::string text_report(const SceneOptions& options, const LoadedScene& scene, const measure::Edges& edges) {
  const WorldStats& stats = scene.world.stats();
  words::Lines lines(printable_part(options.names()) + ": " + size_words(scene.bounds, stats.triangles, stats.objects));
  lines.add("from", words::exactly_at(scene.bounds.lower));
  lines.add("to", words::exactly_at(scene.bounds.upper));
  lines.add("up", up_words(options));
  lines.add("unit", unit_words(options));
  lines.add("closed", closed_words(edges));
  lines.add("left out", left_out_words(scene.report));
  std::error_code none;
  if (const auto profile = profile_path(options.scenes);
      std::filesystem::exists(std::filesystem::symlink_status(profile, none)))
    lines.add("trained", printable_part(profile.string()));
  return lines.text();
}

std::string stats_report(const LoadedScene& scene) {
  const WorldStats& stats = scene.world.stats();
  std::string text;
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<16}{}\n", what, value);
  };
  line("files", fmt::format("{}", scene.report.files));
  line("index",
       fmt::format("{} tiles, {}B, {:.1f} bytes a triangle", stats.tiles, short_count(static_cast<double>(stats.bytes)),
                   static_cast<double>(stats.bytes) / static_cast<double>(stats.triangles)));
  line("largest error", fmt::format("{:.3g} m between a vertex and its place in the index", stats.largest_error));
  line("time",
       fmt::format("read in {}, indexed in {}", short_time(scene.read_seconds), short_time(scene.build_seconds)));
  line("hash", scene.identity.hash);
  return text;
}

Json json_report(const Store& store) {
  const StoreInfo& i = store.info();
  const auto triangles = static_cast<double>(i.triangles);
  return {{"scene", store.name()},
          {"frame", to_json(frame_of(store))},
          {"format", fmt::format("store {}", i.format)},
          {"triangles", i.triangles},
          {"objects", i.objects},
          {"bounds", to_json(i.bounds)},
          {"tiles", i.tiles},
          {"pages", i.pages},
          {"packs", i.packs},
          {"bytes", i.bytes},
          {"bytes_per_triangle", static_cast<double>(i.bytes) / triangles},
          {"geometry_bytes_per_triangle", static_cast<double>(i.geometry_bytes) / triangles},
          {"number_bytes_per_triangle", static_cast<double>(i.number_bytes) / triangles},
          {"resident_bytes_per_triangle", static_cast<double>(i.resident_bytes) / triangles},
          {"largest_error_m", i.largest_error},
          {"lossless", i.lossless},
          {"hash", i.hash},
          {"geometry_hash", i.geometry_hash}};
}

/// The reason why the first page of a store on a web server cannot be read; empty if there is none.
std::string reading_problem(const Store& store) {
  if (!Store::is_address(store.name()) || store.state().pages.empty()) return {};
  try {
    (void)store::TileReader(store.state()).page(0);
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

std::string text_report(const Store& store, const std::string& problem) {
  const StoreInfo& i = store.info();
  words::Lines lines(printable_part(store.name()) + ": a store, " + size_words(i.bounds, i.triangles, i.objects));
  lines.add("from", words::exactly_at(i.bounds.lower));
  lines.add("to", words::exactly_at(i.bounds.upper));
  lines.add("on disk", short_count(static_cast<double>(i.bytes)) + "B");
  if (!problem.empty()) lines.add("not read", printable_part(problem));
  return lines.text();
}

std::string stats_report(const Store& store) {
  const StoreInfo& i = store.info();
  const auto triangles = static_cast<double>(i.triangles);
  std::string text;
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<16}{}\n", what, value);
  };
  line("store", fmt::format("format {}, {} on {} in {}", i.format, words::counted(i.tiles, "tile"),
                            words::counted(i.pages, "page"), words::counted(i.packs, "pack")));
  line("on disk",
       fmt::format("{:.2f} bytes a triangle: {:.2f} of geometry, {:.2f} of source numbers",
                   static_cast<double>(i.bytes) / triangles, static_cast<double>(i.geometry_bytes) / triangles,
                   static_cast<double>(i.number_bytes) / triangles));
  line("in memory", fmt::format("{:.1f} bytes a triangle, of those that are resident",
                                static_cast<double>(i.resident_bytes) / triangles));
  line("largest error", fmt::format("{:.3g} m between a vertex and its place in the store", i.largest_error));
  line("hash", i.hash);
  return text;
}

ExitStatus store_info(const SceneOptions& options, bool json, bool stats) {
  options.demand_store_alone();
  const auto store = Store::open(options.scenes.front(), options.manifest_memory(), options.web);
  const std::string problem = reading_problem(*store);
  Json report = json_report(*store);
  if (!problem.empty()) report["not_read"] = problem;
  print_report(json, report, text_report(*store, problem) + (stats ? stats_report(*store) : ""));
  return problem.empty() ? done : failed;
}

ExitStatus info(SceneOptions options, bool json, bool stats) {
  for (const auto& scene : options.scenes) {
    if (Store::is_store(scene)) return store_info(options, json, stats);
  }
  take_kept_frame(options);
  options.identify = true;
  const LoadedScene scene = load(options, Source::keep);
  const measure::Edges edges = measure::count_edges(scene.meshes);
  print_report(json, json_report(options, scene, edges),
               text_report(options, scene, edges) + (stats ? stats_report(scene) : ""));
  return done;
}

constexpr const char* info_help =
    R"(The report has the scene's triangles, objects and box, and the parts left out. --stats adds the memory of
the index, the largest movement of a vertex in it, and the hash of the triangles: two files of any formats share it if
their triangles are the same to the last digit, in the same order.

Examples:
  roam info mine.dae
  roam info Terrain/ plant.glb --json
  roam info house.obj --up y --unit mm --ignore 'Door*'
)";

}  // namespace

void add_info(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("info", "Report the contents of a scene");
  verb->footer(info_help);
  struct Options {
    SceneOptions scene;
    bool json = false, stats = false;
  };
  const auto options = std::make_shared<Options>();
  options->scene.add_to(*verb);
  add_web_options(*verb, *verb->get_option("SCENE"), options->scene.web);
  verb->add_flag("--stats", options->stats,
                 "Also print the index's memory, the times and the triangles' fingerprint (hash)");
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return info(options->scene, options->json, options->stats); }; });
}

}  // namespace roam::app
