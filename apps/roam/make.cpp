// roam make: makes demo scenes of a given size.
#include <fmt/format.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "cli/output_file.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/tell.h"
#include "cli/values.h"
#include "files/whole_file.h"
#include "generate/write.h"
#include "roam/error.h"
#include "roam/generate.h"
#include "verbs.h"
#include "words/measures.h"

namespace roam::app {
namespace {

namespace fs = std::filesystem;

struct MakeOptions {
  fs::path output;
  std::uint64_t triangles = 0;
  std::uint64_t seed = 1;
  std::vector<double> origin{0.0, 0.0, 0.0};
  double size = generate::TerrainOptions{}.size;
  bool json = false;

  [[nodiscard]] Vec3 origin_point() const { return {origin[0], origin[1], origin[2]}; }
};

/// A path of Table 1 beside the gallery: gallery-straight.path and so on for gallery.ply.
struct GalleryPath {
  fs::path file;
  std::string text;

  /// A person names no path, so each replaces only its equal or an empty file.
  [[nodiscard]] FileKind equal() const {
    FileKind kind = beginning_with(text, "path of Table 1 from this --origin");
    kind.has = [begins = kind.has, most = static_cast<off_t>(text.size())](int there) {
      struct stat status {};
      return begins(there) && ::fstat(there, &status) == 0 && status.st_size <= most;
    };
    return kind;
  }
};

std::vector<GalleryPath> gallery_paths(const MakeOptions& options) {
  std::vector<GalleryPath> all;
  for (const generate::Path& path : generate::gallery_paths) {
    fs::path file = options.output;
    file.replace_filename(options.output.stem().string() + "-" + path.name + ".path");
    const Vec3 from = path.from + options.origin_point(), to = path.to + options.origin_point();
    all.push_back(
        {std::move(file), fmt::format("# Path {} of Table 1 in Xie and Niu (2020), doi:10.1371/journal.pone.0229038\n"
                                      "{} {} {}\n{} {} {}\n",
                                      all.size() + 1, from.x, from.y, from.z, to.x, to.y, to.z)});
  }
  return all;
}

std::vector<std::string> write(std::span<const GalleryPath> paths) {
  std::vector<std::string> written;
  for (const GalleryPath& path : paths) {
    files::write_whole(path.file, path.text, files::Naming::beside, path.equal());
    written.push_back(path.file.string());
  }
  return written;
}

/// The paths replace no link, either: a stranger may have made it.
void demand_no_overwriting(const MakeOptions& options, std::span<const GalleryPath> paths) {
  std::vector<NamedFile> outputs{{"-o", options.output, marked("mesh")}};
  for (const GalleryPath& path : paths) {
    const std::string name = fmt::format("-o {}, its path", options.output.string());
    std::error_code none;
    if (fs::is_symlink(fs::symlink_status(path.file, none)))
      throw UsageError(fmt::format("{} {}", name, path.file.string()),
                       "that is a link; name another file, or move it away");
    outputs.push_back({name, path.file, path.equal()});
  }
  app::demand_no_overwriting({}, outputs);
}

ExitStatus make(const MakeOptions& options, const generate::Scene& scene, bool gallery) {
  const std::vector<GalleryPath> beside = gallery ? gallery_paths(options) : std::vector<GalleryPath>();
  demand_no_overwriting(options, beside);
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress("making " + options.output.string(), "triangles");
    generate::write_scene(scene, options.output, marked("mesh"),
                          [&](std::uint64_t made) { return progress.goes_on(made, scene.triangles()); });
  }
  const std::vector<std::string> paths = write(beside);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::uint64_t bytes = fs::file_size(options.output);
  if (options.json) {
    print(Json{{"file", options.output.string()},
               {"triangles", scene.triangles()},
               {"vertices", scene.vertices()},
               {"objects", scene.objects()},
               {"bytes", bytes},
               {"seed", options.seed},
               {"paths", paths},
               {"seconds", seconds}});
    return done;
  }
  std::string text = fmt::format("{}: {} triangles in {}, {}B, made in {}\n", printable_part(options.output.string()),
                                 scene.triangles(), words::counted(scene.objects(), "object"),
                                 short_count(static_cast<double>(bytes)), short_time(seconds));
  for (const std::string& path : paths) text += printable_part(path) + "\n";
  print(text);
  return done;
}

using Maker = std::function<generate::Scene(const MakeOptions&)>;

/// Adds the common options of all kinds of scene.
void add_kind(CLI::App& verb, const std::shared_ptr<MakeOptions>& options, std::uint64_t triangles, bool gallery,
              const Maker& maker, Run& run) {
  options->triangles = triangles;
  verb.option_defaults()->group("Options");
  verb.add_option("-o,--output", options->output, "File to write: .ply, .obj or .stl")->required()->type_name("FILE");
  verb.add_option("--triangles", options->triangles,
                  fmt::format("About how many, e.g. 500k or 20M (default: {})", short_count(double(triangles))))
      ->transform(counted())
      ->type_name("N");
  verb.add_option("--seed", options->seed, "Seed: the same seed gives the same bits (default: 1)")
      ->check(seed())
      ->type_name("S");
  add_place(verb, "--origin", options->origin, "Added to all coordinates, in metres (default: 0,0,0)");
  verb.add_flag("--json", options->json, "Print one JSON object");
  verb.callback([options, maker, gallery, &run] {
    run = [options, maker, gallery] {
      if (!generate::has_scene_extension(options->output))
        throw UsageError("-o " + options->output.string(), "name a file that ends in .ply, .obj or .stl");
      const generate::Scene scene = [&] {
        try {
          return maker(*options);
        } catch (const Error& error) {
          throw UsageError(error);
        }
      }();
      return make(*options, scene, gallery);
    };
  });
}

constexpr const char* gallery_help =
    R"(The gallery has the coordinates of Table 1 in Xie and Niu (2020). The paths of that
table are written beside it: -o gallery.ply also writes gallery-straight.path, gallery-corner.path and
gallery-split.path.

Examples:
  roam make gallery -o gallery.ply
  roam make gallery -o big.ply --triangles 20M --seed 7
)";
constexpr const char* terrain_help = R"(The ground has ridges, valleys and scarps.

