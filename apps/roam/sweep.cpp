// roam sweep: performs the queries of standard input.
#include <fmt/format.h>
#include <poll.h>
#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "cli/interrupt.h"
#include "cli/standard_streams.h"
#include "cli/tell.h"
#include "roam/error.h"
#include "scenes/frame.h"
#include "scenes/open_scene.h"
#include "scenes/web_options.h"
#include "sweep/paged.h"
#include "sweep/rows.h"
#include "text/byte_order_mark.h"
#include "verbs.h"

namespace roam::app {
namespace {

// Large enough to make the passing between threads cheap, small enough for results without delay.
constexpr std::size_t chunk_bytes = 64 * 1024;
// Longer than any row of numbers: input without an end of line in this length is not text.
constexpr std::size_t longest_row = 4096;
// The delay of an error message while the other end of the pipe waits for results.
constexpr int poll_milliseconds = 50;

/// Whole rows of the input.
struct Rows {
  std::string text;
  std::uint64_t first_line = 1;
};

/// The results of Rows, up to the first row that fails.
struct Answers {
  std::string text;
  std::uint64_t rows = 0;
  std::vector<std::pair<std::uint64_t, std::string>> missing;  ///< line, and what could not be read
  std::optional<Error> error;
};

/// Cuts standard input into chunks of whole rows, as they arrive. A script that writes one row and waits gets its
/// result.
class RowReader {
 public:
  /// Empty at the end of the input, and after `stop` became true.
  Rows next(const std::atomic<bool>& stop) {
    Rows rows;
    rows.first_line = line_;
    while (!ended_ && !stop) {
      pollfd input{STDIN_FILENO, POLLIN, 0};
      const int ready = ::poll(&input, 1, poll_milliseconds);
      stop_if_interrupted();
      if (ready <= 0) continue;
      const std::size_t old = rest_.size();
      rest_.resize(old + chunk_bytes);
      const ssize_t got = ::read(STDIN_FILENO, rest_.data() + old, chunk_bytes);
      rest_.resize(old + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
      if (got < 0 && errno != EINTR)
        throw Error::at("-", std::string("cannot read the queries: ") + std::strerror(errno));
      if (got == 0) {
        ended_ = true;
        rows.text = std::move(rest_);
        rest_.clear();
        return rows;
      }
      const std::size_t end = rest_.rfind('\n');
      if (end != std::string::npos) {
        rows.text = rest_.substr(0, end + 1);
        rest_.erase(0, end + 1);
        line_ += static_cast<std::uint64_t>(std::count(rows.text.begin(), rows.text.end(), '\n'));
        return rows;
      }
      if (rest_.size() > longest_row)
        throw Error(fmt::format("line {}", line_),
                    "too long for a query; a row is x,y,z,dx,dy,dz,radius[,half_height]");
    }
    return rows;
  }

 private:
  std::string rest_;
  std::uint64_t line_ = 1;
  bool ended_ = false;
};

/// The sweep, and for a miss the smallest gap: Space::sweep only says that the body did not touch.
Impact sweep_and_measure(const Space& space, const SweepQuery& query) {
  Impact answer = space.sweep(query.body, query.from, query.motion);
  if (answer.hit) return answer;
  for (const double reach : gap_reaches) {
    const Clearance nearest = space.clearance(query.body, query.from, query.motion, reach);
    // The sweep has certified at least 0, even if the grid subtracts more here.
    answer.distance = std::max(0.0, nearest.distance);
    if (nearest.found) break;
  }
  return answer;
}

/// Sweeps through a scene in memory; thread-safe.
class WholeScene {
 public:
  explicit WholeScene(const LoadedScene& scene) : world_(scene.world) {}
  [[nodiscard]] SweepAnswer operator()(const SweepQuery& query) const { return {sweep_and_measure(world_, query), {}}; }

