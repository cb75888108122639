#include "engine.h"

#include <chrono>

#include "wasm_driver.h"

namespace roam::bench {
namespace {

using Make = std::function<Engine(const Scene&)>;

EngineOffer linked(const char* name, Make make) { return {.name = name, .missing = {}, .make = std::move(make)}; }

[[maybe_unused]] EngineOffer left_out(const char* name, const char* package) {
  return {.name = name, .missing = std::string("install ") + package + " and build again", .make = {}};
}

EngineOffer wasm(const std::string& name, const std::string& package, const EnginePlaces& places) {
  EngineOffer offer{.name = name, .missing = wasm_package_missing(package, places.wasm), .make = {}};
  if (offer.missing.empty()) {
    offer.make = [name, where = places.wasm](const Scene& scene) { return make_wasm(scene, name, where); };
  }
  return offer;
}

}  // namespace

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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
      linked("polytope", [](const Scene& scene) { return make_polytope(scene, false); }),
      linked("polytope-kdtree", [](const Scene& scene) { return make_polytope(scene, true); }),
      wasm("physx", "physx-js-webidl", places),
      wasm("jolt", "jolt-physics", places),
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
