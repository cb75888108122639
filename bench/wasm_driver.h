#pragma once
/// \file
/// A node process that runs one of the texts of bench/wasm: see wasm/channel.mjs for what goes through its pipes.

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "files/descriptor.h"
#include "float_mesh.h"
#include "process/child.h"

namespace roam::bench {

/// "" when npm's `package` is in the node_modules of the folder `modules`, else what to do.
[[nodiscard]] std::string wasm_package_missing(const std::string& package, const std::string& modules);

/// Ends its process with itself. All throw roam::Error, which names the engine, when that ended early.
class WasmDriver {
 public:
  /// Throws roam::Error when node cannot be started.
  WasmDriver(std::string name, const std::string& script, const std::string& modules);
  ~WasmDriver();
  WasmDriver(const WasmDriver&) = delete;
  WasmDriver& operator=(const WasmDriver&) = delete;

  /// Hands over the scene, and waits until it is built: the JSON text that the driver says about itself.
  [[nodiscard]] std::string start(const FloatMesh& mesh);

  static constexpr std::size_t question_numbers = 8;
  /// Questions of eight numbers each, answered in order by as many numbers each as the script gives.
  void ask(std::span<const double> questions, std::span<double> answers);

 private:
  void send(const void* data, std::size_t bytes);
  void receive(void* data, std::size_t bytes);

  std::string name_;
  files::Descriptor requests_, replies_;
  std::optional<process::Child> child_;
};

}  // namespace roam::bench
