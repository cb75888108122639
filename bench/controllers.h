#pragma once
/// \file
/// Controllers of persons and other bodies, to walk the same way side by side.

#include <functional>
#include <string>
#include <vector>

#include "paper_ways.h"
#include "scene.h"

namespace roam::bench {

/// The step that a body on foot climbs: WalkerSettings' default. The steepest ground that it walks on is at 45 degrees.
constexpr double step_height = 0.3;  // m

/// One controller, which may be installed or not.
struct Controller {
  std::string name;     ///< as --controllers takes it, and for tables
  std::string used;     ///< how it is used
  std::string missing;  ///< empty, or what to install
  /// Loads the scene, whose coordinates floats must be able to take. Throws roam::Error if it does not start.
  std::function<Mover(const Scene&)> load{};
};

/// All of them. A controller in WebAssembly is there only if its native build is not. `wasm`: the folder whose
/// node_modules hold PhysX and Jolt; empty: none.
[[nodiscard]] std::vector<Controller> controllers(const std::string& wasm);

[[nodiscard]] Mover physx_controller(const Scene& scene);
[[nodiscard]] Mover jolt_controller(const Scene& scene);
[[nodiscard]] Mover bullet_controller(const Scene& scene);

}  // namespace roam::bench
