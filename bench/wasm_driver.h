#pragma once
/// \file
/// A node process that runs one of the scripts of bench/wasm: see wasm/channel.mjs for the protocol.

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "files/descriptor.h"
#include "float_mesh.h"
#include "process/child.h"

namespace roam::bench {

/// "" if npm's `packages`, separated by spaces, are in the node_modules of the folder `modules`, else advice.
[[nodiscard]] std::string wasm_package_missing(const std::string& packages, const std::string& modules);

/// Ends its process in the destructor. All functions throw roam::Error, which names the engine, if the process ended
/// early.
class WasmDriver {
 public:
  /// Throws roam::Error if node cannot be started.
  WasmDriver(std::string name, const std::string& script, const std::string& modules);
  ~WasmDriver();
  WasmDriver(const WasmDriver&) = delete;
  WasmDriver& operator=(const WasmDriver&) = delete;

  /// Sends the scene, and waits until it is built. Returns the driver's JSON text about itself.
  [[nodiscard]] std::string start(const FloatMesh& mesh);

  static constexpr std::size_t question_numbers = 8;
  /// Sends questions of eight numbers each. Receives as many numbers for each as the script gives, in order.
  void ask(std::span<const double> questions, std::span<double> answers);

 private:
  void send(const void* data, std::size_t bytes);
  void receive(void* data, std::size_t bytes);

  std::string name_;
  files::Descriptor requests_, replies_;
  std::optional<process::Child> child_;
};

}  // namespace roam::bench
