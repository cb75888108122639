#pragma once
/// \file
/// The movement of instances, with the bodies that they carry and push.

#include <cstddef>
#include <span>
#include <vector>

#include "roam/instances.h"
#include "roam/walker.h"

namespace roam {

/// An instance that had to stop, because a body was in its way and had nowhere to go.
struct Stopped {
  ObjectId instance = no_object;
  std::size_t walker = 0;  ///< index of the body in the list that was passed
  double time = 0.0;       ///< seconds that the instance moved, less than was asked for
};

/// Moves every instance by its velocity for `dt` seconds (finite, >= 0), one after the other in the order in which they
/// were added. Call it before the walkers' steps of the same `dt`.
///
/// A body that stands on an instance (Stance::object) goes along with it, up, down and sideways, as far as the rest of
/// the scene lets it. A body in its way is pushed along. A body that has nowhere to go stops the instance; the list
/// that is returned names it. A body in the air that has left a moving instance keeps that velocity until it lands
/// (Stance::velocity). Ghosts and held bodies are not moved, and stop nothing.
///
/// Between any two bodies' and instances' movements the promises of walker.h hold: at every instant of the way each
/// body's axis is at least radius - 1e-6 m from every triangle, of instances that move as well. The walker's report()
/// is that of this way; a walker that nothing moved keeps the report that it has. `walkers` must move in `instances`,
/// or in a Filtered of them; null is passed over.
///
/// Turning is divided into parts, of which a body sees the chord of its way (0.02 mm beside the arc at most). Throws
/// roam::Error for a `dt` that is not finite or negative; then nothing has moved.
std::vector<Stopped> advance(Instances& instances, std::span<Walker* const> walkers, double dt);

}  // namespace roam
