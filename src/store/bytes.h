#pragma once
/// \file
/// The source of a store's bytes: a folder, a web server, or in tests something else.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "roam/store.h"

namespace roam::store {

/// Its functions are called from any thread at any time.
class StoreBytes {
 public:
  virtual ~StoreBytes() = default;
  /// Reads a small file, such as "CURRENT". Throws roam::Error if it cannot be read or is larger than `limit` bytes.
  [[nodiscard]] virtual std::vector<std::byte> whole(const std::string& file, std::uint64_t limit) = 0;
  /// Fills `out` with a file's bytes from `offset` on; the file is one such as "packs/<64 digits>.pack". Returns null,
  /// or the reason of the failure as a text of static lifetime. `stop` ends a read that waits for the network. Does not
  /// throw; a folder does not allocate from the second read of a file on. A pager treats an exception as a failure.
  /// Caches are not used.
  [[nodiscard]] virtual const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out,
                                         const std::stop_token& stop) = 0;
  [[nodiscard]] const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out) {
    return read(file, offset, out, {});
  }
  /// read() of bytes that must have this XXH3, or a failure. They may come from a cache, and be kept there.
  [[nodiscard]] virtual const char* read_checked(const std::string& file, std::uint64_t offset,
                                                 std::span<std::byte> out, std::uint64_t hash,
                                                 const std::stop_token& stop);
  /// Number of reads that are best made at once.
  [[nodiscard]] virtual int best_at_once() const { return 1; }
};

/// Store::open of such a source.
[[nodiscard]] std::shared_ptr<const Store> open_store(std::shared_ptr<StoreBytes> bytes, const std::string& name,
                                                      std::uint64_t memory = Store::usual_memory);

}  // namespace roam::store
