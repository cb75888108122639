#include "node_controller.h"

#include <array>
#include <memory>

#include "controllers.h"
#include "wasm_driver.h"
#include "wasm_drivers.h"

namespace roam::bench {

Mover node_controller(const FloatMesh& mesh, const std::string& engine, const std::string& modules, const Vec3& shift) {
  struct State {
    WasmDriver driver;
    Vec3 shift;
    std::array<double, 4> answer{};  // the place, and nanoseconds

    Vec3 ask(const std::array<double, WasmDriver::question_numbers>& question) {
      driver.ask(question, answer);
      return Vec3(answer[0], answer[1], answer[2]) - shift;
    }
  };
  std::string script = wasm_channel;
  if (engine == "physx") script.append(wasm_physx).append(wasm_physx_controller);
  if (engine == "jolt") script.append(wasm_jolt).append(wasm_jolt_controller);
  const std::shared_ptr<State> state(new State{{engine, script, modules}, shift});
  (void)state->driver.start(mesh);
  Mover mover;
  mover.place = [state](const Way& way) {
    const Vec3 p = way.from + state->shift;
    const double axis = 2.0 * way.body().half_height;
    (void)state->ask({0.0, way.radius, way.walking ? 1.0 : 0.0, p.x, p.y, p.z, axis, axis > 0.0 ? step_height : 0.0});
  };
  mover.step = [state](const Vec3& v) { return state->ask({1.0, v.x, v.y, v.z, 1.0 / paper_rate}); };
  mover.nanoseconds = [state] { return state->answer[3]; };
  return mover;
}

}  // namespace roam::bench
