// The source of a store's triangle: part, object and number in the scene.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "store/files.h"
#include "store/part_bytes.h"
#include "store/recent.h"

namespace roam {
namespace {

/// Greatest size in bytes of a part's objects that are kept.
constexpr std::size_t most_of_a_part = 256U << 10;

struct Source {
  std::uint32_t part;
  std::uint64_t number;
};

/// Needs the lock of the store.
Source source_of(const Store::State& s, TriangleId triangle) {
  const std::uint64_t page = triangle >> (store::triangle_bits + store::tile_bits);
  const auto tile = static_cast<std::uint32_t>(triangle >> store::triangle_bits & ((1U << store::tile_bits) - 1));
  const auto number = static_cast<std::uint32_t>(triangle & ((1U << store::triangle_bits) - 1));
  const auto no_such = [&] {
    return Error::at(s.name,
                     fmt::format("{} has no triangle {}: it must come from an answer of this store", s.name, triangle));
  };
  if (page >= s.pages.size()) throw no_such();
  const auto& numbers = s.recent->numbers_of(page, tile, no_such);
  if (number >= numbers.size()) throw no_such();
  const store::SourceNumber from = numbers[number];
  const auto part = s.part_of.find(from.part);
  if (part == s.part_of.end() || from.number >= s.manifest.parts[part->second].triangles) {
    throw Error(s.name, fmt::format("triangle {} comes from a part of the scene that the manifest does not name: the "
                                    "store is damaged; verify it, and repair it from its scene",
                                    triangle));
  }
  return {part->second, from.number};
}

}  // namespace

std::string Store::State::Recent::object(std::uint32_t part, std::uint64_t triangle) {
  if (const auto known = parts.find(part); known != parts.end()) return known->second.object(triangle);
  for (const Object& o : objects) {
    if (o.part == part && triangle >= o.first && triangle < o.end) return o.name;
  }
  store::PartFile all;
  Object found{part, 0, std::numeric_limits<std::uint64_t>::max(), {}};
  std::size_t taken = 0;
  store::PartVisitor visitor;
  visitor.object = [&](std::uint64_t begin, std::string_view called) {
    if (begin <= triangle) {
      found.first = begin;
      found.name = called;
    } else {
      found.end = std::min(found.end, begin);
    }
    taken += sizeof(store::PartFile::Object) + called.size();
    if (taken <= most_of_a_part) {
      all.objects.push_back({begin, std::string(called)});
    } else {
      all.objects = {};
    }
  };
  store::PartBytes file(store, store.manifest.parts[part]);
  file.visit(std::move(visitor));
  if (!file.is_whole()) {
    throw Error::at(file.name(), fmt::format("{} is damaged: it is not what it was when it was written", file.name()));
  }
  if (taken <= most_of_a_part) {
    make_room(2 * taken);
    parts.emplace(part, std::move(all));
  } else {
    make_room(sizeof found + found.name.size());
    objects.push_back(found);
  }
  return found.name;
}

SourceTriangle Store::source(TriangleId triangle) const {
  const State& s = *state_;
  const std::lock_guard lock(s.mutex);
  const auto [part, number] = source_of(s, triangle);
  return {s.manifest.parts[part].name, number, s.first[part] + number, s.recent->object(part, number)};
}

TriangleId Store::scene_triangle(TriangleId triangle) const {
  const State& s = *state_;
  const std::lock_guard lock(s.mutex);
  const auto [part, number] = source_of(s, triangle);
  return s.first[part] + number;
}

}  // namespace roam
