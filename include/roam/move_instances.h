#pragma once
/// \file
/// Movement of instances, with the bodies that they carry and push.

#include <cstddef>
#include <span>
#include <vector>

#include "roam/instances.h"
#include "roam/walker.h"

namespace roam {

/// An instance that a body stopped.
struct Stopped {
  ObjectId instance = no_object;
  std::size_t walker = 0;  ///< index of the body in `walkers`
  double time = 0.0;       ///< seconds that the instance moved, < dt
};

/// Moves each instance by its velocity for `dt` seconds, in the order added, and returns those that had to stop. Call
/// it before the walkers' steps of the same `dt`. To reach a position, set a smaller velocity for the last call.
///
/// | a body that | |
/// |---|---|
/// | stands on the instance (Stance::object) | goes along in every direction, as far as the rest of the scene allows |
/// | is in its way | is pushed along, without crouching |
/// | has nowhere to go | stops the instance |
/// | has left it and is in the air | keeps the velocity of that ground until it lands |
/// | is a ghost, or is held | is not moved, and stops nothing |
///
/// A stopped instance tries again at the next call. Pass all bodies: an instance runs over any that is left out. Make
/// things that move together one instance, or add the front one first; see docs/walking.md, "What moves". The promises
/// of walker.h hold meanwhile, for the triangles of the moving instance too. A walker that was moved has this movement
/// as its report() until its next step(); any other keeps its old report. The report's clearances also hold for
/// instances that only pass; they may then be lower than Segment promises, by the bend of a turning instance's way.
///
/// `walkers` must move in `instances` or in a Filtered of them; null is skipped. Throws roam::Error, and moves nothing,
/// for any other walker, a walker that is listed twice, a `dt` that is negative or not finite, and an instance that
/// would move beyond coordinate_limit. After std::bad_alloc some have moved, each with its bodies, and others have not.
std::vector<Stopped> move_instances(Instances& instances, std::span<Walker* const> walkers, double dt);

}  // namespace roam
