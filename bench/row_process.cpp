#include "row_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/interrupt.h"
#include "files/descriptor.h"
#include "process/child.h"
#include "roam/error.h"

namespace roam::bench {
namespace {

using nlohmann::json;

constexpr int result_end = 3;       // the descriptor for a row's result
constexpr char loaded_mark = '\n';  // written when the row can move; whitespace for JSON

/// The largest resident memory among the ended children of this process: roam's reader.
std::uint64_t peak_bytes_of_children() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
}

/// The bytes of a line "key: number kB" of a file of /proc; 0 if it has none.
std::uint64_t bytes_in(const char* file, const char* key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(key)) return 1024 * std::stoull(line.substr(std::strlen(key)));
  }
  return 0;
}

/// The largest resident memory of this process so far.
std::uint64_t peak_bytes() { return bytes_in("/proc/self/status", "VmHWM:"); }

/// Numbers as text lose nothing: they are printed with all digits.
json to_json(const Walked& walked) {
  json places = json::array();
  for (const Vec3& p : walked.places) places.push_back({p.x, p.y, p.z});
  return {{"radii", walked.radii}, {"cut", walked.cut}, {"ns", walked.nanoseconds}, {"places", places}};
}

RowResult parse(const std::string& text) {
  const json report = json::parse(text);
  RowResult result;
  result.load_seconds = report.at("load_s");
  result.peak_bytes = report.at("peak_bytes");
  result.adapts = report.at("adapts");
  for (const json& way : report.at("ways")) {
    Walked& walked = result.ways.emplace_back();
    walked.radii = way.at("radii").get<std::vector<double>>();
    walked.cut = way.at("cut");
    walked.nanoseconds = way.at("ns").get<std::vector<double>>();
    for (const json& p : way.at("places")) walked.places.emplace_back(p[0], p[1], p[2]);
  }
  return result;
}

