// The body of one search, and its widest way.
#include "ways/probe/parts.h"

#include <algorithm>

#include "roam/error.h"
#include "roam/passage.h"

namespace roam::ways {

Measure ProbeSearch::measure() const {
  Measure measure{options.mode,      options.mode == Mode::fly ? 0.0 : options.height,
                  options.step,      options.widest,
                  options.narrowest, options.support_max};
  // As widest_way() begins; it lowers a sphere's step to its radius.
  if (measure.mode == Mode::walk && measure.height == 0.0) measure.step = std::min(measure.step, measure.widest);
  return measure;
}

Passage ProbeSearch::widest() const {
  PassageOptions watched = options;
  bool wanted = true;
  watched.progress = [&](std::uint64_t places) { return wanted = !question.progress || question.progress(places); };
  Passage passage = widest_way(survey, question.from, question.to, watched);
  if (!wanted) throw Cancelled();
  return passage;
}

}  // namespace roam::ways
