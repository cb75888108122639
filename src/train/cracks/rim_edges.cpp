#include "train/cracks/rim_edges.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <mutex>

#include "train/cracks/shared_edges.h"
#include "train/cracks/voids.h"

namespace roam::training {
namespace {

/// Floors that are looked at together: some milliseconds of work, most edges are inside a floor.
constexpr std::size_t block_floors = 4096;
/// After those of SharedEdges.
constexpr int last_phase = SharedEdges::phases;

}  // namespace

/// Outlives a RimEdges where a core comes to a piece too late.
struct RimEdges::State {
  State(const Survey& of, const CrackOptions& how) : survey(&of), probe(of, how), shared(of), options(how) {}

  const Survey* survey;
  const VoidProbe probe;
  SharedEdges shared;
  const CrackOptions options;
  std::vector<std::uint8_t> edges;  ///< from the last phase on
  int phase = 0;                    ///< the next piece, last_phase + 1: all is done
  std::size_t piece = 0;
  std::size_t looked_at = 0;  ///< floors
  std::mutex mutex;           ///< held while a piece is done ahead
  bool ended = false;

  [[nodiscard]] std::size_t pieces() const {
    if (phase < last_phase) return shared.pieces(phase);
    return (survey->floor_triangles().size() + block_floors - 1) / block_floors;
  }
  void look_at(std::size_t block) {
    const auto floors = survey->floor_triangles();
    const std::size_t end = std::min(floors.size(), (block + 1) * block_floors);
    for (std::size_t f = block * block_floors; f < end; ++f)
      edges[f] = edges_without_void(probe, options, survey->triangle(floors[f]), edges[f]);
    looked_at = end;
  }
  void next_phase() {
    piece = 0;
    if (++phase == last_phase) edges = shared.take();
  }
  /// The next piece.
  void do_ahead() {
    const std::lock_guard lock(mutex);
    if (ended) return;
    try {
      while (phase <= last_phase && piece == pieces()) next_phase();
      if (phase > last_phase) return;
      phase < last_phase ? shared.run(phase, piece) : look_at(piece);
      ++piece;
    } catch (const std::exception&) {
      ended = true;  // who asks does it again, and is told
    }
  }
  void end() {
    const std::lock_guard lock(mutex);
    ended = true;
  }
};

RimEdges::RimEdges(const Survey& survey, const CrackOptions& options)
    : state_(std::make_shared<State>(survey, options)) {}

RimEdges::~RimEdges() noexcept { state_->end(); }

const CrackOptions& RimEdges::options() const { return state_->options; }

void RimEdges::look_ahead() {
  if (tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) < 2) return;
  std::size_t pieces = 0;
  for (int phase = 0; phase < last_phase; ++phase) pieces += state_->shared.pieces(phase);
  pieces += state_->survey->floor_triangles().size() / block_floors + 1;
  tbb::task_arena arena(1, 0, tbb::task_arena::priority::low);
  for (std::size_t i = 0; i < pieces; ++i) arena.enqueue([state = state_] { state->do_ahead(); });
}

std::vector<std::uint8_t>& RimEdges::without_void() {
  State& s = *state_;
  s.end();
  for (; s.phase < last_phase; s.next_phase())
    tbb::parallel_for(s.piece, s.pieces(), [&](std::size_t piece) { s.shared.run(s.phase, piece); });
  return s.edges;
}

std::size_t RimEdges::looked_at() const { return state_->looked_at; }
void RimEdges::set_all_looked_at() { state_->looked_at = state_->edges.size(); }

}  // namespace roam::training
