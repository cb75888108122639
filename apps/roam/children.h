#pragma once
/// \file
/// The processes that this one has started, whoever in it did.

#include <chrono>

namespace roam::app {

/// Asks all children to end, and kills those that have not after `grace`.
void end_children(std::chrono::milliseconds grace);

}  // namespace roam::app
