#include "import/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <string>

#include "import/reader_process.h"
#include "text/printable.h"

namespace roam::reader {
namespace {

using Clock = std::chrono::steady_clock;

/// How long to wait for bytes before the progress callback is served.
constexpr int wait_milliseconds = 100;
/// A reader that has closed its stream is about to end; one that does not is killed.
constexpr int ending_milliseconds = 2000;
/// A slow disk's rate: by so many bytes of file a silent reader is given one second more.
constexpr double silence_bytes_per_second = 4e6;

std::vector<std::string> arguments_of(const Reading& reading) {
  const ImportOptions& options = *reading.options;
  std::vector<std::string> arguments{"--unit", fmt::format("{}", metres_per(options.unit)), "--memory",
                                     fmt::format("{}", options.memory_limit)};
  if (options.up) {
    constexpr const char* names[] = {"x", "y", "z"};
    arguments.insert(arguments.end(), {"--up", names[static_cast<int>(*options.up)]});
  }
  for (const std::string& pattern : options.ignore) arguments.insert(arguments.end(), {"--ignore", pattern});
  if (const auto& frame = reading.frame) {
    const Vec3& o = frame->origin;
    arguments.insert(arguments.end(),
                     {"--frame", fmt::format("{}", o.x), fmt::format("{}", o.y), fmt::format("{}", o.z), frame->srs});
  }
  if (!reading.tile.empty()) arguments.insert(arguments.end(), {"--tile", reading.tile});
  if (reading.wanted == Reading::Wanted::display) arguments.emplace_back("--display");
  if (reading.wanted == Reading::Wanted::pieces) arguments.emplace_back("--pieces");
  if (reading.wanted == Reading::Wanted::list) arguments.emplace_back("--only-list");
  if (const auto& o = reading.origin) {
    arguments.insert(arguments.end(),
                     {"--origin", fmt::format("{}", o->x), fmt::format("{}", o->y), fmt::format("{}", o->z)});
  }
  // A path that begins with a dash must not be taken for an option.
  arguments.insert(arguments.end(), {"--", reading.path.string()});
  return arguments;
}

bool mentions(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

std::string too_much_memory(const ImportOptions& options) {
  return fmt::format(
      "needs more than the {:.3g} GiB of memory that importing may use; allow more, or leave objects out",
      static_cast<double>(options.memory_limit) / static_cast<double>(1ull << 30));
}

/// The last line that the child wrote, for people who look further.
std::string last_words(const std::string& complaints) {
  std::string text = complaints;
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  if (const auto line = text.find_last_of('\n'); line != std::string::npos) text.erase(0, line + 1);
  constexpr std::size_t length_limit = 200;
  return text.empty() ? "" : " (its last words: " + printable(text, length_limit) + ")";
}

/// Why a reader ended before it was done.
std::string cause_of_death(const Ending& ending, const std::string& complaints, const ImportOptions& options) {
  if (mentions(complaints, "bad_alloc") || mentions(complaints, "out of memory")) return too_much_memory(options);
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

}  // namespace

void read_one(const Reading& reading, StreamReceiver& receiver, std::vector<bool>& matched) {
  const ImportOptions& options = *reading.options;
  const std::string path = reading.path.string();
  const auto fail = [&](const std::string& what) -> Error { return Error(printable(path) + ": " + what + "."); };

  const double silence_limit =
      options.silence_limit + static_cast<double>(reading.path_bytes) / silence_bytes_per_second;
  ReaderProcess process(reading.program, arguments_of(reading));
  Clock::time_point heard = Clock::now();
  Clock::time_point reported = heard;
  try {
    while (!receiver.ended()) {
      std::size_t received = 0;
      const auto arrival = process.receive(receiver.room(), wait_milliseconds, received);
      if (arrival == ReaderProcess::Arrival::end) {
        const Ending ending = process.finish(ending_milliseconds);
        throw fail(cause_of_death(ending, process.complaints(), options));
      }
      if (arrival == ReaderProcess::Arrival::bytes) {
        receiver.take(received);
      }
      // A taker may be slow, which is not the reader's fault.
      const Clock::time_point now = Clock::now();
      if (arrival == ReaderProcess::Arrival::bytes) {
        heard = now;
      } else if (std::chrono::duration<double>(now - heard).count() > silence_limit) {
        throw fail(
            fmt::format("its reader said nothing for {:.0f} s and was ended. The file is damaged, or needs a "
                        "longer time limit",
                        silence_limit));
      }
      if (now - reported >= std::chrono::milliseconds(wait_milliseconds)) {
        reported = now;
        reading.report_progress(receiver.bytes_read(), receiver.triangles());
      }
    }
  } catch (const StreamReceiver::Failure& failure) {
    throw Error(failure.sentence);
  } catch (const StreamReceiver::ContentTooLarge&) {
    throw fail(too_much_memory(options));
  } catch (const StreamReceiver::StreamDamaged& damage) {
    throw fail(
        fmt::format("its reader sent {}; it is broken, or not the roam-reader of this version. Install roam "
                    "anew",
                    damage.how));
  }
  for (std::size_t i = 0; i < matched.size(); ++i) matched[i] = matched[i] || receiver.matched()[i];
}

}  // namespace roam::reader
