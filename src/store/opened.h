#pragma once
/// \file
/// Store::State: an open store, for rooms that read tiles and pages themselves.

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "roam/store.h"
#include "store/bytes.h"
#include "store/manifest.h"
#include "store/page.h"

namespace roam {

struct Store::State {
  /// A page of the index; stored_id uses the same number.
  struct Page {
    std::uint32_t shard = 0;
    store::PageRef ref;
  };

  std::string name;
  std::shared_ptr<store::StoreBytes> bytes;
  store::Manifest manifest;
  StoreInfo info;
  std::vector<Page> pages;
  std::vector<std::string> packs;                  ///< file of each shard, as store::StoreBytes names it
  std::map<std::uint64_t, std::uint32_t> part_of;  ///< number of the part for each part hash, see SourceNumber
  std::uint64_t memory = 0;                        ///< greatest number of bytes of all of this, including `recent`
  std::vector<std::uint64_t> first;                ///< for each part, the number of its first triangle in the scene

  /// A small cache for reports. Guarded by the mutex.
  struct Recent;
  mutable std::mutex mutex;
  mutable std::unique_ptr<Recent> recent;

  State();
  ~State();
};

namespace store {

/// Store::source. Throws Cancelled soon after `stop` is requested.
[[nodiscard]] SourceTriangle find_source(const Store::State& s, TriangleId triangle, const std::stop_token& stop);

/// view_page of a page of a store, which must also be the one that the manifest describes: whoever chooses pages by the
/// manifest finds all its tiles, and whoever chooses tiles by their boxes and masks all that they hold. Null, or why it
/// is not. Never allocates.
[[nodiscard]] const char* view_page_of(const Store::State& s, std::uint64_t number, std::span<const std::byte> bytes,
                                       PageView& view);

}  // namespace store
}  // namespace roam
