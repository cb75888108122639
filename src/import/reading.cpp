#include "import/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "text/printable.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Longest wait for bytes between two calls of the progress function.
constexpr int wait_milliseconds = 100;
/// Time for a reader to end after it has closed its stream. Then it is killed.
constexpr int ending_milliseconds = 2000;
/// Seconds of processor time that a reader may have used while its reports are still in the pipe.
constexpr double unheard_seconds = 2.0;
/// Seconds after which the scene's budget hears of a reader again.
constexpr double shared_step = 0.1;
/// Time for a reader without a file to start and send its greeting.
constexpr std::chrono::seconds greeting_time{30};
/// The rate of a slow disk, bytes a second: a silent reader gets one second more for this many bytes of files.
constexpr double silence_bytes_per_second = 4e6;
/// A reader may send bytes and yet make no progress. In all it may take this many times the limit of silence,
constexpr double silences = 5.0;
/// plus one second for this many bytes that it has read, which is ten times the processor time allowed for them.
constexpr double waiting_bytes_per_second = 0.1 / ProcessorBudget::seconds_per_byte;

std::vector<std::string> arguments_of(const Reading& reading) {
  const ImportOptions& options = *reading.options;
  std::vector<std::string> arguments{"--unit", fmt::format("{}", metres_per(options.unit)), "--memory",
                                     fmt::format("{}", options.memory_limit)};
  const SceneScope& scope = reading.scope;
  for (const fs::path& folder : scope.folders) arguments.insert(arguments.end(), {"--folder", folder.string()});
  for (const fs::path& file : scope.files) arguments.insert(arguments.end(), {"--file", file.string()});
  if (options.up) arguments.insert(arguments.end(), {"--up", to_string(*options.up)});
  for (const std::string& pattern : options.ignore) arguments.insert(arguments.end(), {"--ignore", pattern});
  if (const auto& frame = reading.frame) {
    const Vec3& o = frame->origin;
    arguments.insert(arguments.end(),
                     {"--frame", fmt::format("{}", o.x), fmt::format("{}", o.y), fmt::format("{}", o.z), frame->srs});
  }
  if (!reading.tile.empty()) arguments.insert(arguments.end(), {"--tile", reading.tile});
  if (const auto& entry = reading.entry) {
    arguments.insert(arguments.end(), {"--entry", fmt::format("{}", entry->record), fmt::format("{}", entry->number)});
  }
  if (reading.wanted == Reading::Wanted::display) arguments.emplace_back("--display");
  if (reading.wanted == Reading::Wanted::pages) arguments.emplace_back("--pages");
  if (reading.wanted == Reading::Wanted::pieces) arguments.emplace_back("--pieces");
  if (reading.wanted == Reading::Wanted::list) arguments.emplace_back("--only-list");
  if (const auto& o = reading.origin) {
    arguments.insert(arguments.end(),
                     {"--origin", fmt::format("{}", o->x), fmt::format("{}", o->y), fmt::format("{}", o->z)});
  }
  // A path may begin with a dash, which must not make it an option.
  arguments.insert(arguments.end(), {"--", scope.scene.string()});
  return arguments;
}

