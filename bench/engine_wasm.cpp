// Engines that npm brings as WebAssembly. Each runs in a node process of its own, gets the scene and the queries
// through one pipe and answers through another; the time of a query is measured in there, around the engine's own call.

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine.h"
#include "float_mesh.h"
#include "roam/error.h"
#include "wasm_drivers.h"

extern char** environ;

namespace roam::bench {
namespace {

// What bench/wasm/channel.mjs reads and writes.
constexpr int requests_end = 3, replies_end = 4;
constexpr std::size_t query_numbers = 8, answer_numbers = 2;

class Driver {
 public:
  Driver(std::string name, const std::string& script, std::string modules) : name_(std::move(name)) {
    std::array<int, 2> in{}, out{};
    if (::pipe2(in.data(), O_CLOEXEC) != 0 || ::pipe2(out.data(), O_CLOEXEC) != 0) throw Error("cannot make a pipe");
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
      child_ = 0;
      throw Error("node cannot be started (" + std::string(std::strerror(failed)) + "): install nodejs");
    }
  }
  ~Driver() {
    ::close(requests_);  // upon which it ends
    ::close(replies_);
    if (child_ > 0) ::waitpid(child_, nullptr, 0);
  }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  void send(const void* data, std::size_t bytes) {
    const auto* from = static_cast<const char*>(data);
    while (bytes > 0) {
      const ssize_t put = ::write(requests_, from, bytes);
      if (put < 0 && errno == EINTR) continue;
      if (put < 0) throw Error(name_ + " ended early; what it said is above");
      from += put;
      bytes -= static_cast<std::size_t>(put);
    }
  }
  void receive(void* data, std::size_t bytes) {
    auto* to = static_cast<char*>(data);
    while (bytes > 0) {
      const ssize_t got = ::read(replies_, to, bytes);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) throw Error(name_ + " ended early; what it said is above");
      to += got;
      bytes -= static_cast<std::size_t>(got);
    }
  }

 private:
  std::string name_;
  pid_t child_ = 0;
  int requests_ = -1, replies_ = -1;
};

void ask(Driver& driver, std::span<const Query> queries, std::span<double> nanoseconds, std::span<Answer> answers) {
  std::vector<double> numbers;
  numbers.reserve(query_numbers * queries.size());
  for (const Query& q : queries) {
    numbers.insert(numbers.end(), {q.body.radius, q.body.half_height, q.from.x, q.from.y, q.from.z, q.motion.x,
                                   q.motion.y, q.motion.z});
  }
  const auto count = static_cast<std::uint32_t>(queries.size());
  driver.send(&count, sizeof(count));
  driver.send(numbers.data(), numbers.size() * sizeof(double));
  numbers.resize(answer_numbers * queries.size());
  driver.receive(numbers.data(), numbers.size() * sizeof(double));
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double time = numbers[answer_numbers * i];
    answers[i] = time <= 1.0 ? Answer{true, time} : Answer{};
    nanoseconds[i] = numbers[answer_numbers * i + 1];
  }
}

}  // namespace

Engine make_wasm(const Scene& scene, const std::string& name, const std::string& modules) {
  const std::string script = std::string(wasm_channel) + (name == "physx" ? wasm_physx : wasm_jolt);
  const auto driver = std::make_shared<Driver>(name, script, modules);
  {
    const FloatMesh mesh(scene);
    const std::array<std::uint32_t, 2> sizes{static_cast<std::uint32_t>(mesh.vertices.size() / 3),
                                             static_cast<std::uint32_t>(mesh.indices.size() / 3)};
    driver->send(sizes.data(), sizeof(sizes));
    driver->send(mesh.vertices.data(), mesh.vertices.size() * sizeof(float));
    driver->send(mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
  }
  std::uint32_t length = 0;
  driver->receive(&length, sizeof(length));
  std::string text(length, ' ');
  driver->receive(text.data(), length);
  const nlohmann::json about = nlohmann::json::parse(text);
  Engine engine{.name = about.at("name"), .used = about.at("used")};
  engine.build_one = about.at("build_s");
  engine.bytes = about.at("bytes");
  engine.ask = [driver](std::span<const Query> queries, std::span<double> nanoseconds, std::span<Answer> answers) {
    bench::ask(*driver, queries, nanoseconds, answers);
  };
  return engine;
}

}  // namespace roam::bench
