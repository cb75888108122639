#pragma once
/// \file
/// Queries of a body that keeps the part of the index around it.

#include <memory>

#include "roam/space.h"

namespace roam {

/// The part of a space's index around a body. It saves a body that queries again from nearly the same position most of
/// the search (Nearby). It maintains itself: it is gathered anew when a query leaves it, uses another space, or follows
/// a change. Long queries bypass it. So it suits one body that moves by a part of its size at a time: each body and
/// each thread needs its own.
///
/// It takes 1.7 kB when made and no more memory after that. A copy continues like the original. After a move the source
/// may be assigned to or destroyed; queries with it use the whole index.
class Vicinity {
 public:
  Vicinity();
  ~Vicinity();
  Vicinity(const Vicinity& other);
  Vicinity(Vicinity&&) noexcept;
  Vicinity& operator=(const Vicinity& other);
  Vicinity& operator=(Vicinity&&) noexcept;

  /// Resets to the state of a new vicinity. Needed only to get the same bits again, because these depend on earlier
  /// queries.
  void forget();

  struct State;
  /// For the spaces of this library; null after a move.
  [[nodiscard]] State* state() { return state_.get(); }

 private:
  std::unique_ptr<State> state_;
};

/// Space::sweep() and gap_bound() for a body that queries again from near its last query. The guarantees are the same,
/// and a World or a Pager has less to search. Results depend on where a search begins, so they may differ within the
/// tolerances. A hit may differ by 0.025 mm, the distance at which a body may arrive before it touches; by more along a
/// grazing motion. A gap may differ by the part by which it may be too small. The same queries in the same order give
/// the same bits, if they begin with an equal vicinity and the revision stays the same.
///
/// Walker makes no sweep along a way whose gap exceeds 0.05 mm. Such a gap alone then guarantees that the body passes
/// through nothing.
struct Nearby {
  [[nodiscard]] static Impact sweep(const Space& space, Vicinity& vicinity, const Query& query);
  [[nodiscard]] static double gap_bound(const Space& space, Vicinity& vicinity, const Query& query, double reach);
};

}  // namespace roam
