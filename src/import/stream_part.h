#pragma once
/// \file
/// Reading of one part of a scene, as stream_part() does, within a budget of all parts.

#include "import/processor_budget.h"
#include "roam/import.h"

namespace roam::reader {

/// `scene`: that of all parts, which may be read at once.
ImportReport stream_part_within(SceneBudget& scene, const ScenePart& part, const ImportOptions& options,
                                const PieceSink& sink, const LookUpSink& look_ups);

}  // namespace roam::reader
