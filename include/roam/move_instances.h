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
  double time = 0.0;       ///< seconds that it did move, < dt
};

/// Moves every instance by its velocity for `dt` seconds (finite, >= 0), one after the other in the order in which they
/// were added. Call it before the walkers' steps of the same `dt`. An instance that is to stop at a place gets a
/// smaller velocity for the last call.
///
/// | a body that | |
/// |---|---|
/// | stands on it (Stance::object) | goes along in every direction, as far as the rest of the scene lets it |
/// | is in its way | is pushed along; it does not crouch |
/// | has nowhere to go | stops the instance, and is named in the list that is returned |
/// | has left it and is in the air | keeps the velocity of that ground until it lands |
/// | is a ghost, or is held | is not moved, and stops nothing |
///
/// An instance that was stopped keeps its velocity and tries again at the next call. Bodies do not meet each other.
/// Pass all bodies: one that is left out is run over. Make one instance of what moves together, or add what goes in
/// front first.
///
/// The promises of walker.h hold all the while: at every instant each body's axis is at least radius - 1e-6 m from
/// every triangle, those of the instance that moves included. A walker that was moved has this movement as its
/// report(): read it before the next step() overwrites it. Any other keeps its old report. `walkers` must move in
/// `instances`, or in a Filtered of them; null is passed over.
///
/// A turn is made in small straight parts, mostly 0.02 mm off the arc at most (docs/walking.md, "What moves"). Throws
/// roam::Error for a `dt` that is not finite or negative; then nothing has moved.
std::vector<Stopped> move_instances(Instances& instances, std::span<Walker* const> walkers, double dt);

}  // namespace roam
