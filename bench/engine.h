#pragma once
/// \file
/// The interface of an engine for the benchmarks, and all engines.
///
/// Each engine gets the whole scene as one static world and is used in the way that is fastest for these queries; its
/// file says how. Engines that compute in floats get coordinates rounded to floats. By default the benchmark moves the
/// scene's centre to (0, 0, 0), where floats are most precise.

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "query.h"
#include "scene.h"
#include "timing.h"

namespace roam::bench {

struct Engine {
  std::string name;           ///< with its version
  std::string used;           ///< how it is used, for readers of a table
  bool spheres_only = false;  ///< it has no capsules
  bool rays = false;          ///< `ask` takes bodies of radius 0
  bool says_when = true;      ///< false: it reports hit or free, without a time
  std::size_t bytes = 0;      ///< resident, everything that queries need; 0 if unknown
  double build_one = 0;       ///< seconds on one thread
  double build_two = 0;       ///< seconds on two threads; 0 if it builds on one only
  Ask ask{};
  Ask nearest{};  ///< empty if it has no such query
};

/// Seconds that `work` takes.
[[nodiscard]] inline double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

[[nodiscard]] Engine make_roam(const Scene& scene);
[[nodiscard]] Engine make_bullet(const Scene& scene);
[[nodiscard]] Engine make_embree(const Scene& scene);
/// osgUtil::PolytopeIntersector over the scene graph.
[[nodiscard]] Engine make_polytope(const Scene& scene, bool with_kd_tree);

/// The paper's own equations, without any index.
[[nodiscard]] Engine make_paper(const Scene& scene);

/// fcl::distance; each step is as long as the last distance.
[[nodiscard]] Engine make_fcl(const Scene& scene);

/// Native builds of the user's. Each throws roam::Error if the engine cannot take this scene.
[[nodiscard]] Engine make_physx(const Scene& scene);
[[nodiscard]] Engine make_jolt(const Scene& scene);
[[nodiscard]] Engine make_box3d(const Scene& scene);

/// "physx-wasm", "jolt-wasm" or "three-mesh-bvh" from the node_modules of the folder `modules`, in a node process: see
/// wasm/channel.mjs. Throws roam::Error if it does not start, or ends.
[[nodiscard]] Engine make_in_node(const Scene& scene, const std::string& name, const std::string& modules);

/// Places of the engines that are not linked.
struct EnginePlaces {
  std::string wasm;  ///< folder whose node_modules hold the packages of make_in_node; empty: none
};

/// An engine that may be installed or not.
struct EngineOffer {
  std::string name;     ///< as --engines takes it
  std::string missing;  ///< empty, or what to install
  std::function<Engine(const Scene&)> make{};
};
/// All engines, in the order of the tables.
[[nodiscard]] std::vector<EngineOffer> engine_offers(const EnginePlaces& places);
/// Their names.
[[nodiscard]] const std::vector<std::string>& engine_names();

}  // namespace roam::bench
