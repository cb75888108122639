#include "engine.h"

#include <chrono>

namespace roam::bench {

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

const std::vector<std::pair<std::string, std::function<Engine(const Scene&)>>>& engines() {
  static const std::vector<std::pair<std::string, std::function<Engine(const Scene&)>>> all{
      {"roam", make_roam},
#ifdef ROAM_BENCH_BULLET
      {"bullet", make_bullet},
#endif
#ifdef ROAM_BENCH_EMBREE
      {"embree", make_embree},
#endif
#ifdef ROAM_BENCH_OSG
      {"polytope", [](const Scene& scene) { return make_polytope(scene, false); }},
      {"polytope-kdtree", [](const Scene& scene) { return make_polytope(scene, true); }},
#endif
      {"paper", make_paper},
  };
  return all;
}

const std::vector<std::string>& absent_engines() {
  static const std::vector<std::string> absent{
#ifndef ROAM_BENCH_BULLET
      "Bullet",
#endif
#ifndef ROAM_BENCH_EMBREE
      "Embree",
#endif
#ifndef ROAM_BENCH_OSG
      "OpenSceneGraph",
#endif
  };
  return absent;
}

}  // namespace roam::bench
