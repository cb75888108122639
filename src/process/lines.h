#pragma once
/// \file
/// Lines of text from a child.

#include <chrono>
#include <optional>
#include <string>

#include "files/descriptor.h"

namespace roam::process {

/// A pipe through which a child writes lines.
///
///     Lines lines;
///     Child child(program, arguments, {.descriptors = {{lines.theirs(), STDOUT_FILENO}}});
///     lines.child_has_started();
///     while (!lines.ended()) {
///       if (const auto line = lines.next(100ms)) ...
///     }
///
/// Only one thread at a time may call a member.
class Lines {
 public:
  /// Throws roam::Error if the system has no descriptors left.
  Lines();

  /// The end that the child writes to. Valid until child_has_started().
  [[nodiscard]] int theirs() const { return theirs_.number(); }
  /// Closes this process's copy of that end, so that the lines end with the child.
  void child_has_started() { theirs_.close(); }
  /// The next line, without its line end, or nothing if none is complete within `longest`. Text without a line end
  /// before the end is not a line.
  [[nodiscard]] std::optional<std::string> next(std::chrono::milliseconds longest);
  /// Whether next() has reached the end: nothing holds the other end of the pipe any more.
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  files::Descriptor ours_, theirs_;
  std::string text_;  ///< received, not yet returned
  bool ended_ = false;
};

}  // namespace roam::process
