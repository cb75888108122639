#include "engine.h"

#include "wasm_driver.h"

namespace roam::bench {
namespace {

using Make = std::function<Engine(const Scene&)>;

EngineOffer linked(const char* name, Make make) { return {.name = name, .missing = {}, .make = std::move(make)}; }

[[maybe_unused]] EngineOffer left_out(const char* name, const char* package) {
  return {.name = name, .missing = std::string("install ") + package + " and build again", .make = {}};
}

[[maybe_unused]] EngineOffer not_given(const char* name, const char* variable) {
  return {.name = name,
          .missing = std::string("build it yourself, and roam again with -D") + variable + "=FOLDER",
          .make = {}};
}

EngineOffer in_node(const std::string& name, const std::string& package, const EnginePlaces& places) {
  EngineOffer offer{.name = name, .missing = wasm_package_missing(package, places.wasm), .make = {}};
  if (offer.missing.empty()) {
    offer.make = [name, where = places.wasm](const Scene& scene) { return make_in_node(scene, name, where); };
  }
  return offer;
}

}  // namespace

std::vector<EngineOffer> engine_offers(const EnginePlaces& places) {
  return {
      linked("roam", make_roam),
#ifdef ROAM_BENCH_BULLET
      linked("bullet", make_bullet),
#else
      left_out("bullet", "libbullet-dev"),
#endif
#ifdef ROAM_BENCH_EMBREE
      linked("embree", make_embree),
#else
      left_out("embree", "libembree-dev"),
#endif
#ifdef ROAM_BENCH_FCL
      linked("fcl", make_fcl),
#else
      left_out("fcl", "libfcl-dev"),
#endif
#ifdef ROAM_BENCH_PHYSX
      linked("physx", make_physx),
#else
      not_given("physx", "ROAM_PHYSX_DIR"),
#endif
#ifdef ROAM_BENCH_JOLT
      linked("jolt", make_jolt),
#else
      not_given("jolt", "Jolt_DIR"),
#endif
#ifdef ROAM_BENCH_BOX3D
      linked("box3d", make_box3d),
#else
      not_given("box3d", "box3d_DIR"),
#endif
      linked("polytope", [](const Scene& scene) { return make_polytope(scene, false); }),
      linked("polytope-kdtree", [](const Scene& scene) { return make_polytope(scene, true); }),
      in_node("physx-wasm", "physx-js-webidl", places),
      in_node("jolt-wasm", "jolt-physics", places),
      in_node("three-mesh-bvh", "three three-mesh-bvh", places),
      linked("paper", make_paper),
  };
}

const std::vector<std::string>& engine_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const EngineOffer& offer : engine_offers({})) all.push_back(offer.name);
    return all;
  }();
  return names;
}

}  // namespace roam::bench
