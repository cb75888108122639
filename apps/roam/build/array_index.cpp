#include "build/array_index.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "cli/exit_status.h"

namespace roam::app {
namespace {

struct Engine {
  const char* name;
  const char* variable;
  std::uint64_t first;    ///< the number of an array's first job
  std::string_view none;  ///< the value outside of arrays, if the variable is set there, too
};

constexpr Engine engines[] = {
    {"Slurm", "SLURM_ARRAY_TASK_ID", 0, ""},
    {"Grid Engine", "SGE_TASK_ID", 1, "undefined"},
    {"PBS", "PBS_ARRAY_INDEX", 0, ""},
    {"Torque", "PBS_ARRAYID", 0, ""},
    {"LSF", "LSB_JOBINDEX", 1, "0"},
    {"AWS Batch", "AWS_BATCH_JOB_ARRAY_INDEX", 0, ""},
    {"Kubernetes", "JOB_COMPLETION_INDEX", 0, ""},
    {"GNU parallel", "PARALLEL_SEQ", 1, ""},
};

std::string names() {
  std::string list;
  for (const Engine& engine : engines) list += fmt::format("{}{}", list.empty() ? "" : ", ", engine.variable);
  return list;
}

}  // namespace

ArrayIndex array_index() {
  for (const Engine& engine : engines) {
    const char* set = std::getenv(engine.variable);
    const std::string_view text = set != nullptr ? set : "";
    if (text.empty() || text == engine.none) continue;
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < engine.first) {
      throw UsageError("--shard auto",
                       fmt::format("{} is '{}', not a whole number from {}; give the number of the task "
                                   "instead of auto",
                                   engine.variable, text, engine.first));
    }
    return {engine.name, fmt::format("{}={}", engine.variable, text), number - engine.first};
  }
  throw UsageError("--shard auto", fmt::format("this is no job of an array: none of {} is set; give the number of the "
                                               "task instead of auto",
                                               names()));
}

}  // namespace roam::app
