#pragma once
/// \file
/// The options that both programs share.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/values.h"
#include "query_sets.h"
#include "scene.h"

namespace roam::bench {

struct RunOptions {
  SceneChoice scene;
  std::vector<std::string> sets = query_set_names();
  std::size_t queries = 100000;
  int rounds = 5;

  void add_to(CLI::App& app) {
    app.add_option("--scene", scene.scene, "gallery, terrain, city, or a file")->capture_default_str();
    app::add_triangles(app, "--triangles", scene.triangles, "triangles of a made scene");
    app.add_option("--origin", origin_, "new position of the scene's centre, metres: x,y,z")
        ->delimiter(',')
        ->expected(3)
        ->check(app::from_to(-generate::origin_limit, generate::origin_limit))
        ->capture_default_str();
    app.add_option("--sets", sets, "query sets, separated by commas (default: all)")
        ->delimiter(',')
        ->check(app::one_of(query_set_names()));
    app.add_option("--queries", queries, "queries of each set")->capture_default_str()->check(app::at_least_one());
    app.add_option("--rounds", rounds, "each query's time is the median over these")
        ->capture_default_str()
        ->check(app::at_least_one());
    app.parse_complete_callback([this] { scene.origin = {origin_[0], origin_[1], origin_[2]}; });
  }

 private:
  std::vector<double> origin_{0.0, 0.0, 0.0};
};

}  // namespace roam::bench
