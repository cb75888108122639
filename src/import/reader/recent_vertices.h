#pragma once
/// \file
/// The indices of vertices that a file repeats shortly after.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "import/reader/display/look.h"
#include "roam/math.h"

namespace roam::reader {

/// A cache of 3.7 MB: one vertex for each hash value, enough for the usual distance of neighbours in a file. Takes no
/// memory before its first use.
class RecentVertices {
 public:
  /// Equal if position, look and object are. Positions are compared by their bits, looks by value: a look with a NaN
  /// equals none.
  struct Key {
    Vec3 vertex{0.0};
    VertexLook look;
    std::uint32_t object = 0;  ///< > 0
  };

  /// The index of an equal vertex, if one is remembered. Else calls `add`, and remembers the index that it returns.
  template <class Add>
  std::uint32_t index(const Key& key, const Add& add) {
    if (entries_.empty()) entries_.resize(std::size_t{1} << entries_bits);
    Entry& entry = entries_[slot_of(key.vertex)];
    if (!equal(entry.key, key)) entry = {key, add()};
    return entry.index;
  }

 private:
  static constexpr unsigned entries_bits = 16;
  struct Entry {
    Key key;
    std::uint32_t index = 0;
  };

  static std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }
  static bool equal(const Key& a, const Key& b) {
    return a.object == b.object && bits_of(a.vertex.x) == bits_of(b.vertex.x) &&
           bits_of(a.vertex.y) == bits_of(b.vertex.y) && bits_of(a.vertex.z) == bits_of(b.vertex.z) &&
           a.look.normal == b.look.normal && a.look.texture == b.look.texture && a.look.colour == b.look.colour;
  }
  static std::size_t slot_of(const Vec3& v) {
    // Fibonacci hashing (Knuth, TAOCP 3, 6.4) of each coordinate in turn.
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ull;
    std::uint64_t h = bits_of(v.x) * golden;
    h = (std::rotl(h, 29) ^ bits_of(v.y)) * golden;
    h = (std::rotl(h, 29) ^ bits_of(v.z)) * golden;
    return h >> (64 - entries_bits);
  }

  std::vector<Entry> entries_;
};

}  // namespace roam::reader
