#pragma once
/// \file
/// Ctrl-C: work that reports progress is cancelled in good order; a second Ctrl-C ends the program at once. So does a
/// watchdog when good order takes too long: other people's code, such as a graphics driver, reports no progress.

#include <chrono>

namespace roam::app {

/// From the signal to the program's end, at most, but for what the watchdog itself then does.
inline constexpr std::chrono::milliseconds longest_good_order{800};

/// Catches SIGINT, SIGTERM and SIGHUP from now on, and lets a closed standard output, or a file that is too large, be
/// an error instead of a signal. Ending at once is ending the children, removing the unfinished files
/// (files/unfinished.h), and then what the signal does to a program that does not catch it.
void catch_signals();

/// A signal came: what runs should end.
[[nodiscard]] bool interrupted();

/// 128 + the number of the signal, as shells expect it of a program that a signal ended. Only after interrupted().
[[nodiscard]] int interrupted_status();

/// After a signal: the results that are there are being written, which may take longest_writing more. A further signal
/// still ends the program at once.
void give_time_to_write();
inline constexpr std::chrono::milliseconds longest_writing{2000};

/// Throws roam::Cancelled when a signal came.
void stop_if_interrupted();

/// Whether there is time to go on with what ends well when it is ended early: no signal came, or it did less than half
/// of longest_good_order ago.
[[nodiscard]] bool has_time();

}  // namespace roam::app
