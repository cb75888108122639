#pragma once
/// \file
/// Ctrl-C: work that reports progress is cancelled in good order; a later Ctrl-C ends the program at once. A watchdog
/// does the same if good order takes too long: other people's code, such as a graphics driver, reports no progress.

#include <chrono>
#include <functional>
#include <string>

namespace roam::app {

/// The longest time from the signal to the program's end, except for the watchdog's own work and give_time_to_write().
inline constexpr std::chrono::milliseconds longest_good_order{800};

/// Signals within this time of the first one count as the same: `timeout` and shells send one to the program and one to
/// its group.
inline constexpr std::chrono::milliseconds longest_repeat{1000};

/// Catches SIGINT, SIGTERM and SIGHUP from now on. Turns the signals for a closed standard output and for a file that
/// is too large into errors. Ending at once means: end the children, remove the unfinished files (files/unfinished.h),
/// then do the signal's default action.
void catch_signals();

/// Whether a signal has arrived: running work should end.
[[nodiscard]] bool interrupted();

/// 128 + the number of the signal, as shells expect it of a program that a signal ended. Only after interrupted().
[[nodiscard]] int interrupted_status();

/// From now on, the program may take so long to write its results: from the first signal, or from now if that has
/// arrived. A further signal still ends it at once; after 2 s a line says so. Replaces the time given before.
void give_time_to_write(std::chrono::milliseconds longest);
/// For trace, film and report: an encoder ends, and a slow disk takes what was written.
inline constexpr std::chrono::milliseconds longest_writing{120'000};
/// For a picture, which nothing else waits for.
inline constexpr std::chrono::milliseconds longest_drawing{2000};

/// Throws roam::Cancelled if a signal has arrived.
void stop_if_interrupted();

/// Whether there is time to continue work that may end early: no signal arrived, or the first one less than half of
/// longest_good_order ago.
[[nodiscard]] bool has_time();

/// Does work after the main work of a verb, and returns true. If Ctrl-C ends it, says in a note that `otherwise` ("the
/// plan was not drawn"), and returns false.
bool finishes(const std::string& otherwise, const std::function<void()>& work);

}  // namespace roam::app
