#pragma once
/// \file
/// Reads that begin before their bytes are needed, several at once, where the source of the bytes is far away.

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <list>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "store/bytes.h"

namespace roam::store {

/// The failure of bytes that came, and are not those that were written.
inline constexpr const char* wrong_checksum = "its checksum is wrong";

/// A range of a file, and its XXH3. Without that it is neither checked nor taken from caches.
struct CheckedRange {
  std::string file;
  std::uint64_t offset = 0, bytes = 0;
  std::optional<std::uint64_t> hash{};
  bool operator==(const CheckedRange&) const = default;
};

/// For one thread. Keeps the bytes of a few dozen tiles at most.
class ReadAhead {
 public:
  explicit ReadAhead(StoreBytes& bytes) : bytes_(bytes) {}
  /// Ends reads in progress.
  ~ReadAhead();
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// Whether begin() does anything now: not for a folder, and not while enough reads wait to be taken.
  [[nodiscard]] bool has_room() const;
  void begin(const CheckedRange& range);

  struct Result {
    std::vector<std::byte> bytes;
    const char* problem = nullptr;
  };
  /// The result of a read; begins it now if it has not begun, and `stop` ends it then. Rethrows its exception.
  [[nodiscard]] Result take(const CheckedRange& range, const std::stop_token& stop);

 private:
  /// Reads begun for each that is best made at once: some must be ready to start when these end.
  static constexpr int depth = 4;

  struct Read {
    CheckedRange range;
    Result result{};
    std::exception_ptr thrown{};
    bool begun = false, done = false;
  };
  void run();
  void read(Read& one, const std::stop_token& stop) const;

  StoreBytes& bytes_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::list<Read> reads_;  ///< under the mutex
  std::stop_source ending_;
  std::vector<std::jthread> threads_;
};

}  // namespace roam::store
