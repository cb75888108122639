#pragma once
/// \file
/// A connection to the X server, between one window and the next.

#include <memory>

namespace roam::graphics {

/// An X server resets when its last client leaves, and accepts no client meanwhile. This keeps a connection to the
/// display that the environment variable DISPLAY names, if there is one.
class DisplayHold {
 public:
  DisplayHold();
  ~DisplayHold();
  DisplayHold(const DisplayHold&) = delete;
  DisplayHold& operator=(const DisplayHold&) = delete;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace roam::graphics
