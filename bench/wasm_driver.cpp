#include "wasm_driver.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <sstream>

#include "process/find_program.h"
#include "roam/error.h"

namespace roam::bench {
namespace {

// The descriptors that bench/wasm/channel.mjs uses.
constexpr int requests_end = 3, replies_end = 4;

}  // namespace

std::string wasm_package_missing(const std::string& packages, const std::string& modules) {
  if (modules.empty()) return "`npm install --prefix DIR " + packages + "`, then --wasm-engines DIR";
  std::istringstream names(packages);
  for (std::string package; names >> package;) {
    if (!std::filesystem::exists(std::filesystem::path(modules) / "node_modules" / package)) {
      return "`npm install --prefix " + modules + " " + packages + "`";
    }
  }
  return {};
}

WasmDriver::WasmDriver(std::string name, const std::string& script, const std::string& modules)
    : name_(std::move(name)) {
  const std::filesystem::path node = process::find_program("node");
  if (node.empty()) throw Error("node cannot be started (it is not on the PATH): install nodejs");
  std::array<int, 2> in{}, out{};
  if (::pipe2(in.data(), O_CLOEXEC) != 0) throw Error("cannot make a pipe");
  const files::Descriptor requests_in_child(in[0]);
  requests_ = files::Descriptor(in[1]);
  if (::pipe2(out.data(), O_CLOEXEC) != 0) throw Error("cannot make a pipe");
  replies_ = files::Descriptor(out[0]);
  const files::Descriptor replies_in_child(out[1]);
  // The libraries' output is a note, not a result.
  child_.emplace(
      node, std::vector<std::string>{"--max-old-space-size=8192", "--input-type=module", "--eval", script, modules},
      process::ChildSettings{.descriptors = {{requests_in_child.number(), requests_end},
                                             {replies_in_child.number(), replies_end},
                                             {STDERR_FILENO, STDOUT_FILENO},
                                             {STDERR_FILENO, STDERR_FILENO}},
                             .own_session = false});
}

WasmDriver::~WasmDriver() {
  requests_.close();  // ends the process
  replies_.close();
  child_->wait(process::Child::usual_grace);
}

std::string WasmDriver::start(const FloatMesh& mesh) {
  const std::array<std::uint32_t, 2> sizes{static_cast<std::uint32_t>(mesh.vertices.size() / 3),
                                           static_cast<std::uint32_t>(mesh.indices.size() / 3)};
  send(sizes.data(), sizeof(sizes));
  send(mesh.vertices.data(), mesh.vertices.size() * sizeof(float));
  send(mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
  std::uint32_t length = 0;
  receive(&length, sizeof(length));
  std::string text(length, ' ');
  receive(text.data(), length);
  return text;
}

void WasmDriver::ask(std::span<const double> questions, std::span<double> answers) {
  const auto count = static_cast<std::uint32_t>(questions.size() / question_numbers);
  send(&count, sizeof(count));
  send(questions.data(), questions.size_bytes());
  receive(answers.data(), answers.size_bytes());
}

void WasmDriver::send(const void* data, std::size_t bytes) {
  const std::span all(static_cast<const std::byte*>(data), bytes);
  if (files::write_fully(requests_.number(), all) < bytes) throw Error(name_ + " ended early; what it said is above");
}

void WasmDriver::receive(void* data, std::size_t bytes) {
  const std::span all(static_cast<std::byte*>(data), bytes);
  if (files::read_fully(replies_.number(), all) < bytes) throw Error(name_ + " ended early; what it said is above");
}

}  // namespace roam::bench
