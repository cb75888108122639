#pragma once
/// \file
/// The number of this job in an array of jobs of a batch engine.

#include <cstdint>
#include <string>

namespace roam::app {

struct ArrayIndex {
  std::string engine;      ///< "Slurm"
  std::string variable;    ///< the environment variable, with its value: "SLURM_ARRAY_TASK_ID=17"
  std::uint64_t task = 0;  ///< counted from 0, also for engines that count from 1
};

/// The first that the environment names, in this order: Slurm, Grid Engine, PBS, Torque, LSF, AWS Batch, Kubernetes,
/// GNU parallel. Throws UsageError if there is none, or if its value is not a number.
[[nodiscard]] ArrayIndex array_index();

}  // namespace roam::app
