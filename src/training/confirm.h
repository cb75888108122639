#pragma once
/// \file
/// Planned ways are confirmed by the real Walker: a lattice cannot know every step that a body climbs or slope that it
/// slides down.

#include "training/interval.h"
#include "training/layout.h"
#include "training/stages.h"
#include "ways/trials/trials.h"

namespace roam::training {

/// On foot, for the interval. Sends the body that body_of_paths() gives along each path, and back over gaps whose far
/// rim is lower. If it is stopped or falls at a crack, a larger body, or one with a support disc, is tried first;
/// Evidence::carried_radius keeps the radius needed. If that fails, the lattice is closed at that place and the way is
/// planned again. If no way is left, the path moves to Layout::unwalked, and other paths are drawn instead, once.
void confirm_paths(const Survey& survey, const TrainOptions& options, const ways::BodyKind& kind, Evidence& evidence,
                   Layout& layout, Stages& stages);

}  // namespace roam::training