bool mentions(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

std::string too_much_memory(const ImportOptions& options) {
  return fmt::format(
      "needs more than the {:.3g} GiB of memory that importing may use; allow more, or leave objects out",
      static_cast<double>(options.memory_limit) / static_cast<double>(1ull << 30));
}

/// The last line of the child's output, which helps to find the cause.
std::string last_words(const std::string& complaints) {
  std::string text = complaints;
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  if (const auto line = text.find_last_of('\n'); line != std::string::npos) text.erase(0, line + 1);
  constexpr std::size_t length_limit = 200;
  return text.empty() ? "" : " (its last words: " + printable(text, length_limit) + ")";
}

std::string without_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

/// The reason why a reader ended early.
std::string cause_of_death(const Ending& ending, const std::string& complaints, const ImportOptions& options) {
  if (mentions(complaints, "bad_alloc") || mentions(complaints, "out of memory")) return too_much_memory(options);
#ifdef SIGSYS
  if (ending.signal == SIGSYS) {
    return "made its reader try something that no scene needs, such as starting a program, reaching a network or "
           "changing a file, and the reader was ended. Do not trust this file";
  }
#endif
  if (ending.signal == SIGKILL) {
    return "cannot be read: its reader was killed, as the system does when memory runs out. Close other programs, or "
           "allow less memory";
  }
  if (ending.signal == SIGXCPU) return "cannot be read: its reader used up the processor time that the shell allows";
  if (ending.signal != 0) {
    return fmt::format(
        "made its reader crash with signal {} ({}){}. The file is damaged, or of a kind that this "
        "reader does not survive; check it, or convert it to another format",
        ending.signal, strsignal(ending.signal), last_words(complaints));
  }
  if (ending.known && ending.exit_code == 127) {
    return fmt::format("cannot be read: the program roam-reader did not start{}. Install roam anew",
                       last_words(complaints));
  }
  return fmt::format("made its reader stop without an answer, with status {}{}. The file is probably damaged",
                     ending.exit_code, last_words(complaints));
}

/// Receives the greeting of a reader that has no file to read.
class WallsReceiver : public StreamReceiver {
 public:
  explicit WallsReceiver(ImportReport& report) : StreamReceiver(report, 0, 0) {}
  [[nodiscard]] std::uint64_t triangles() const override { return 0; }

 private:
  void take_content(FrameKind, std::span<const std::byte>) override { throw StreamDamaged{"a frame of unknown kind"}; }
  void finish_content(const Totals&) override {}
};

}  // namespace

Confinement confinement_of(const fs::path& program) {
  ReaderProcess process(program, {"--only-walls", "--memory", "67108864", "--", "/"});
  ImportReport report;
  WallsReceiver greeting(report);
  try {
    const Clock::time_point until = Clock::now() + greeting_time;
    while (!report.confinement && Clock::now() < until) {
      std::size_t received = 0;
      const auto arrival = process.receive(greeting.room(), wait_milliseconds, received);
      if (arrival == ReaderProcess::Arrival::end) break;
      greeting.take(received);
    }
  } catch (const StreamReceiver::StreamDamaged&) {
    report.confinement.reset();
  }
  if (report.confinement) return *report.confinement;
  throw Error::at(program.string(),
                  program.string() + " is not the roam-reader of this version, or cannot run here. Install roam anew.");
}

std::unique_ptr<ReaderProcess> start(const Reading& reading) {
  return std::make_unique<ReaderProcess>(reading.program, arguments_of(reading),
                                         reading.wanted == Reading::Wanted::pages);
}

