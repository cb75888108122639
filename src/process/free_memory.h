#pragma once
/// \file
/// The machine's free memory.

#include <cstdint>
#include <optional>

namespace roam::process {

/// Bytes that programs can take before the machine has to swap or to end one; none if the system cannot say.
[[nodiscard]] std::optional<std::uint64_t> free_memory();

}  // namespace roam::process
