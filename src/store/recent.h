#pragma once
/// \file
/// A small cache of a store's contents that reports have read.

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "roam/error.h"
#include "store/opened.h"
#include "store/part.h"
#include "store/tile_reader.h"

namespace roam {

namespace store {

/// The source numbers of a tile, in a quarter of the memory if they are of one part and below 2^32.
class TileNumbers {
 public:
  explicit TileNumbers(std::vector<SourceNumber> numbers) {
    if (!numbers.empty()) part_ = numbers.front().part;
    small_.resize(numbers.size());
    std::uint64_t other = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      other |= (numbers[i].part ^ part_) | numbers[i].number >> 32;
      small_[i] = static_cast<std::uint32_t>(numbers[i].number);
    }
    if (other == 0) return;
    small_ = {};
    any_ = std::move(numbers);
  }
  [[nodiscard]] std::size_t size() const { return any_.size() + small_.size(); }
  [[nodiscard]] std::size_t bytes() const { return any_.size() * sizeof(SourceNumber) + small_.size() * 4; }
  [[nodiscard]] SourceNumber operator[](std::size_t i) const {
    return small_.empty() ? any_[i] : SourceNumber{part_, small_[i]};
  }

 private:
  std::uint64_t part_ = 0;
  std::vector<std::uint32_t> small_;
  std::vector<SourceNumber> any_;
};

}  // namespace store

struct Store::State::Recent {
  explicit Recent(const State& state) : store(state) {}

  /// Limit in bytes. The largest page and the largest tile's numbers fit in together.
  static constexpr std::size_t most = 1U << 20;

  /// The page, or the numbers of the tile with this first triangle, if they are kept; else null.
  [[nodiscard]] const store::LoadedPage* page(std::uint64_t number) const {
    const auto known = pages.find(number);
    return known == pages.end() ? nullptr : &known->second;
  }
  [[nodiscard]] const store::TileNumbers* numbers_of(TriangleId first) const {
    const auto known = numbers.find(first);
    return known == numbers.end() ? nullptr : &known->second;
  }
  // Both return what is kept: what they are given, or what another thread has kept meanwhile.
  const store::LoadedPage& keep(std::uint64_t number, store::LoadedPage&& read) {
    if (const store::LoadedPage* const known = page(number)) return *known;
    make_room(entry_cost + store.pages[number].ref.bytes);
    return pages.emplace(number, std::move(read)).first->second;
  }
  const store::TileNumbers& keep(TriangleId first, store::TileNumbers&& read) {
    if (const store::TileNumbers* const known = numbers_of(first)) return *known;
    make_room(entry_cost + read.bytes());
    const auto& kept = numbers.emplace(first, std::move(read)).first->second;
    try {
      oldest.push_back(first);
    } catch (...) {
      numbers.erase(first);
      throw;
    }
    return kept;
  }

  /// Objects of a part one after the other: all of them, or as many as are kept.
  struct Objects {
    std::uint32_t part = 0;
    std::uint64_t first = 0, end = std::numeric_limits<std::uint64_t>::max();  ///< range of their triangles
    store::PartFile names;
    std::size_t bytes = 0;
    std::optional<Error> damage;  ///< why the part is damaged; then there are no names
  };
  /// The name of the object of a part's triangle, if it is kept. Throws roam::Error if the part is known to be damaged.
  [[nodiscard]] std::optional<std::string> object(std::uint32_t part, std::uint64_t triangle) const;
  /// Does nothing if another thread has kept them meanwhile. Damage takes the place of what was read of the part
  /// before.
  void keep(Objects&& read) {
    if (read.damage) {
      std::erase_if(objects, [&](const Objects& o) {
        if (o.part != read.part) return false;
        used -= entry_cost + o.bytes;
        return true;
      });
    }
    const auto is_same = [&](const Objects& o) { return o.part == read.part && o.first == read.first; };
    if (std::any_of(objects.begin(), objects.end(), is_same)) return;
    make_room(entry_cost + read.bytes);
    objects.push_back(std::move(read));
  }

 private:
  /// Bytes of an entry besides its contents, whatever its kind: a node of a map with its links, a place in `oldest`,
  /// and what the allocator adds to each block.
  static constexpr std::size_t entry_cost =
      sizeof(std::pair<const TriangleId, store::TileNumbers>) + sizeof(TriangleId) + 10 * sizeof(void*);

  /// Frees the numbers of tiles first: there are many of them, and none helps with another.
  void make_room(std::size_t size) {
    for (; used + size > most && !oldest.empty(); oldest.pop_front()) {
      const auto gone = numbers.find(oldest.front());
      used -= entry_cost + gone->second.bytes();
      numbers.erase(gone);
    }
    if (used + size > most) {
      pages.clear();
      objects.clear();
      used = 0;
    }
    used += size;
  }

  const State& store;
  std::size_t used = 0;  ///< bytes, or slightly more
  std::map<std::uint64_t, store::LoadedPage> pages;
  std::map<TriangleId, store::TileNumbers> numbers;  ///< for each tile, by the id of its first triangle
  std::deque<TriangleId> oldest;                     ///< their keys, oldest first
  std::vector<Objects> objects;
};

}  // namespace roam
