#pragma once
/// \file
/// No part of the interface: what a Walker keeps of the space around it, from one step to the next.

#include <memory>

namespace roam {

/// The part of a space's index that lies around a body, so that a body which asks again from nearly the same place need
/// not look for it again (world/nearby.h). Where a query leads out of it, is asked of another space or comes after a
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

}  // namespace roam
