// PhysX's character controller from npm, in a node process. Steps are timed there, around the controller's call.

#include <array>
#include <memory>

#include "paper_movers.h"
#include "wasm_driver.h"
#include "wasm_drivers.h"

namespace roam::bench {

Mover physx_controller(const PaperScene& scene, const std::string& wasm) {
  struct State {
    WasmDriver driver;
    std::array<double, 4> answer{};  // the place, and nanoseconds

    Vec3 ask(const std::array<double, WasmDriver::question_numbers>& question) {
      driver.ask(question, answer);
      return Vec3(answer[0], answer[1], answer[2]) - paper_shift;
    }
  };
  const std::string script = std::string(wasm_channel) + wasm_physx + wasm_physx_controller;
  const std::shared_ptr<State> state(new State{{"PhysX", script, wasm}});
  {
    FloatMesh mesh;
    read_tiles(scene, [&](const FloatMesh& tile) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size() / 3);
      mesh.vertices.insert(mesh.vertices.end(), tile.vertices.begin(), tile.vertices.end());
      for (const std::uint32_t corner : tile.indices) mesh.indices.push_back(first + corner);
    });
    (void)state->driver.start(mesh);
  }
  Mover mover;
  mover.place = [state](const Way& way) {
    const Vec3 p = way.from + paper_shift;
    (void)state->ask({0.0, way.radius, way.walking ? 1.0 : 0.0, p.x, p.y, p.z});
  };
  mover.step = [state](const Vec3& v) { return state->ask({1.0, v.x, v.y, v.z, 1.0 / paper_rate}); };
  mover.nanoseconds = [state] { return state->answer[3]; };
  return mover;
}

}  // namespace roam::bench
