// roam info: what a scene holds and what its world costs.
#include <fmt/format.h>

#include "cli/progress.h"
#include "cli/report.h"
#include "cli/tell.h"
#include "roam/profile.h"
#include "roam/store.h"
#include "scenes/scene_options.h"
#include "verbs.h"

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

Json json_report(const SceneOptions& options, const LoadedScene& scene) {
  const WorldStats& stats = scene.world.stats();
  return {{"scene", options.names()},
          {"format", "scene"},
          {"triangles", stats.triangles},
          {"objects", stats.objects},
          {"bounds", to_json(scene.bounds)},
          {"tiles", stats.tiles},
          {"bytes", stats.bytes},
          {"bytes_per_triangle", static_cast<double>(stats.bytes) / static_cast<double>(stats.triangles)},
          {"largest_error_m", stats.largest_error_m},
          {"hash", identity_of(scene.meshes).hash},
          {"read_s", scene.read_seconds},
          {"build_s", scene.build_seconds},
          {"import", import_report(scene.report)}};
}

std::string text_report(const SceneOptions& options, const LoadedScene& scene) {
  const WorldStats& stats = scene.world.stats();
  const Vec3 size = scene.bounds.size();
  const auto& [low, high] = scene.bounds;
  std::string text = printable_part(options.names()) + "\n";
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<16}{}\n", what, value);
  };
  line("triangles", fmt::format("{} in {} objects, from {} files", stats.triangles, stats.objects, scene.report.files));
  line("size", fmt::format("{:.3f} x {:.3f} x {:.3f} m", size.x, size.y, size.z));
  line("from", fmt::format("{:.3f} {:.3f} {:.3f}", low.x, low.y, low.z));
  line("to", fmt::format("{:.3f} {:.3f} {:.3f}", high.x, high.y, high.z));
  line("index",
       fmt::format("{} tiles, {}B, {:.1f} bytes a triangle", stats.tiles, short_count(static_cast<double>(stats.bytes)),
                   static_cast<double>(stats.bytes) / static_cast<double>(stats.triangles)));
  line("largest error", fmt::format("{:.3g} m between a vertex and its place in the index", stats.largest_error_m));
  line("time",
       fmt::format("read in {}, indexed in {}", short_time(scene.read_seconds), short_time(scene.build_seconds)));
  line("hash", identity_of(scene.meshes).hash);
  return text;
}

Json json_report(const Store& store) {
  const StoreInfo& i = store.info();
  const auto triangles = static_cast<double>(i.triangles);
  return {{"scene", store.name()},
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
          {"largest_error_m", i.largest_error_m},
          {"lossless", i.lossless},
          {"hash", i.hash},
          {"geometry_hash", i.geometry_hash}};
}

std::string text_report(const Store& store) {
  const StoreInfo& i = store.info();
  const auto triangles = static_cast<double>(i.triangles);
  const Vec3 size = i.bounds.size();
  const auto& [low, high] = i.bounds;
  std::string text = printable_part(store.name()) + "\n";
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<16}{}\n", what, value);
  };
  line("store", fmt::format("format {}, {} tiles on {} pages in {} packs", i.format, i.tiles, i.pages, i.packs));
  line("triangles", fmt::format("{} in {} objects", i.triangles, i.objects));
  line("size", fmt::format("{:.3f} x {:.3f} x {:.3f} m", size.x, size.y, size.z));
  line("from", fmt::format("{:.3f} {:.3f} {:.3f}", low.x, low.y, low.z));
  line("to", fmt::format("{:.3f} {:.3f} {:.3f}", high.x, high.y, high.z));
  line("on disk",
       fmt::format("{}B, {:.2f} bytes a triangle: {:.2f} of geometry, {:.2f} of source numbers",
                   short_count(static_cast<double>(i.bytes)), static_cast<double>(i.bytes) / triangles,
                   static_cast<double>(i.geometry_bytes) / triangles, static_cast<double>(i.number_bytes) / triangles));
  line("in memory", fmt::format("{:.1f} bytes a triangle, of those that are resident",
                                static_cast<double>(i.resident_bytes) / triangles));
  line("largest error", fmt::format("{:.3g} m between a vertex and its place in the store", i.largest_error_m));
  line("hash", i.hash);
  return text;
}

ExitStatus store_info(const SceneOptions& options, bool json) {
  if (options.scenes.size() > 1 || options.says_how_to_read()) {
    throw UsageError("a store is a scene of its own, and was read when it was built: name it alone");
  }
  const auto store = Store::open(options.scenes.front());
  if (json) {
    print(json_report(*store));
  } else {
    print(text_report(*store));
  }
  return done;
}

ExitStatus info(const SceneOptions& options, bool json) {
  for (const auto& scene : options.scenes) {
    if (Store::is_store(scene)) return store_info(options, json);
  }
  const LoadedScene scene = load(options, Source::keep);
  if (json) {
    print(json_report(options, scene));
  } else {
    print(text_report(options, scene));
  }
  return done;
}

constexpr const char* help =
    R"(The report has the scene's triangles, objects and box; what was left out, and why; the memory of the
index, and how far it moves a vertex at most. The hash is of the triangles: two files of any formats share it if their
triangles are the same to the last digit, in the same order.

Examples:
  roam info mine.dae
  roam info Terrain/ plant.glb --json
  roam info house.obj --up y --unit mm --ignore 'Door*'
)";

}  // namespace

void add_info(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("info", "Report what a scene holds and how much memory its index takes");
  verb->footer(help);
  struct Options {
    SceneOptions scene;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  options->scene.add_to(*verb);
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return info(options->scene, options->json); }; });
}

}  // namespace roam::app
