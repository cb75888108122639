#pragma once
/// \file
/// Exceptions: bad input and cancelled work.

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace roam {

/// Unusable input: a setting out of range, an unreadable file, a coordinate that is not a number. what() is text for
/// the user: what is wrong, where, and what to do. A function that throws it has changed nothing, unless its header
/// says so.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;

  /// The message is "where: what", or `what` alone if `where` is empty.
  Error(std::string_view where, std::string_view what) : Error(at(where, joined(where, what))) {}

  /// For a sentence that names the place elsewhere: "cannot read house.obj: No such file or directory".
  [[nodiscard]] static Error at(std::string_view where, const std::string& message) {
    Error error(message);
    if (!where.empty()) error.where_ = std::make_shared<const std::string>(where);
    return error;
  }

  /// The file ("house.obj"), the place in it ("house.obj:3") or the option ("--radius") that is wrong. Empty if there
  /// is none. Valid as long as the error or a copy of it.
  [[nodiscard]] std::string_view where() const noexcept { return where_ ? *where_ : std::string_view(); }

  /// The message without the place and the colon that it may begin with. Valid as long as the error or a copy of it.
  [[nodiscard]] std::string_view reason() const noexcept {
    const std::string_view message = what(), place = where();
    const bool begins = !place.empty() && message.starts_with(place) && message.substr(place.size()).starts_with(": ");
    return begins ? message.substr(place.size() + 2) : message;
  }

 private:
  static std::string joined(std::string_view where, std::string_view what) {
    std::string message(where);
    if (!where.empty()) message += ": ";
    return message += what;
  }

  std::shared_ptr<const std::string> where_;  ///< shared, so that copying throws nothing
};

/// Thrown by work that its progress callback cancelled. Not an Error.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace roam
