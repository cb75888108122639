#include "controllers.h"

#include <memory>

#include "node_controller.h"
#include "paper_movers.h"
#include "roam/world.h"
#include "wasm_driver.h"

namespace roam::bench {
namespace {

Mover roam_walker(const Scene& scene) { return roam_in(std::make_shared<World>(World::build(scene.meshes))); }

[[maybe_unused]] Controller in_node(const std::string& engine, const std::string& package, const std::string& used,
                                    const std::string& variable, const std::string& wasm) {
  Controller controller{
      .name = engine + "-wasm", .used = used, .missing = wasm_package_missing(package, wasm), .load = {}};
  if (!controller.missing.empty()) {
    controller.missing += ", or build it yourself, and roam again with -D" + variable + "=FOLDER";
    return controller;
  }
  controller.load = [engine, wasm](const Scene& scene) { return node_controller(FloatMesh(scene), engine, wasm); };
  return controller;
}

}  // namespace

std::vector<Controller> controllers([[maybe_unused]] const std::string& wasm) {
  return {
      {"roam", "Walker", {}, roam_walker},
#ifdef ROAM_BENCH_PHYSX
      {"physx", "PxCapsuleController, contact offset 1 cm", {}, physx_controller},
#else
      in_node("physx", "physx-js-webidl", "PxCapsuleController, contact offset 1 mm", "ROAM_PHYSX_DIR", wasm),
#endif
#ifdef ROAM_BENCH_JOLT
      {"jolt", "CharacterVirtual, padding 2 cm", {}, jolt_controller},
#else
      in_node("jolt", "jolt-physics", "CharacterVirtual, padding 2 cm", "Jolt_DIR", wasm),
#endif
#ifdef ROAM_BENCH_BULLET
      {"bullet", "btKinematicCharacterController", {}, bullet_controller},
#else
      {"bullet", {}, "install libbullet-dev and build again", {}},
#endif
  };
}

}  // namespace roam::bench
