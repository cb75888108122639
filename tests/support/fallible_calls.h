#pragma once
/// \file
/// A table of calls of the library, each of whose allocations fails in turn.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "counted_allocations.h"
#include "roam/error.h"
#include "roam/math.h"

/// The bits of a result. Writing them takes no allocation that is counted.
class Bits {
 public:
  template <class T>
  Bits& operator<<(const T& value) {
    const Spare spare;
    if constexpr (std::is_convertible_v<T, std::string>) {
      text_ += value;
      text_ += '\0';
    } else {
      static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T> ||
                    std::is_same_v<T, roam::Vec3>);
      text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    return *this;
  }
  operator std::string() { return std::move(text_); }  // NOLINT: a result

 private:
  std::string text_;
};

/// The bits of the sentence by which a call is refused; empty if it is not.
template <class Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const roam::Error& error) {
    return Bits() << error.what();
  }
  return {};
}

struct FallibleCall {
  const char* name;
  std::function<std::string()> bits;            ///< makes the call, and returns the bits of its result
  std::function<void(bool failed)> after = {};  ///< judges the state that the call leaves
  bool later = false;                           ///< other threads may hold memory of it for long
  bool throws = true;                           ///< false: it succeeds although memory ran out
  long dense = 100;  ///< so many first allocations fail one by one, later ones in steps that grow
  long steps = 16;   ///< of these for each doubling, about
  long most = std::numeric_limits<long>::max();  ///< later ones do not fail
};

/// Makes a call with an allocation that fails, and perhaps all later ones. Returns nothing if it throws.
inline std::optional<std::string> with_failing(const FallibleCall& call, long failing, bool on) {
  std::optional<std::string> result;
  std::string other;
  allocations = 0;
  failing_on = on;
  failing_allocation = failing;
  try {
    result = call.bits();
  } catch (const std::bad_alloc&) {
  } catch (const roam::Error& error) {
    failing_allocation = 0;
    other = error.what();
  }
  failing_allocation = 0;
  failing_on = false;
  if (!other.empty()) ADD_FAILURE() << other;
  return result;
}

/// Allocations and open files that this process holds.
inline long held() {
  const Spare spare;
  const auto files = std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
  return held_allocations + static_cast<long>(files);
}

/// Lets the allocations of each call fail in turn, alone and with all that follow. It must throw, or have the result
/// that it always has, hold no memory and file of a failed call, and have that result again in the end. At least one
/// failure must make it throw, unless its `throws` is false.
inline void fail_calls(const std::vector<FallibleCall>& calls) {
  for (const FallibleCall& call : calls) {
    SCOPED_TRACE(call.name);
    const std::string expected = call.bits();
    if (call.after) call.after(false);
    bool allocates = false, threw = false;
    for (const bool on : {false, true}) {
      for (long failing = 1, beyond = 0; beyond < (failing > call.dense ? 1 : 3) && failing <= call.most;
           failing += 1 + std::max(0L, failing - call.dense) / call.steps) {
        SCOPED_TRACE(std::to_string(failing) + (on ? " and all that follow" : ""));
        // A call may keep memory for the next one, but not more each time.
        for (int again = 0; again < 3; ++again) {
          const long before = held();
          const std::optional<std::string> result = with_failing(call, failing, on);
          if (again == 0) {
            beyond = allocations < failing ? beyond + 1 : 0;
            allocates = allocates || allocations >= failing;
            threw = threw || !result;
          }
          if (result) {
            ASSERT_EQ(*result, expected);
          }
          if (call.after) call.after(!result);
          if (testing::Test::HasFailure()) return;
          if (result || call.later) break;
          // Another thread may have to free some.
          for (int ms = 0; held() > before && ms < 300; ++ms) std::this_thread::sleep_for(std::chrono::milliseconds(1));
          if (held() <= before) break;
          ASSERT_LT(again, 2) << held() - before << " allocations or files are held";
        }
      }
    }
    EXPECT_TRUE(allocates);
    EXPECT_EQ(threw, call.throws);
    ASSERT_EQ(call.bits(), expected);
    if (call.after) call.after(false);
  }
}
