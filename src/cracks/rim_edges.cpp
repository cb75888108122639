#include "cracks/rim_edges.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <glm/geometric.hpp>
#include <mutex>
#include <vector>

#include "cracks/shared_edges.h"
#include "cracks/voids.h"
#include "math/threads.h"

namespace roam::cracks {
namespace {

/// The phase after those of SharedEdges.
constexpr int last_phase = SharedEdges::phases;
/// Floors between two calls of `goes_on`: some milliseconds of work.
constexpr std::size_t edges_of_a_block = 2048;
/// Places at edges between two calls of `goes_on`, where edges are long.
constexpr double places_together = 32768.0;

}  // namespace

/// Shared, because a core may run a piece after the end of the RimEdges.
struct RimEdges::State {
  State(const Survey& of, const CrackOptions& how, std::size_t together)
      : survey(&of), probe(of, how), shared(of), options(how), floors_together(together) {}

  const Survey* survey;
  const VoidProbe probe;
  SharedEdges shared;
  const CrackOptions options;
  const std::size_t floors_together;
  std::vector<std::uint8_t> edges;  ///< set in the last phase
  int phase = 0;                    ///< of the next piece; last_phase + 1 when all is done
  std::size_t piece = 0;
  std::size_t looked_at = 0;       ///< floors
  std::mutex mutex;                ///< held while a piece is done ahead
  std::atomic<bool> ended{false};  ///< set before the mutex is taken, so that a piece being done ends soon

  [[nodiscard]] std::size_t pieces(int of_phase) const {
    if (of_phase < last_phase) return shared.pieces(of_phase);
    return (survey->floor_triangles().size() + floors_together - 1) / floors_together;
  }
  [[nodiscard]] std::size_t pieces() const { return pieces(phase); }
  void look_at(std::size_t block) {
    const auto floors = survey->floor_triangles();
    const std::size_t end = std::min(floors.size(), (block + 1) * floors_together);
    for (std::size_t f = block * floors_together; f < end; ++f) {
      edges[f] = edges_without_void(probe, options, survey->triangle(floors[f]), edges[f], ended);
      if (ended) return;
      looked_at = f + 1;
    }
  }
  void next_phase() {
    piece = 0;
    if (++phase == last_phase) edges = shared.take();
  }
  /// Does the next piece. Returns false if there is none.
  bool do_ahead() {
    const std::lock_guard lock(mutex);
    if (ended) return false;
    try {
      while (phase <= last_phase && piece == pieces()) next_phase();
      if (phase > last_phase) return false;
      phase < last_phase ? shared.run(phase, piece) : look_at(piece);
      ++piece;
      return true;
    } catch (const std::exception&) {
      ended = true;  // look_at_all() repeats the work and reports the error
      return false;
    }
  }
  void end() {
    ended = true;
    const std::lock_guard lock(mutex);
  }
  /// Places to examine at the edges of a floor, at most.
  [[nodiscard]] double work(std::size_t floor) const {
    const Triangle t = survey->triangle(survey->floor_triangles()[floor]);
    double places = 0.0;
    for (std::size_t k = 0; k < 3; ++k) places += rim_places(glm::distance(t[k], t[(k + 1) % 3]), options.smallest);
    return places;
  }
};

RimEdges::RimEdges(const Survey& survey, const CrackOptions& options, int floors_together)
    : state_(std::make_shared<State>(survey, options, static_cast<std::size_t>(floors_together))) {}

RimEdges::~RimEdges() noexcept { state_->end(); }

const CrackOptions& RimEdges::options() const { return state_->options; }

void RimEdges::look_ahead() {
  if (available_threads() < 2) return;
  std::size_t pieces = 0;
  for (int phase = 0; phase <= last_phase; ++phase) pieces += state_->pieces(phase);
  tbb::task_arena arena(1, 0, tbb::task_arena::priority::low);
  for (std::size_t i = 0; i < pieces; ++i) arena.enqueue([state = state_] { state->do_ahead(); });
}

bool RimEdges::look_ahead_here() { return state_->do_ahead(); }

bool RimEdges::look_at_all(const Look& look, const std::function<bool(double)>& goes_on) {
  State& s = *state_;
  s.end();
  for (; s.phase < last_phase; s.next_phase())
    tbb::parallel_for(s.piece, s.pieces(), [&](std::size_t piece) { s.shared.run(s.phase, piece); });
  const std::size_t blocks = (s.edges.size() + edges_of_a_block - 1) / edges_of_a_block;
  std::atomic<bool> is_ended{false};
  std::mutex progress;
  std::size_t done = 0;
  const auto report = [&](std::size_t more) {
    if (!goes_on) return;
    const std::lock_guard lock(progress);
    done += more;
    if (!is_ended && !goes_on(double(done) / double(blocks))) is_ended = true;
  };
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t end = std::min((block + 1) * edges_of_a_block, s.edges.size());
    double places = 0.0;
    for (std::size_t f = block * edges_of_a_block; f < end && !is_ended; ++f) {
      look(f, s.edges[f], f < s.looked_at);
      places += s.work(f);
      if (places < places_together) continue;
      places = 0.0;
      report(0);
    }
    if (!is_ended) report(1);
  });
  if (!is_ended) s.looked_at = s.edges.size();
  return !is_ended;
}

}  // namespace roam::cracks
