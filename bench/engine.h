#pragma once
/// \file
/// What the benchmarks ask of an engine, and the engines there are.
///
/// Each engine gets the whole scene as one static world and is used in the way that is fastest for these queries; its
/// file says how. Engines that compute in floats get the coordinates rounded to floats: the benchmark puts the scene's
/// centre at (0, 0, 0) unless told otherwise, which is the best place for them.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "query.h"
#include "scene.h"
#include "timing.h"

namespace roam::bench {

struct Engine {
  std::string name;           ///< with its version
  std::string used;           ///< how it is used, for the reader of a table
  bool spheres_only = false;  ///< it knows no capsule
  bool says_when = true;      ///< false: it answers hit or free, but not when
  std::size_t bytes = 0;      ///< resident, everything that queries need
  double build_one = 0;       ///< seconds on one thread
  double build_two = 0;       ///< seconds on two threads; 0 when it builds on one only
  std::function<Answer(const Query&)> sweep{};
  Ask ask{};  ///< the same, timed

  /// Sets sweep and ask.
  template <class Sweep>
  void answer_with(Sweep function) {
    sweep = function;
    ask = timed(function);
  }
};

/// Seconds that `work` takes.
[[nodiscard]] double seconds(const std::function<void()>& work);

[[nodiscard]] Engine make_roam(const Scene& scene);
[[nodiscard]] Engine make_bullet(const Scene& scene);
[[nodiscard]] Engine make_embree(const Scene& scene);
/// osgUtil::PolytopeIntersector over the scene graph.
[[nodiscard]] Engine make_polytope(const Scene& scene, bool with_kd_tree);

/// The paper's own equations, without any index.
[[nodiscard]] Engine make_paper(const Scene& scene);

/// Engines that this build has, by the names that --engines takes, in the order of the tables.
[[nodiscard]] const std::vector<std::pair<std::string, std::function<Engine(const Scene&)>>>& engines();
/// Engines that were not installed when this was built.
[[nodiscard]] const std::vector<std::string>& absent_engines();

}  // namespace roam::bench
