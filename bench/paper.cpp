// roam bench paper: the paper's two tables. Each row is a process of its own, so that memory and crashes belong to one
// row.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench_verbs.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/report.h"
#include "cli/values.h"
#include "draw/picture_file.h"
#include "paper_report.h"
#include "paper_scene.h"
#include "roam/error.h"
#include "row_process.h"

namespace roam::bench {
namespace {

using app::Json;

struct Options {
  PaperOptions paper;
  std::vector<std::string> rows;
  std::string picture;
  bool json = false;
};

std::vector<std::string> row_names() {
  std::vector<std::string> names;
  for (const PaperRow& row : paper_rows({})) names.push_back(row.name);
  return names;
}

/// Judges after all rows have ended. The scene is read a second time, never as a whole.
void judge(PaperFindings& findings, const PaperScene& scene) {
  PaperJudge judge;
  for (const RowFindings& row : findings.rows) {
    for (std::size_t i = 0; i < row.result.ways.size(); ++i) judge.watch(findings.ways[i], row.result.ways[i]);
  }
  fmt::print(stderr, "judging\n");
  stream_laid_out(scene, [&](const Mesh& mesh) { judge.add(mesh); });
  const std::vector<Judgement> judgements = judge.judgements();
  auto next = judgements.begin();
  for (RowFindings& row : findings.rows) {
    for (std::size_t i = 0; i < row.result.ways.size(); ++i) row.judged.push_back(*next++);
  }
}

/// The requested rows. Throws if none of them can run.
std::vector<PaperRow> chosen_rows(const Options& options) {
  std::vector<PaperRow> rows = paper_rows(options.paper.wasm);
  const auto& wanted = options.rows;
  std::erase_if(rows, [&](const PaperRow& row) {
    return !wanted.empty() && std::find(wanted.begin(), wanted.end(), row.name) == wanted.end();
  });
  if (std::any_of(rows.begin(), rows.end(), [](const PaperRow& row) { return row.load != nullptr; })) return rows;
  std::string why = "none of the chosen rows can run here";
  for (const PaperRow& row : rows) why += fmt::format("; {}: {}", row.name, row.missing);
  throw Error(why);
}

std::set<Reads> read_by(const std::vector<PaperRow>& rows) {
  std::set<Reads> read;
  for (const PaperRow& row : rows) {
    if (row.load) read.insert(row.reads);
  }
  return read;
}

PaperFindings find(const Options& options, const std::vector<PaperRow>& rows) {
  PaperFindings findings;
  const ScratchFolder scratch(options.paper.scratch);
  const LaidOut laid = lay_out(options.paper, read_by(rows), scratch.path());
  findings.scene = laid.title;
  findings.triangles = laid.triangles;
  findings.prepared = laid.prepared;
  findings.patience = options.paper.patience;
  findings.ways = paper_ways(options.paper.radius, options.paper.split_radius);
  for (const PaperRow& row : rows) {
    RowFindings& found = findings.rows.emplace_back();
    found.row = &row;
    if (!row.load) continue;
    app::stop_if_interrupted();
    fmt::print(stderr, "{}\n", row.title);
    found.result = run_row(row.name, laid.scene, options.paper);
  }
  judge(findings, laid.scene);
  return findings;
}

app::ExitStatus run(const Options& options) {
  const std::vector<PaperRow> rows = chosen_rows(options);
  const std::filesystem::path scene = options.paper.scene;
  if (!options.picture.empty()) app::check_output("--picture", options.picture);
  const app::NamedFile drawn{"--picture", options.picture};
  app::demand_no_overwriting(app::named_scenes({&scene, 1}), {&drawn, 1});
  std::optional<draw::PictureFile> drawing;
  if (!options.picture.empty()) drawing.emplace(options.picture);
  const PaperFindings findings = find(options, rows);
  if (options.json) {
    app::print(paper_json(findings));
  } else {
    app::print(paper_tables(findings));
  }
  if (drawing) drawing->write(paper_chart(findings));
  return paper_status(findings);
}

constexpr const char* help =
    "The scene is written into a scratch folder, in the file formats of the chosen rows: PLY and a store for roam,\n"
    "osgb for OpenSceneGraph, Bullet and PhysX, .mesh for OGRE. Each row is a process of its own. Rows that cannot\n"
    "run here, and rows that exceed a limit, are named. At the end all ways are checked against the scene.\n"
    "docs/paper.md explains the cells and compares them with the printed tables.\n\n"
    "Exit status 3: roam itself was in a wall; 1: also when one of roam's own rows failed.\n\n"
    "Examples:\n"
    "  roam bench paper\n"
    "  roam bench paper --triangles 100M --scratch /big/disk     the paper's 3 GB\n"
    "  roam bench paper --scene your/own/gallery.ive --json\n";

}  // namespace

void add_paper(CLI::App& program, app::Run& run) {
  CLI::App* verb = program.add_subcommand("paper", "Tables 1 and 2 of Xie and Niu (2020), measured here");
  verb->footer(help);
  const auto options = std::make_shared<Options>();
  PaperOptions& paper = options->paper;
  CLI::Option* scene = verb->add_option("--scene", paper.scene,
                                        "A gallery at the coordinates of Table 1 (default: made, see --triangles)")
                           ->type_name("FILE");
  constexpr std::uint64_t least = 50'000;  // smaller galleries have no grotto for the last two ways
  app::add_triangles(*verb, "--triangles", paper.triangles,
                     "Triangles of the made gallery: 2M are the paper's 50 MB, 100M its 3 GB", least)
      ->excludes(scene);
  verb->add_option("--rows", options->rows, "Rows, separated by commas (default: all)")
      ->delimiter(',')
      ->check(app::one_of(row_names()));
  const CLI::Validator free_at_the_start = app::from_to(0.01, 0.9);  // m: the floor is 0.95 m below the paths
  verb->add_option("--radius", paper.radius, "Radius of the sphere, in metres")
      ->capture_default_str()
      ->check(free_at_the_start);
  verb->add_option("--split-radius", paper.split_radius, "Radius of the sphere that crosses the split, in metres")
      ->capture_default_str()
      ->check(free_at_the_start);
  verb->add_option("--patience", paper.patience, "Seconds after which a way is ended")
      ->capture_default_str()
      ->check(app::positive());
  verb->add_option("--loading", paper.loading, "Seconds after which a row that still loads is ended")
      ->capture_default_str()
      ->check(app::positive());
  verb->add_option("--memory", paper.memory,
                   "Memory of a row; one that takes more is ended (default: three quarters of the free memory)")
      ->transform(app::bytes())
      ->check(app::from_to<std::uint64_t>(1u << 20, 1ull << 50))
      ->type_name("BYTES");
  verb->add_option("--wasm-engines", paper.wasm, "Folder with PhysX (npm package physx-js-webidl) in node_modules")
      ->type_name("DIR");
  verb->add_option("--scratch", paper.scratch, "Folder for the scene's files (default: the system's temporary folder)")
      ->type_name("DIR");
  verb->add_option("--picture", options->picture, "Draw the steps' times as bars (.svg or .png)")->type_name("FILE");
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return bench::run(*options); }; });
}

}  // namespace roam::bench