void receive(const Reading& reading, ReaderProcess& process, StreamReceiver& receiver, ProcessorBudget budget) {
  const ImportOptions& options = *reading.options;
  const std::string path = reading.path.string();
  const auto fail = [&](const std::string& what) -> Error {
    return Error::at(path, printable(path) + ": " + what + ".");
  };

  receiver.spell(reading.scope.scene.string(), without_slash(path));
  Clock::time_point reported = Clock::now();
  double waited = 0.0, heard = 0.0;  // seconds: in all, and until the last bytes arrived
  double named = 0.0;                // processor seconds of this thread, for the files that the reader named
  double shared = 0.0;               // processor seconds that the scene's budget knows
  const auto share = [&](double used, double step) {
    if (reading.scene == nullptr || used - shared < step) return;
    if (reading.scene->add(used - std::exchange(shared, used))) return;
    throw fail(
        fmt::format("the readers of its parts computed for more than {:.0f} s together. The scene is damaged, or "
                    "mentions its files over and over; then write it out as fewer files",
                    reading.scene->allowed()));
  };
  budget.share(reading.scene);
  try {
    while (!receiver.ended()) {
      std::size_t received = 0;
      const Clock::time_point begin = Clock::now();
      const auto arrival = process.receive(receiver.room(), wait_milliseconds, received);
      // A longer wait means that this program was stopped.
      waited += std::min(std::chrono::duration<double>(Clock::now() - begin).count(), 1e-3 * 2 * wait_milliseconds);
      if (arrival == ReaderProcess::Arrival::end) {
        const Ending ending = process.finish(ending_milliseconds);
        throw fail(cause_of_death(ending, process.complaints(), options));
      }
      if (arrival == ReaderProcess::Arrival::bytes) {
        receiver.take(received);
        const double before = processor_seconds();
        for (const std::string& file : receiver.take_opened()) {
          if (reading.scope.resolve(file) == fs::path(file)) budget.add_file(file);
        }
        named += processor_seconds() - before;
        // A file's author pays as little for triangles that are left out, and for vertices, as for triangles.
        const std::uint64_t given =
            std::max(receiver.triangles() + receiver.left_out_triangles(), receiver.vertices() / 3);
        if (given > budget.triangles()) {
          throw fail(
              fmt::format("it gives more than {} triangles, or three vertices for each, from {} bytes: it repeats "
                          "itself over and over. If that is meant, write "
                          "it out without repetition",
                          budget.triangles(), budget.bytes()));
        }
      }
      // Unread bytes in the pipe may report more opened files.
      const double grace = arrival == ReaderProcess::Arrival::bytes ? unheard_seconds : 0.0;
      const double used = budget.used() + named + receiver.own_seconds();
      if (arrival != ReaderProcess::Arrival::bytes) share(used, shared_step);
      if (used > ProcessorBudget::least_seconds) {
        if (const double allowed = budget.allowed(); used > allowed + grace) {
          throw fail(fmt::format(
              "its reader computed for more than {:.0f} s on {} bytes and was ended. The file is damaged, or refers to "
              "itself over and over",
              allowed, budget.bytes()));
        }
      }
      // The reader may be reading all its files from a slow disk.
      const double silence_limit =
          options.silence_limit +
          static_cast<double>(std::max(reading.path_bytes, budget.file_bytes())) / silence_bytes_per_second;
      if (arrival == ReaderProcess::Arrival::bytes) {
        heard = waited;
      } else if (waited - heard > silence_limit) {
        throw fail(
            fmt::format("its reader said nothing for {:.0f} s and was ended. The file is damaged, or needs a "
                        "longer time limit",
                        silence_limit));
      }
      if (waited > silences * silence_limit) {
        const double patience =
            silences * silence_limit + static_cast<double>(budget.bytes()) / waiting_bytes_per_second;
        if (waited > patience) {
          throw fail(fmt::format(
              "its reader did not get done in {:.0f} s, for {} bytes that it read, and was ended. The file is damaged, "
              "or needs a longer time limit",
              patience, budget.bytes()));
        }
      }
      const Clock::time_point now = Clock::now();
      if (now - reported >= std::chrono::milliseconds(wait_milliseconds)) {
        reported = now;
        reading.report_progress(receiver.bytes_read(), receiver.triangles());
      }
    }
    share(budget.used() + named + receiver.own_seconds(), 0.0);
  } catch (const StreamReceiver::ContentTooLarge&) {
    throw fail(too_much_memory(options));
  } catch (const StreamReceiver::StreamDamaged& damage) {
    throw fail(
        fmt::format("its reader sent {}; it is broken, or not the roam-reader of this version. Install roam "
                    "anew",
                    damage.how));
  }
}

void read_one(const Reading& reading, StreamReceiver& receiver, std::vector<bool>& matched) {
  const std::unique_ptr<ReaderProcess> process = start(reading);
  // The process may have read much already.
  receive(reading, *process, receiver, ProcessorBudget(process->id()));
  for (std::size_t i = 0; i < matched.size(); ++i) matched[i] = matched[i] || receiver.matched()[i];
}

}  // namespace roam::reader
