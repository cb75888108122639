// roam info: what a scene holds and what its world costs.
#include <fmt/format.h>

#include "progress.h"
#include "report.h"
#include "scene_hash.h"
#include "scene_options.h"
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
               {"georeference", nullptr},
               {"notes", report.notes}};
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
          {"hash", scene_hash(scene.meshes)},
          {"read_s", scene.read_seconds},
          {"build_s", scene.build_seconds},
          {"import", import_report(scene.report)}};
}

std::string text_report(const SceneOptions& options, const LoadedScene& scene) {
  const WorldStats& stats = scene.world.stats();
  const Vec3 size = scene.bounds.size();
  const auto& [low, high] = scene.bounds;
  std::string text = fmt::format("{}\n", options.names());
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
  line("hash", scene_hash(scene.meshes));
  return text;
}

ExitStatus info(const SceneOptions& options, bool json) {
  const LoadedScene scene = load(options, Source::keep);
  if (json) {
    print(json_report(options, scene));
  } else {
    print(text_report(options, scene));
  }
  return done;
}

constexpr const char* help =
    "Reads a scene and says what is in it: triangles, objects and box; what was left out on reading, and why; what\n"
    "the index of it costs and by how much the index moved a vertex at most; and a hash of the triangles, which two\n"
    "files share, whatever their format, when their triangles are the same to the last digit and in the same order.\n\n"
    "Examples:\n"
    "  roam info mine.dae\n"
    "  roam info Terrain/ plant.glb --json\n"
    "  roam info house.obj --up y --unit mm --ignore 'Door*'\n";

}  // namespace

void add_info(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("info", "Says what a scene holds and what its index costs");
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
