// The source of a store's triangle: part, object and number in the scene.
#include <fmt/format.h>

#include <cstring>
#include <mutex>
#include <optional>
#include <utility>

#include "store/files.h"
#include "store/part_bytes.h"
#include "store/recent.h"

namespace roam {
namespace {

/// Greatest size in bytes of the objects that are kept of a part at once.
constexpr std::size_t most_of_a_part = 256U << 10;

struct Source {
  std::uint32_t part;
  std::uint64_t number;
};

/// The number of a tile's triangle in the scene. Reads what is not kept without the lock. Throws what TileReader
/// throws, and no_such() if there is no such triangle.
store::SourceNumber number_of(const Store::State& s, std::unique_lock<std::mutex>& lock, std::uint64_t page,
                              std::uint32_t tile, std::uint32_t triangle, const std::stop_token& stop,
                              const auto& no_such) {
  const TriangleId first = store::stored_id(page, tile, 0);
  const store::TileNumbers* numbers = s.recent->numbers_of(first);
  if (!numbers) {
    store::TileReader reader(s);
    const store::LoadedPage* in = s.recent->page(page);
    if (!in) {
      lock.unlock();
      store::LoadedPage read = reader.page(page, stop);
      lock.lock();
      in = &s.recent->keep(page, std::move(read));
    }
    if (tile >= in->view.tiles.size()) throw no_such();
    const store::TileEntry entry = in->view.tiles[tile];
    lock.unlock();
    store::TileNumbers read(reader.numbers(page, entry, tile, stop));
    lock.lock();
    numbers = &s.recent->keep(first, std::move(read));
  }
  if (triangle >= numbers->size()) throw no_such();
  return (*numbers)[triangle];
}

/// Needs the lock of the store, and gives it up while it reads.
Source source_of(const Store::State& s, std::unique_lock<std::mutex>& lock, TriangleId triangle,
                 const std::stop_token& stop) {
  const std::uint64_t page = triangle >> (store::triangle_bits + store::tile_bits);
  const auto tile = static_cast<std::uint32_t>(triangle >> store::triangle_bits & ((1U << store::tile_bits) - 1));
  const auto number = static_cast<std::uint32_t>(triangle & ((1U << store::triangle_bits) - 1));
  const auto no_such = [&] {
    return Error::at(s.name,
                     fmt::format("{} has no triangle {}: it must come from an answer of this store", s.name, triangle));
  };
  if (page >= s.pages.size()) throw no_such();
  const store::SourceNumber from = number_of(s, lock, page, tile, number, stop, no_such);
  const auto part = s.part_of.find(from.part);
  if (part == s.part_of.end() || from.number >= s.manifest.parts[part->second].triangles) {
    throw Error(s.name, fmt::format("triangle {} comes from a part of the scene that the manifest does not name: the "
                                    "store is damaged; verify it, and repair it from its scene",
                                    triangle));
  }
  return {part->second, from.number};
}

/// Reads the objects about a triangle of a part. Needs no lock.
Store::State::Recent::Objects read_objects(const Store::State& s, std::uint32_t part, std::uint64_t triangle,
                                           const std::stop_token& stop) {
  Store::State::Recent::Objects read;
  read.part = part;
  bool full = false;
  store::PartVisitor visitor;
  visitor.object = [&](std::uint64_t begin, std::string_view called) {
    if (full) return;
    const std::size_t bytes = sizeof(store::PartFile::Object) + called.size();
    if (read.bytes + bytes > most_of_a_part && begin > triangle) {
      read.end = begin;
      full = true;
      return;
    }
    if (read.bytes + bytes > most_of_a_part) {
      read.first = begin;
      read.bytes = 0;
      read.names.objects.clear();
    }
    read.bytes += bytes;
    read.names.objects.push_back({begin, std::string(called)});
  };
  visitor.enough = [&] {
    if (stop.stop_requested()) throw Cancelled();
    return full;
  };
  store::PartBytes file(s, s.manifest.parts[part], stop);
  try {
    file.visit(std::move(visitor));
    if (!file.is_whole()) throw store::PartDamage(file.name(), "it is not what it was when it was written");
  } catch (const store::PartDamage& damage) {
    read = {};
    read.part = part;
    read.damage = damage;
    read.bytes = damage.where().size() + std::strlen(damage.what());
  }
  read.bytes *= 2;  // a vector that grows takes up to twice its elements
  return read;
}

}  // namespace

std::optional<std::string> Store::State::Recent::object(std::uint32_t part, std::uint64_t triangle) const {
  for (const Objects& o : objects) {
    if (o.part != part || triangle < o.first || triangle >= o.end) continue;
    if (o.damage) throw *o.damage;
    return o.names.object(triangle);
  }
  return {};
}

SourceTriangle store::find_source(const Store::State& s, TriangleId triangle, const std::stop_token& stop) {
  std::unique_lock lock(s.mutex);
  const auto [part, number] = source_of(s, lock, triangle, stop);
  std::optional<std::string> object = s.recent->object(part, number);
  if (!object) {
    lock.unlock();
    Store::State::Recent::Objects read = read_objects(s, part, number, stop);
    const std::optional<Error> damage = read.damage;
    if (!damage) object = read.names.object(number);
    lock.lock();
    s.recent->keep(std::move(read));
    if (damage) throw Error(*damage);
  }
  return {s.manifest.parts[part].name, number, s.first[part] + number, *object};
}

SourceTriangle Store::source(TriangleId triangle) const { return store::find_source(*state_, triangle, {}); }

TriangleId Store::scene_triangle(TriangleId triangle) const {
  const State& s = *state_;
  std::unique_lock lock(s.mutex);
  const auto [part, number] = source_of(s, lock, triangle, {});
  return s.first[part] + number;
}

}  // namespace roam
