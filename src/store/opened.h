#pragma once
/// \file
/// A store that is open: what Store::state() is, for the rooms that read tiles and pages themselves.

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "roam/store.h"
#include "store/manifest.h"

namespace roam {

struct Store::State {
  /// A page of the index, numbered as stored_id numbers it.
  struct Page {
    std::uint32_t shard = 0;
    store::PageRef ref;
  };

  std::string name;
  std::shared_ptr<StoreBytes> bytes;
  store::Manifest manifest;
  StoreInfo info;
  std::vector<Page> pages;
  std::vector<std::string> packs;                  ///< file of each shard, as StoreBytes names it
  std::map<std::uint64_t, std::uint32_t> part_of;  ///< part hash to number, see SourceNumber
  std::uint64_t memory = 0;                        ///< bytes that all of this takes at most, what is recent included
  std::vector<std::uint64_t> first;                ///< number in the scene of each part's first triangle

  /// What reports have read, a little of it. Under the lock.
  struct Recent;
  mutable std::mutex mutex;
  mutable std::unique_ptr<Recent> recent;

  State();
  ~State();
};

}  // namespace roam
