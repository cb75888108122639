#pragma once
/// \file
/// Planned ways are confirmed by the real Walker: a lattice cannot know all that one climbs, or where one slides off.

#include "training/interval.h"
#include "training/layout.h"
#include "training/stages.h"
#include "ways/trials/trials.h"

namespace roam::training {

/// On foot, for the interval. Sends the body that comes of the paths and the cracks along each of them, and back over
/// gaps whose far rim is lower. Where that is stopped or falls at a crack that a larger body or one on a foot goes
/// over, these are tried first: what is asked for is kept in Evidence::carried. Where it is still, the lattice is shut
/// and the way is planned again, round that place; where no way is left the path is taken out and told
/// (Layout::unwalked), and others are drawn in its stead, once.
void confirm_paths(const Survey& survey, const TrainOptions& options, const ways::BodyKind& kind, Evidence& evidence,
                   Layout& layout, Stages& stages);

}  // namespace roam::training
