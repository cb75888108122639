#pragma once
/// \file
/// Names of objects, found out by a loading thread for whoever asks again.

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
  /// The name, or "" when it is not known yet: then a loading thread is asked. Never waits.
  [[nodiscard]] std::string ask(TriangleId triangle);
  /// Finds out one name that was asked for. What `find` cannot tell is asked for again when somebody asks, but not at
  /// once. For loading threads.
  void serve(const std::function<std::optional<std::string>(TriangleId)>& find);

 private:
  struct Entry {
    TriangleId triangle = 0;
    std::string name;
    std::uint64_t asked = 0;  ///< when last, counted; 0: never
    bool wanted = false;
    std::chrono::steady_clock::time_point again{};  ///< when it may be tried again; 0: nothing is wrong
  };
  [[nodiscard]] Entry* entry_of(TriangleId triangle);

  std::mutex mutex_;
  std::array<Entry, 64> entries_;
  std::uint64_t count_ = 0;
};

}  // namespace roam::paging
