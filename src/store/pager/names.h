#pragma once
/// \file
/// A cache of object names, of which it keeps the first KiB. Another thread finds missing ones, for later calls.

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "roam/space.h"

namespace roam::paging {

class Names {
 public:
  enum class Kind { object, reason };  ///< the object of a triangle; the reason why a place is unknown

  /// The name, or "" if it is not known yet; then another thread finds it. Never waits.
  [[nodiscard]] std::string ask(TriangleId triangle);
  /// Calls `find` for the newest wanted name; returns false if none is wanted. If `find` returns nothing, a later ask()
  /// tries again, but not at once.
  bool serve(Kind kind, const std::function<std::optional<std::string>(TriangleId)>& find);

 private:
  struct Entry {
    TriangleId triangle = 0;
    std::string name;
    std::uint64_t asked = 0;  ///< a counter: the last call of ask() for it; 0: never
    bool wanted = false;
    std::chrono::steady_clock::time_point again{};  ///< when to try again; 0: the last try did not fail
  };
  [[nodiscard]] Entry* entry_of(TriangleId triangle);

  std::mutex mutex_;
  std::array<Entry, 64> entries_;
  std::uint64_t count_ = 0;
};

}  // namespace roam::paging
