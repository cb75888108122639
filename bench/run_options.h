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
  std::vector<SceneChoice> scenes;  ///< parsed
  std::vector<std::string> sets = query_set_names();
  std::size_t queries = 100000;
  int rounds = 5;

  /// `more_sets` are chosen too, after the sweeps.
  void add_to(CLI::App& app, const std::vector<std::string>& more_sets = {}) {
    sets.insert(sets.end(), more_sets.begin(), more_sets.end());
    app.add_option("--scene", names_, "gallery, terrain, city, with a number of triangles as in gallery:5M, or a file")
        ->allow_extra_args(false)
        ->capture_default_str();
    app::add_triangles(app, "--triangles", triangles_, "triangles of made scenes without a number");
    app.add_option("--origin", origin_, "new position of the scene's centre, metres: x,y,z")
        ->delimiter(',')
        ->expected(3)
        ->check(app::from_to(-generate::origin_limit, generate::origin_limit))
        ->capture_default_str();
    app.add_option("--sets", sets, "query sets, separated by commas (default: all)")
        ->delimiter(',')
        ->check(app::one_of(sets));
    app.add_option("--queries", queries, "queries of each set")->capture_default_str()->check(app::at_least_one());
    app.add_option("--rounds", rounds, "each query's time is the median over these")
        ->capture_default_str()
        ->check(app::at_least_one());
    app.parse_complete_callback([this] {
      for (const std::string& name : names_) {
        scenes.push_back(choice(name));
        scenes.back().origin = {origin_[0], origin_[1], origin_[2]};
      }
    });
  }

  [[nodiscard]] const std::vector<std::string>& scene_names() const { return names_; }

 private:
  [[nodiscard]] SceneChoice choice(const std::string& name) const {
    SceneChoice chosen{.scene = name, .triangles = triangles_};
    const std::size_t colon = name.find(':');
    if (colon == std::string::npos || !is_made(name.substr(0, colon))) return chosen;
    chosen.scene = name.substr(0, colon);
    std::string number = name.substr(colon + 1);
    for (const CLI::Validator& rule :
         {app::counted(), app::from_to<std::uint64_t>(generate::least_triangles, generate::most_triangles)}) {
      const std::string wrong = rule(number);
      if (!wrong.empty()) throw CLI::ValidationError("--scene", wrong);
    }
    chosen.triangles = std::stoull(number);
    return chosen;
  }

  std::vector<std::string> names_{"gallery"};
  std::uint64_t triangles_ = SceneChoice{}.triangles;
  std::vector<double> origin_{0.0, 0.0, 0.0};
};

}  // namespace roam::bench