Examples:
  roam make terrain -o terrain.ply --triangles 2M
  roam make terrain -o far.ply --size 10000 --origin 4000000,500000,0
)";
constexpr const char* city_help = R"(Buildings have doors, rooms, passages, bays and bridges; streets have kerbs.

Examples:
  roam make city -o city.ply
  roam make city -o city.obj --triangles 100k
)";

}  // namespace

void add_make(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("make", "Make a demo scene of any size: gallery, terrain or city");
  verb->require_subcommand(1);
  verb->footer("Examples:\n  roam make gallery -o gallery.ply\n  roam make city -o city.ply --triangles 5M\n");

  CLI::App* gallery = verb->add_subcommand("gallery", "The paper's dam gallery, with its three paths");
  gallery->footer(gallery_help);
  add_kind(
      *gallery, std::make_shared<MakeOptions>(), generate::GalleryOptions{}.triangles, true,
      [](const MakeOptions& o) {
        return generate::gallery({.triangles = o.triangles, .seed = o.seed, .origin = o.origin_point()});
      },
      run);

  CLI::App* terrain = verb->add_subcommand("terrain", "A square of rough ground");
  terrain->footer(terrain_help);
  const auto terrain_options = std::make_shared<MakeOptions>();
  add_kind(
      *terrain, terrain_options, generate::TerrainOptions{}.triangles, false,
      [](const MakeOptions& o) {
        return generate::terrain(
            {.triangles = o.triangles, .seed = o.seed, .origin = o.origin_point(), .size = o.size});
      },
      run);
  terrain->add_option("--size", terrain_options->size, "Side of the square in metres (default: 700)")->type_name("M");

  CLI::App* city = verb->add_subcommand("city", "Streets and buildings");
  city->footer(city_help);
  add_kind(
      *city, std::make_shared<MakeOptions>(), generate::CityOptions{}.triangles, false,
      [](const MakeOptions& o) {
        return generate::city({.triangles = o.triangles, .seed = o.seed, .origin = o.origin_point()});
      },
      run);
}

}  // namespace roam::app
