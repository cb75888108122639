#include "store/tile_reader.h"

#include <fmt/format.h>

#include <cstring>
#include <string_view>

#include "store/files.h"
#include "store/mask.h"

namespace roam::store {
namespace {

std::unique_ptr<index::Block[]> blocks_for(std::size_t bytes) {
  return std::make_unique_for_overwrite<index::Block[]>((bytes + sizeof(index::Block) - 1) / sizeof(index::Block));
}

[[noreturn]] void refuse(const Store::State& store, const std::string& what, const char* why) {
  throw Unusable(store.name, what, why);
}

std::string place(const Box& box) {
  return fmt::format("({:.1f} {:.1f} {:.1f} to {:.1f} {:.1f} {:.1f})", box.lower.x, box.lower.y, box.lower.z,
                     box.upper.x, box.upper.y, box.upper.z);
}

}  // namespace

Unusable::Unusable(const std::string& store, const std::string& what, const char* reason, bool is_unread)
    : Error(store, fmt::format("{} cannot be used: {}", what, reason)), why(reason), unread(is_unread) {}

std::string name_of(std::uint64_t page, std::uint32_t tile, const Box& box) {
  return fmt::format("tile {} of page {} {}", tile, page, place(box));
}

std::string name_of(std::uint64_t page, const Box& box) { return fmt::format("page {} {}", page, place(box)); }

CheckedRange TileReader::range_of(std::uint64_t page) const {
  const Store::State::Page& p = store_.pages[page];
  return {store_.packs[p.shard], p.ref.offset, p.ref.bytes, p.ref.hash};
}

CheckedRange TileReader::range_of(std::uint64_t page, const TileEntry& entry) const {
  return {store_.packs[store_.pages[page].shard], entry.offset, entry.bytes, entry.hash};
}

CheckedRange TileReader::range_of_numbers(std::uint64_t page, const TileEntry& entry) const {
  return {store_.packs[store_.pages[page].shard], entry.offset + entry.bytes, entry.number_bytes, entry.number_hash};
}

void TileReader::expect(std::uint64_t page) { ahead_.begin(range_of(page)); }
void TileReader::expect(std::uint64_t page, const TileEntry& entry) { ahead_.begin(range_of(page, entry)); }
void TileReader::expect_numbers(std::uint64_t page, const TileEntry& entry) {
  ahead_.begin(range_of_numbers(page, entry));
}

std::vector<std::byte> TileReader::read(const CheckedRange& range, const std::string& what,
                                        const std::stop_token& stop) {
  ReadAhead::Result result = ahead_.take(range, stop);
  if (stop.stop_requested()) throw Cancelled();
  if (result.problem) {
    throw Unusable(store_.name, what + " in " + range.file, result.problem,
                   std::string_view(result.problem) != wrong_checksum);
  }
  return std::move(result.bytes);
}

LoadedPage TileReader::page(std::uint64_t number, const std::stop_token& stop) {
  const std::string what = name_of(number, store_.pages[number].ref.box);
  const std::vector<std::byte> content = read(range_of(number), what, stop);
  LoadedPage loaded;
  loaded.memory = blocks_for(content.size());
  std::memcpy(loaded.memory.get(), content.data(), content.size());
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(loaded.memory.get()), content.size());
  if (const char* problem = view_page_of(store_, number, bytes, loaded.view)) refuse(store_, what, problem);
  return loaded;
}

LoadedTile TileReader::tile(std::uint64_t page, const TileEntry& entry, std::uint32_t number) {
  const std::string what = name_of(page, number, box_of(entry));
  const std::vector<std::byte> content = read(range_of(page, entry), what, {});
  const TileShape shape = shape_of(entry);
  LoadedTile loaded;
  loaded.memory = blocks_for(shape.bytes());
  const std::span<std::byte> out(reinterpret_cast<std::byte*>(loaded.memory.get()), shape.bytes());
  if (!decoder_) decoder_.emplace();
  if (const char* problem = decoder_->decode(content, shape, out)) refuse(store_, what, problem);
  static_cast<TileView&>(loaded) = view_tile(entry, out);
  if (const char* problem = check_place(entry, loaded)) refuse(store_, what, problem);
  return loaded;
}

std::vector<SourceNumber> TileReader::numbers(std::uint64_t page, const TileEntry& entry, std::uint32_t number,
                                              const std::stop_token& stop) {
  const std::string what = "the source numbers of " + name_of(page, number, box_of(entry));
  return decode_numbers(read(range_of_numbers(page, entry), what, stop), entry.triangles);
}

}  // namespace roam::store
