#include "wasm_driver.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "roam/error.h"

extern char** environ;

namespace roam::bench {
namespace {

// What bench/wasm/channel.mjs reads and writes.
constexpr int requests_end = 3, replies_end = 4;

}  // namespace

std::string wasm_package_missing(const std::string& package, const std::string& modules) {
  if (modules.empty()) return "`npm install --prefix DIR " + package + "`, then --wasm-engines DIR";
  if (std::filesystem::exists(std::filesystem::path(modules) / "node_modules" / package)) return {};
  return "`npm install --prefix " + modules + " " + package + "`";
}

WasmDriver::WasmDriver(std::string name, const std::string& script, std::string modules) : name_(std::move(name)) {
  std::array<int, 2> in{}, out{};
  if (::pipe2(in.data(), O_CLOEXEC) != 0) throw Error("cannot make a pipe");
  if (::pipe2(out.data(), O_CLOEXEC) != 0) {
    ::close(in[0]);
    ::close(in[1]);
    throw Error("cannot make a pipe");
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], requests_end);
  posix_spawn_file_actions_adddup2(&actions, out[1], replies_end);
  // What the libraries print is a note, not a result.
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  std::string node = "node", heap = "--max-old-space-size=8192", kind = "--input-type=module", eval = "--eval";
  std::string text = script;
  std::array<char*, 7> argv{node.data(), heap.data(), kind.data(), eval.data(), text.data(), modules.data(), nullptr};
  const int failed = posix_spawnp(&child_, "node", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(in[0]);
  ::close(out[1]);
  requests_ = in[1];
  replies_ = out[0];
  if (failed != 0) {
    ::close(requests_);
    ::close(replies_);
    throw Error("node cannot be started (" + std::string(std::strerror(failed)) + "): install nodejs");
  }
}

WasmDriver::~WasmDriver() {
  ::close(requests_);  // upon which it ends
  ::close(replies_);
  ::waitpid(child_, nullptr, 0);
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
  const auto* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t put = ::write(requests_, from, bytes);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) throw Error(name_ + " ended early; what it said is above");
    from += put;
    bytes -= static_cast<std::size_t>(put);
  }
}

void WasmDriver::receive(void* data, std::size_t bytes) {
  auto* to = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t got = ::read(replies_, to, bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw Error(name_ + " ended early; what it said is above");
    to += got;
    bytes -= static_cast<std::size_t>(got);
  }
}

}  // namespace roam::bench
