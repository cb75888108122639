#pragma once
/// \file
/// Reader of pages and tiles for reports and verification: it allocates, blocks and throws.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "index/traverse.h"
#include "store/codec/tile_codec.h"
#include "store/opened.h"
#include "store/page.h"
#include "store/read_ahead.h"
#include "store/tile_view.h"

namespace roam::store {

/// A page, read and checked.
struct LoadedPage {
  std::unique_ptr<index::Block[]> memory;
  PageView view;
};

/// A tile, read, checked and decoded.
struct LoadedTile : TileView {
  std::unique_ptr<index::Block[]> memory;
};

/// Thrown when a page or a tile cannot be read or is altered.
class Unusable : public Error {
 public:
  Unusable(const std::string& store, const std::string& what, const char* reason, bool unread = false);
  std::string why;  ///< the cause alone; what() also names the store, the page or tile, and its position
  bool unread;      ///< its bytes did not come, so that nothing is known of them
};

/// Reads pages and tiles of one store. For one thread at a time.
class TileReader {
 public:
  explicit TileReader(const Store::State& store) : store_(store), ahead_(*store.bytes) {}

  /// Begins to read what page(), tile() or numbers() will soon read, if the store is far away. For as many as
  /// expects_more(). All that was expected must be read.
  void expect(std::uint64_t page);
  void expect(std::uint64_t page, const TileEntry& entry);
  void expect_numbers(std::uint64_t page, const TileEntry& entry);
  [[nodiscard]] bool expects_more() const { return ahead_.has_room(); }

  // All throw Unusable, or roam::Error that names the page or tile, its position and the cause; and Cancelled once
  // `stop` is requested.
  [[nodiscard]] LoadedPage page(std::uint64_t number, const std::stop_token& stop = {});
  [[nodiscard]] LoadedTile tile(std::uint64_t page, const TileEntry& entry, std::uint32_t number);
  [[nodiscard]] std::vector<SourceNumber> numbers(std::uint64_t page, const TileEntry& entry, std::uint32_t number,
                                                  const std::stop_token& stop = {});

 private:
  [[nodiscard]] CheckedRange range_of(std::uint64_t page) const;
  [[nodiscard]] CheckedRange range_of(std::uint64_t page, const TileEntry& entry) const;
  [[nodiscard]] CheckedRange range_of_numbers(std::uint64_t page, const TileEntry& entry) const;
  [[nodiscard]] std::vector<std::byte> read(const CheckedRange& range, const std::string& what,
                                            const std::stop_token& stop);

  const Store::State& store_;
  ReadAhead ahead_;
  std::optional<TileDecoder> decoder_;  ///< large; made for the first tile
};

/// "tile 3 of page 17 (10.5 2.0 0.3 to 20.1 9.9 4.0)"
[[nodiscard]] std::string name_of(std::uint64_t page, std::uint32_t tile, const Box& box);
[[nodiscard]] std::string name_of(std::uint64_t page, const Box& box);

}  // namespace roam::store