 private:
  const World& world_;
};

template <class Scene>
Answers answer(Scene&& scene, const Rows& rows) {
  Answers answers;
  std::string_view text = rows.first_line == 1 ? without_byte_order_mark(rows.text) : rows.text;
  for (std::uint64_t line = rows.first_line; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (is_blank(row)) continue;
    try {
      if (line == 1 && is_query_header(row)) continue;
      const SweepQuery query = parse_query(row);
      SweepAnswer found = scene(query);
      append_answer(answers.text, found.impact);
      ++answers.rows;
      if (!found.missing.empty()) answers.missing.emplace_back(line, std::move(found.missing));
    } catch (const Error& error) {
      answers.error = Error(fmt::format("line {}", line), error.what());
      return answers;
    }
  }
  return answers;
}

/// Reports unreadable parts: each once, with the first line that needed it.
class Missing {
 public:
  void add(const Answers& answers) {
    rows_ += answers.rows;
    incomplete_ += answers.missing.size();
    for (const auto& [line, what] : answers.missing) {
      if (told_.size() == most_told || !told_.insert(what).second) continue;
      tell(fmt::format("note: line {}: {}", line, what));
    }
  }
  /// Whether any result is incomplete; reports it.
  [[nodiscard]] bool any(const SceneOptions& options) const {
    if (incomplete_ == 0) return false;
    tell(
        fmt::format("{} of {} answers are not complete, because what they need cannot be read: there a way ends "
                    "(feature unknown) or the triangle is not told (-1); `roam verify {}` names all that is damaged",
                    incomplete_, rows_, options.names()));
    return true;
  }

 private:
  static constexpr std::size_t most_told = 20;

  std::uint64_t rows_ = 0, incomplete_ = 0;
  std::set<std::string> told_;
};

ExitStatus sweep(SceneOptions options) {
  take_kept_frame(options);
  OpenScene scene(options, Source::release);
  const int threads =
      options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));

  PagedSweep paged(scene);
  write_output(answer_header);
  RowReader reader;
  std::atomic<bool> failed_row{false};
  const auto read = [&](tbb::flow_control& flow) {
    Rows rows = reader.next(failed_row);
    if (rows.text.empty()) flow.stop();
    return rows;
  };
  const auto work = [&](const Rows& rows) {
    Answers answers = scene.store() ? answer(paged, rows) : answer(WholeScene(scene.loaded()), rows);
    if (answers.error) failed_row = true;
    return answers;
  };
  Missing missing;
  const auto put = [&](const Answers& answers) {
    write_output(answers.text);
    missing.add(answers);
    if (answers.error) throw Error(*answers.error);
  };
  tbb::parallel_pipeline(static_cast<std::size_t>(4 * threads),
                         tbb::make_filter<void, Rows>(tbb::filter_mode::serial_in_order, read) &
                             tbb::make_filter<Rows, Answers>(
                                 scene.store() ? tbb::filter_mode::serial_in_order : tbb::filter_mode::parallel, work) &
                             tbb::make_filter<Answers, void>(tbb::filter_mode::serial_in_order, put));
  return missing.any(options) ? answer_no : done;
}

constexpr const char* sweep_help =
    R"(Queries come from standard input, one a line; answers go to standard output in the same order:

  in   x,y,z,dx,dy,dz,radius[,half_height]   a header of these names may come first
  out  hit,t,px,py,pz,nx,ny,nz,triangle,feature,distance

The body's centre moves from (x,y,z) by (dx,dy,dz) while t runs from 0 to 1. half_height is half the length of a
vertical capsule's axis; 0, or none, means a sphere. distance is a certified lower bound of the gap between body and
scene: at t for a hit, over the whole motion for a miss; it is at most 10 m. With a store it may be too low
if --memory does not hold the surroundings of the motion. A malformed row ends the program with status 1; the message
names its line.

Unreadable parts of a store are solid: the motion ends there, the feature is `unknown`, the triangle -1, and a note
names the cause. All rows are answered then, with exit status 3.

Examples:
  echo '0,0,1.5,10,0,0,0.3' | roam sweep mine.dae
  roam sweep --lossless gallery.ply < queries.csv > answers.csv
)";

}  // namespace

void add_sweep(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("sweep", "Sweep bodies through a scene: queries and answers as CSV");
  verb->footer(sweep_help);
  const auto options = std::make_shared<SceneOptions>();
  options->add_to(*verb);
  add_web_options(*verb, *verb->get_option("SCENE"), options->web);
  verb->callback([options, &run] { run = [options] { return sweep(*options); }; });
}

}  // namespace roam::app
