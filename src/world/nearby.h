#pragma once
/// \file
/// Queries of a body that keeps what lies around it.

#include <memory>

#include "roam/space.h"

namespace roam {

/// The part of a space's index that lies around a body, so that a body which asks again from nearly the same place need
/// not look for it again (Nearby). Where a query leads out of it, is asked of another space or comes after a
/// change, it is gathered anew; a body that looks or goes far at once is answered by the whole index. So it is for one
/// body that moves by a part of its size at a time: bodies that take turns want one each, and so do threads.
///
/// Takes 1.7 kB when it is made and no more memory after that. A copy goes on as the original would have. One that was
/// moved from may be assigned to or destroyed, and is as good as none where it is asked in.
class Vicinity {
 public:
  Vicinity();
  ~Vicinity();
  Vicinity(const Vicinity& other);
  Vicinity(Vicinity&&) noexcept;
  Vicinity& operator=(const Vicinity& other);
  Vicinity& operator=(Vicinity&&) noexcept;

  /// As when it was made. Only the same bits again need it, for they depend on what was asked before.
  void forget();

  struct State;
  /// For the spaces of this library; null when it was moved from.
  [[nodiscard]] State* state() { return state_.get(); }

 private:
  std::unique_ptr<State> state_;
};

/// Space::sweep() and gap() for a body that asks again from near where it asked last: the same promises, and in a World
/// or a Pager less to look at. Within what they leave open an answer may be another, for it depends on where a search
/// begins: a hit by the 0.025 mm by which a body may arrive before it touches, along a flat way by more, a gap by the
/// part by which it may be too small. The same queries in the same order, from an equal vicinity on and while the
/// revision is the same, get the same bits.
///
/// Walker makes no sweep along a way of which the gap exceeds 0.05 mm. That the body passes nothing rests on the gap
/// then as it does on the sweep.
struct Nearby {
  [[nodiscard]] static Impact sweep(const Space& space, Vicinity& vicinity, const Query& query);
  [[nodiscard]] static double gap(const Space& space, Vicinity& vicinity, const Query& query, double reach);
};

}  // namespace roam
