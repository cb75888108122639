#include "roam/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "math/boxes.h"
#include "math/floating_point.h"
#include "store/authentic.h"
#include "store/files.h"
#include "store/held.h"
#include "store/recent.h"
#include "store/tile_reader.h"
#include "store/web/address.h"
#include "store/web_files.h"

namespace roam {

Store::State::State() = default;
Store::State::~State() = default;
Store::Store(std::unique_ptr<State> state) : state_(std::move(state)) {}
Store::~Store() = default;

std::shared_ptr<const Store> store::open_store(const Folder& folder, std::uint64_t memory) {
  if (!is_file(folder, current_file)) refuse_to_open(folder);
  try {
    return open_store(files_of(folder), folder.string(), memory);
  } catch (const RootDamage& damage) {
    // Other programs also have files called CURRENT.
    if (holds_store(folder) || damage.what_is_damaged != current_file) throw;
    throw Error::at(folder.string(),
                    fmt::format("{} is no store: its file CURRENT is none of a store", folder.string()));
  }
}

std::shared_ptr<const Store> Store::open(const std::filesystem::path& folder, std::uint64_t memory,
                                         const WebAccess& web) {
  if (!is_address(folder.native())) return store::open_store(folder, memory);
  const store::WebStore there = store::web_store(folder.native(), web);
  return store::open_store(there.bytes, there.name, memory);
}

std::shared_ptr<const Store> store::open_store(std::shared_ptr<StoreBytes> bytes, const std::string& name,
                                               std::uint64_t memory) {
  const DefaultFloatingPoint guard;
  auto state = std::make_unique<Store::State>();
  Store::State& s = *state;
  s.name = name;
  s.bytes = std::move(bytes);
  std::uint64_t manifest_bytes = 0;
  s.manifest = store::read_manifest(*s.bytes, name, &s.info.hash, &manifest_bytes, memory, &s.memory);
  s.memory += Store::State::Recent::most;
  const store::Manifest& m = s.manifest;
  s.info.format = m.format;
  s.info.lossless = m.lossless;
  s.info.bounds = m.bounds;
  s.info.geometry_hash = fmt::format("{:016x}", m.geometry_hash);
  s.info.bytes = manifest_bytes;
  s.info.packs = m.shards.size();
  std::uint64_t first = 0;
  for (std::uint32_t i = 0; i < m.parts.size(); ++i) {
    const std::string& part = m.parts[i].name;
    s.part_of.emplace(store::xxh3(std::as_bytes(std::span(part))), i);
    s.first.push_back(first);
    first += m.parts[i].triangles;
    s.info.objects += m.parts[i].objects;
    s.info.bytes += m.parts[i].bytes;
  }
  std::size_t pages = 0;
  for (const store::ShardInfo& shard : m.shards) pages += shard.pages.size();
  s.pages.reserve(pages);
  s.packs.reserve(m.shards.size());
  for (std::uint32_t i = 0; i < m.shards.size(); ++i) {
    const store::ShardInfo& shard = m.shards[i];
    s.packs.push_back(store::pack_file(shard.pack));
    for (const store::PageRef& page : shard.pages) s.pages.push_back({i, page});
    s.info.triangles += shard.triangles;
    s.info.tiles += shard.tiles;
    s.info.bytes += shard.bytes;
    s.info.geometry_bytes += shard.geometry_bytes;
    s.info.number_bytes += shard.number_bytes;
    s.info.resident_bytes += shard.resident_bytes;
    s.info.largest_error = std::max(s.info.largest_error, shard.largest_error);
  }
  s.info.pages = s.pages.size();
  s.recent = std::make_unique<Store::State::Recent>(s);
  return std::make_shared<const Store>(std::move(state));
}

bool Store::is_address(std::string_view text) { return web::Address::is_one(text); }

bool Store::is_store(const std::filesystem::path& folder) {
  return is_address(folder.native()) || store::is_file(folder, store::current_file);
}

const StoreInfo& Store::info() const { return state_->info; }
const std::string& Store::name() const { return state_->name; }
bool Store::is_authentic(const StoreKey& key) const { return store::has_code(*state_->bytes, state_->info.hash, key); }

void Store::for_each_triangle(const Box& box,
                              const std::function<void(std::span<const Triangle>, std::span<const TriangleId>)>& f,
                              const std::function<void(const std::string&)>& missing) const {
  const DefaultFloatingPoint guard;
  /// The result of `read`; nothing if it failed and `missing` was called.
  const auto had = [&](const auto& read) -> std::optional<decltype(read())> {
    if (!missing) return read();
    try {
      return read();
    } catch (const Error& error) {
      missing(error.what());
      return std::nullopt;
    }
  };
  store::TileReader reader(*state_);
  std::vector<Triangle> triangles;
  std::vector<TriangleId> ids;
  std::vector<std::uint64_t> pages;
  for (std::uint64_t p = 0; p < state_->pages.size(); ++p) {
    if (meet(box, state_->pages[p].ref.box)) pages.push_back(p);
  }
  std::vector<std::uint32_t> tiles;
  for (std::size_t n = 0; n < pages.size(); ++n) {
    const std::uint64_t p = pages[n];
    const auto page = had([&] { return reader.page(p); });
    if (n + 1 < pages.size()) reader.expect(pages[n + 1]);
    if (!page) continue;
    tiles.clear();
    for (std::uint32_t t = 0; t < page->view.tiles.size(); ++t) {
      if (meet(box, store::box_of(page->view.tiles[t]))) tiles.push_back(t);
    }
    for (std::size_t k = 0, expected = 0; k < tiles.size(); ++k) {
      for (expected = std::max(expected, k); expected < tiles.size() && reader.expects_more(); ++expected) {
        reader.expect(p, page->view.tiles[tiles[expected]]);
      }
      const std::uint32_t t = tiles[k];
      const store::TileEntry& entry = page->view.tiles[t];
      const auto tile = had([&] { return reader.tile(p, entry, t); });
      if (!tile) continue;
      triangles.clear();
      ids.clear();
      for (std::size_t l = 0; l < tile->leaves.size(); ++l) {
        const index::Leaf& leaf = tile->leaves[l];
        const index::FineLeaf* fine = tile->fine.empty() ? nullptr : &tile->fine[l];
        for (int i = 0; i < leaf.triangle_count; ++i) {
          triangles.push_back(store::stored_triangle(tile->tile, leaf, fine, i));
          ids.push_back(store::stored_id(p, t, leaf.ids + static_cast<std::uint32_t>(i)));
        }
      }
      f(triangles, ids);
    }
  }
}

std::vector<Vec3> Store::sample(std::uint64_t count) const {
  const DefaultFloatingPoint guard;
  store::TileReader reader(*state_);
  std::vector<Vec3> places;
  const std::uint64_t tiles = state_->info.tiles;
  count = std::min(count, tiles);
  std::uint64_t first = 0;  // number of the page's first tile
  for (std::uint64_t p = 0; p < state_->pages.size(); ++p) {
    const std::uint64_t end = first + state_->pages[p].ref.tiles;
    std::optional<store::LoadedPage> page;
    for (; places.size() < count;) {
      const std::uint64_t tile = (2 * places.size() + 1) * tiles / (2 * count);
      if (tile >= end) break;
      if (!page) page = reader.page(p);
      places.push_back(store::box_of(page->view.tiles[tile - first]).center());
    }
    first = end;
  }
  return places;
}

}  // namespace roam
