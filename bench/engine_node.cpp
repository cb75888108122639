// Engines from npm, as WebAssembly or JavaScript. Each runs in a node process of its own, gets the scene and the
// queries through one pipe and replies through another. The time of a query is measured there, around the engine's own
// call.

#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "engine.h"
#include "float_mesh.h"
#include "wasm_driver.h"
#include "wasm_drivers.h"

namespace roam::bench {
namespace {

void ask(WasmDriver& driver, std::span<const Query> queries, std::span<double> nanoseconds, std::span<Answer> answers) {
  constexpr std::size_t width = 2;  // time of impact and nanoseconds
  std::vector<double> questions, replies(width * queries.size());
  questions.reserve(WasmDriver::question_numbers * queries.size());
  for (const Query& q : queries) {
    questions.insert(questions.end(), {q.body.radius, q.body.half_height, q.from.x, q.from.y, q.from.z, q.motion.x,
                                       q.motion.y, q.motion.z});
  }
  driver.ask(questions, replies);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double time = replies[width * i];
    answers[i] = time <= 1.0 ? Answer{true, time} : Answer{};
    nanoseconds[i] = replies[width * i + 1];
  }
}

}  // namespace

Engine make_in_node(const Scene& scene, const std::string& name, const std::string& modules) {
  std::string script = wasm_channel;
  if (name == "physx-wasm") script.append(wasm_physx).append(wasm_physx_sweep);
  if (name == "jolt-wasm") script.append(wasm_jolt).append(wasm_jolt_sweep);
  if (name == "three-mesh-bvh") script += wasm_three_mesh_bvh;
  const auto driver = std::make_shared<WasmDriver>(name, script, modules);
  const nlohmann::json about = nlohmann::json::parse(driver->start(FloatMesh(scene)));
  Engine engine{.name = about.at("name"), .used = about.at("used")};
  engine.build_one = about.at("build_s");
  engine.bytes = about.at("bytes");
  engine.ask = [driver](std::span<const Query> queries, std::span<double> nanoseconds, std::span<Answer> answers) {
    bench::ask(*driver, queries, nanoseconds, answers);
  };
  return engine;
}

}  // namespace roam::bench
