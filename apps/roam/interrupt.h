#pragma once
/// \file
/// Ctrl-C: work that reports progress is cancelled in good order; a second Ctrl-C ends the program at once.

namespace roam::app {

/// Catches SIGINT and SIGTERM from now on, and lets a closed standard output be an error instead of a signal.
void catch_signals();

/// A signal came: what runs should end.
[[nodiscard]] bool interrupted();

/// Throws roam::Cancelled when a signal came.
void stop_if_interrupted();

}  // namespace roam::app