/// The children of a process that it has not waited for.
std::vector<pid_t> children_of(pid_t process) {
  std::ifstream list(fmt::format("/proc/{}/task/{}/children", process, process));
  std::vector<pid_t> children;
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

/// The resident memory of the process and its children now.
std::uint64_t bytes_now(pid_t process) {
  static const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  std::ifstream sizes(fmt::format("/proc/{}/statm", process));
  std::uint64_t whole = 0, resident = 0;
  sizes >> whole >> resident;
  std::uint64_t bytes = resident * page;
  for (const pid_t child : children_of(process)) bytes += bytes_now(child);
  return bytes;
}

/// The default limit of memory for rows: three quarters of the machine's free memory.
std::uint64_t memory_for_rows() {
  const std::uint64_t free = bytes_in("/proc/meminfo", "MemAvailable:");
  return free > 0 ? free / 4 * 3 : std::numeric_limits<std::uint64_t>::max();
}

/// The output of a row, and the reason if it was ended early.
struct Heard {
  std::string text;
  std::string stopped;  ///< empty if the row ended by itself
};

/// Reads until the other end is closed, or the row exceeds its limits. Empty after Ctrl-C, and if reading fails.
std::optional<Heard> listen(int end, pid_t row, std::size_t ways, const PaperOptions& options) {
  constexpr int look_up = 50;  // ms: a signal may come just before the interruptible call, and memory grows fast
  // A way checks the clock only between its steps. The minute covers work before, between and after the ways.
  const std::chrono::duration<double> walking(static_cast<double>(ways) * options.patience + 60.0);
  const std::chrono::duration<double> loading(options.loading);
  auto start = std::chrono::steady_clock::now();  // of the row's current phase
  const std::uint64_t memory = options.memory > 0 ? options.memory : memory_for_rows();
  Heard heard;
  std::array<char, 65536> buffer{};
  while (!app::interrupted()) {
    pollfd ready{end, POLLIN, 0};
    const int count = ::poll(&ready, 1, look_up);
    if (bytes_now(row) > memory) {
      heard.stopped = fmt::format("it takes more than {} MiB of memory", memory >> 20);
      return heard;
    }
    const bool loads = heard.text.empty();
    if (std::chrono::steady_clock::now() - start > (loads ? loading : walking)) {
      heard.stopped =
          loads ? fmt::format("it has not loaded the scene in {:g} s", options.loading) : "a step did not end";
      return heard;
    }
    if (count == 0 || (count < 0 && errno == EINTR)) continue;
    const ssize_t got = count < 0 ? -1 : ::read(end, buffer.data(), buffer.size());
    if (got == 0) return heard;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (loads) start = std::chrono::steady_clock::now();
    heard.text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  return std::nullopt;
}

/// Ends a process and its children.
void end_process(pid_t process) {
  for (const pid_t child : children_of(process)) end_process(child);
  ::kill(process, SIGKILL);
}

json run(const PaperRow& row, const PaperScene& scene, const PaperOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  json report, ways = json::array();
  {
    const Mover mover = row.load(scene);
    const std::vector<Way> paper = paper_ways(options.radius, options.split_radius);
    mover.place(paper.front());  // movers that load in the background wait here
    report["load_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report["adapts"] = static_cast<bool>(mover.radius);
    if (::write(result_end, &loaded_mark, 1) != 1) throw Error("cannot write to the command that started this row");
    for (const Way& way : paper) ways.push_back(to_json(walk(mover, way, options.patience)));
  }
  // By now the mover's child processes have ended, so they count.
  report["peak_bytes"] = peak_bytes() + peak_bytes_of_children();
  report["ways"] = std::move(ways);
  return report;
}

}  // namespace

RowResult run_row(const std::string& name, const PaperScene& scene, const PaperOptions& options) {
  std::vector<std::string> arguments{row_verb,
                                     name,
                                     scene.scene,
                                     scene.store,
                                     scene.tiles,
                                     std::to_string(scene.tile_count),
                                     std::to_string(scene.memory),
                                     fmt::format("{}", options.radius),
                                     fmt::format("{}", options.split_radius),
                                     fmt::format("{}", options.patience),
                                     options.wasm};
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("cannot make a pipe");
  const files::Descriptor ours(ends[0]);
  files::Descriptor theirs(ends[1]);
  // Ctrl-C reaches the row too; a signal to this process alone does not.
  process::Child child("/proc/self/exe", arguments,
                       {.descriptors = {{STDIN_FILENO, STDIN_FILENO},
                                        {STDOUT_FILENO, STDOUT_FILENO},
                                        {STDERR_FILENO, STDERR_FILENO},
                                        {theirs.number(), result_end}},
                        .own_session = false});
  theirs.close();
  const std::optional<Heard> heard =
      listen(ours.number(), child.id(), paper_ways(options.radius, options.split_radius).size(), options);
  if (!heard || !heard->stopped.empty()) end_process(child.id());
  while (!child.wait(std::chrono::hours(1))) {
  }
  app::stop_if_interrupted();
  if (!heard) throw Error("cannot read what the row '" + name + "' found");
  RowResult broken;
  if (!heard->stopped.empty()) {
    broken.failure = heard->stopped;
  } else if (child.ending().signal != 0) {
    broken.failure = fmt::format("ended by signal {}", ::strsignal(child.ending().signal));
  } else if (!child.ending().is_success()) {
    broken.failure = heard->text.empty() ? "ended early" : heard->text;
    if (broken.failure.front() == loaded_mark) broken.failure.erase(0, 1);
  } else {
    return parse(heard->text);
  }
  return broken;
}

int row_main(int argc, char** argv) {
  constexpr int expected = 12;
  std::signal(SIGPIPE, SIG_IGN);             // makes writing to an ended program an error
  ::fcntl(result_end, F_SETFD, FD_CLOEXEC);  // not inherited by programs that the row starts
  std::string text;
  int status = 1;
  try {
    if (argc != expected) throw Error("a row of the paper is started by `roam bench paper` only");
    const PaperScene scene{argv[3], argv[4], argv[5], std::stoul(argv[6]), std::stoull(argv[7])};
    PaperOptions options;
    options.radius = std::stod(argv[8]);
    options.split_radius = std::stod(argv[9]);
    options.patience = std::stod(argv[10]);
    for (const PaperRow& row : paper_rows(argv[11])) {
      if (row.name == argv[2] && row.load) text = run(row, scene, options).dump();
    }
    status = text.empty() ? 1 : 0;
  } catch (const std::exception& error) {
    text = error.what();
  }
  std::FILE* out = ::fdopen(result_end, "w");
  if (out == nullptr) return 1;
  std::fwrite(text.data(), 1, text.size(), out);
  return std::fclose(out) == 0 ? status : 1;
}

}  // namespace roam::bench
