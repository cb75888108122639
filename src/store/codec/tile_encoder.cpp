#include <algorithm>
#include <memory>

#include "roam/error.h"
#include "store/codec/frame.h"
#include "store/codec/front.h"
#include "store/codec/magnitude.h"
#include "store/codec/streams.h"

namespace roam::store {
namespace {

using index::node_width;
using GridPlace = std::array<std::uint32_t, 3>;

/// The numbers of the vertices seen so far, by grid position.
class VertexTable {
 public:
  explicit VertexTable(std::size_t vertices) : slots_(std::bit_ceil(2 * vertices), no_vertex) {}

  /// The slot that holds the number of this position, or will hold it.
  std::uint16_t& find(const GridPlace& at, const FrontVertex* vertices) {
    std::uint64_t h = (at[0] * 0x9e3779b97f4a7c15U) ^ (at[1] * 0xc2b2ae3d27d4eb4fU) ^ (at[2] * 0x165667b19e3779f9U);
    for (h ^= h >> 29U;; ++h) {
      std::uint16_t& slot = slots_[h & (slots_.size() - 1)];
      if (slot == no_vertex || vertices[slot].at == at) return slot;
    }
  }

 private:
  std::vector<std::uint16_t> slots_;
};

/// A leaf of the builder, still to be reordered.
struct Source {
  int triangles = 0;
  std::uint32_t undone = 0;                                     ///< a bit a triangle
  std::array<std::array<std::uint8_t, 3>, node_width> corners;  ///< slots
  std::array<GridPlace, node_width> places;
  std::array<std::uint16_t, node_width> numbers;  ///< of the vertices, no_vertex for those not seen before
  std::array<std::array<std::uint8_t, node_width>, node_width> beyond;  ///< triangle by its edge; node_width: none
  std::array<std::uint8_t, node_width> slot;  ///< of the source, for each of the leaf that grows

  /// The slot of the third corner of triangle `t`, which has an edge from .. to.
  [[nodiscard]] unsigned third(int t, unsigned from, unsigned to) const {
    const auto& c = corners[t];
    return c[0] == from && c[1] == to ? c[2] : c[1] == from && c[2] == to ? c[0] : c[1];
  }
};

template <bool fine>
class TileEncoder {
 public:
  explicit TileEncoder(index::BuiltTile& tile)
      : tile_(tile),
        vertices_(std::make_unique_for_overwrite<FrontVertex[]>(tile.leaves.size() * node_width)),
        table_(tile.leaves.size() * node_width),
        growth_(vertices_.get()) {}

  std::vector<std::byte> run() {
    visit_depth_first(tile_.nodes, 0, [&](const index::Node& n) { put(tree_stream, node_letter(n)); });
    for (std::uint32_t i = 0; i < tile_.leaves.size(); ++i) encode_leaf(i);
    while (apexes_ % 3 != 0) put_apex(Apex::none);
    return pack();
  }

 private:
  void put(int stream, std::uint32_t letter) { streams_[stream].push_back(std::byte(letter)); }

  void put_apex(Apex apex) {
    static constexpr std::array<unsigned, 3> factors{1, apex_stream, apex_stream * apex_stream};
    auto& letters = streams_[gate_stream];
    if (apexes_ % 3 == 0) letters.push_back(std::byte{0});
    letters.back() = std::byte(std::to_integer<unsigned>(letters.back()) + unsigned(apex) * factors[apexes_ % 3]);
    ++apexes_;
  }

  void put_magnitude(int stream, std::uint32_t first_letter, std::uint32_t number, BitWriter& bits) {
    const std::uint32_t c = class_of(number);
    put(stream, first_letter + c);
    bits.put(number - base_of(c), bits_of(c));
  }

  void read(std::uint32_t i, Source& s) {
    const index::Leaf& leaf = tile_.leaves[i];
    s.triangles = leaf.triangle_count;
    s.undone = (1U << s.triangles) - 1;
    for (auto& row : s.beyond) row.fill(node_width);
    std::uint32_t used = 0;
    for (int t = s.triangles; t-- > 0;) {
      for (int c = 0; c < 3; ++c) s.corners[t][c] = static_cast<std::uint8_t>(leaf.vertex_of(c, t));
      for (int c = 0; c < 3; ++c) {
        s.beyond[s.corners[t][c]][s.corners[t][(c + 1) % 3]] = static_cast<std::uint8_t>(t);
        used |= 1U << s.corners[t][c];
      }
    }
    for (int v = 0; v < node_width; ++v) {
      if ((used >> v & 1U) == 0) continue;
      for (int k = 0; k < 3; ++k) {
        s.places[v][k] = leaf.vertex[k][v];
        if (fine) {
          s.places[v][k] = (s.places[v][k] << 16U) + static_cast<std::uint32_t>(tile_.fine_leaves[i].vertex[k][v]) +
                           std::uint32_t{1U << 15U};
        }
      }
      s.numbers[v] = table_.find(s.places[v], vertices_.get());
    }
  }

  void encode_leaf(std::uint32_t i) {
    Source s;
    read(i, s);
    index::Leaf& old = tile_.leaves[i];
    index::Leaf leaf{};
    leaf.id_bytes = old.id_bytes;
    leaf.ids = old.ids;
    growth_.begin(i, leaf, fine ? &tile_.fine_leaves[i] : nullptr);
    put(count_stream, static_cast<std::uint32_t>(s.triangles) - 1);
    std::array<std::uint8_t, node_width> order{};
    Gate gate{};
    Step step = Step::closed;
    while (growth_.triangles() < static_cast<unsigned>(s.triangles)) {
      int t = 0;
      if (step == Step::open || growth_.pop(gate)) {
        const unsigned to = s.slot[gate.to_slot], from = s.slot[gate.from_slot];
        t = s.beyond[to][from];
        if (t == node_width || (s.undone >> t & 1U) == 0) {
          put_apex(Apex::none);
          step = Step::closed;
          continue;
        }
        const unsigned third = s.third(t, to, from);
        const Apex how = apex(s, third, gate.from, gate.to);
        put_apex(how);
        step = add(s, third, gate, how);
      } else {
        t = seed(s, gate, step);
      }
      order[growth_.triangles() - 1] = static_cast<std::uint8_t>(t);
      s.undone &= ~(1U << t);
    }
    growth_.finish();
    reorder_ids(old, {order.data(), static_cast<std::size_t>(s.triangles)});
    old = leaf;
  }

  /// How to name the third corner of the triangle beyond a gate.
  Apex apex(const Source& s, unsigned third, std::uint16_t from, std::uint16_t to) {
    const std::uint16_t v = s.numbers[third];
    if (v == no_vertex) return Apex::fresh;
    if (v == vertices_[to].onward()) return Apex::next;
    if (v == vertices_[from].backward()) return Apex::previous;
    return Apex::other;
  }

  /// Adds the triangle beyond a gate; `third` is the source's slot of its third corner.
  Step add(Source& s, unsigned third, Gate& gate, Apex how) {
    if (how == Apex::fresh) {
      const FrontVertex &from = vertices_[gate.from], &to = vertices_[gate.to], &across = vertices_[from.across];
      GridPlace near;
      for (int k = 0; k < 3; ++k) near[k] = from.at[k] + to.at[k] - across.at[k];
      put_fresh(s, third, gate_x, near);
    } else if (how == Apex::other) {
      put_name(s.numbers[third]);
    }
    const Step step = growth_.add(gate, how, s.numbers[third]);
    s.slot[growth_.slot_of(s.numbers[third])] = static_cast<std::uint8_t>(third);
    return step;
  }

  /// Adds a triangle that no gate of the leaf reaches. Returns its number.
  int seed(Source& s, Gate& gate, Step& step) {
    int best = node_width, first = 0, age = INT32_MAX;
    for (int t = 0; t < s.triangles; ++t) {
      if ((s.undone >> t & 1U) == 0) continue;
      for (int c = 0; c < 3; ++c) {
        const std::uint16_t to = s.numbers[s.corners[t][c]], from = s.numbers[s.corners[t][(c + 1) % 3]];
        if (to == no_vertex || from == no_vertex || vertices_[from].next != to || count_ - from >= age) continue;
        age = count_ - from;
        best = t;
        first = c;
      }
    }
    if (best < node_width) {
      const unsigned to = s.corners[best][first], from = s.corners[best][(first + 1) % 3];
      const unsigned third = s.corners[best][(first + 2) % 3];
      const Apex how = apex(s, third, s.numbers[from], s.numbers[to]);
      put(seed_stream, static_cast<std::uint32_t>(how) - 1);
      put_name(s.numbers[from]);
      growth_.enter(s.numbers[from], gate);
      s.slot[gate.from_slot] = static_cast<std::uint8_t>(from);
      s.slot[gate.to_slot] = static_cast<std::uint8_t>(to);
      step = add(s, third, gate, how);
      return best;
    }
    // None touches the front. Take the triangle with most known corners, and put those first.
    std::uint32_t least = UINT32_MAX;
    for (int t = 0; t < s.triangles; ++t) {
      if ((s.undone >> t & 1U) == 0) continue;
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t fresh = fresh_corners(s, t, c);
        if (fresh >= least) continue;
        least = fresh;
        best = t;
        first = c;
      }
    }
    put_free(s, best, first);
    step = Step::closed;
    return best;
  }

  /// A cost: the number of new corners, then their position. Smaller if they come later.
  static std::uint32_t fresh_corners(const Source& s, int t, int first) {
    std::uint32_t count = 0, which = 0;
    for (int c = 0; c < 3; ++c) {
      const bool fresh = s.numbers[s.corners[t][(first + c) % 3]] == no_vertex;
      count += fresh ? 1 : 0;
      which |= fresh ? 4U >> c : 0U;
    }
    return count << 3U | which;
  }

  void put_free(Source& s, int t, int first) {
    const std::size_t letter = streams_[seed_stream].size();
    put(seed_stream, 0);
    std::uint32_t mask = 0;
    std::array<std::uint16_t, 3> corners;
    for (int c = 0; c < 3; ++c) {
      const unsigned slot = s.corners[t][(first + c) % 3];
      if (s.numbers[slot] == no_vertex) {
        mask |= 1U << c;
        put_fresh(s, slot, free_x, last_);
      } else {
        put_name(s.numbers[slot]);
      }
      corners[c] = s.numbers[slot];
      last_ = vertices_[corners[c]].at;
    }
    streams_[seed_stream][letter] = std::byte(free_seed + mask);
    growth_.add(corners);
    for (int c = 0; c < 3; ++c) s.slot[growth_.slot_of(corners[c])] = s.corners[t][(first + c) % 3];
  }

  void put_fresh(Source& s, unsigned slot, int stream, const GridPlace& near) {
    const GridPlace& at = s.places[slot];
    for (int k = 0; k < 3; ++k) {
      std::uint32_t difference = at[k] - near[k];
      if (!fine) difference = static_cast<std::uint32_t>(static_cast<std::int16_t>(difference));
      put_magnitude(stream + k, 0, zigzag(difference), stream == gate_x ? gate_bits_ : free_bits_);
    }
    // Looked up before the vertex is stored, so that the table returns the free slot of its position.
    std::uint16_t& number = table_.find(at, vertices_.get());
    number = static_cast<std::uint16_t>(count_);
    s.numbers[slot] = number;
    vertices_[count_++] = {at, no_vertex, no_vertex, no_vertex, no_vertex, no_vertex, no_vertex};
  }

  void put_name(std::uint16_t vertex) {
    if (const unsigned slot = growth_.slot_of(vertex); slot < node_width) {
      put(name_stream, slot);
    } else {
      put_magnitude(name_stream, age_name, static_cast<std::uint32_t>(count_ - 1 - vertex), name_bits_);
    }
  }

  /// Reorders the ids of a leaf like its triangles.
  void reorder_ids(const index::Leaf& leaf, std::span<const std::uint8_t> order) {
    std::array<std::uint8_t, std::size_t{4} * node_width> ids;
    std::uint8_t* at = tile_.ids.data() + leaf.ids + 4;
    std::copy_n(at, leaf.id_bytes * order.size(), ids.begin());
    for (const std::uint8_t t : order) at = std::copy_n(ids.begin() + t * leaf.id_bytes, leaf.id_bytes, at);
  }

  std::vector<std::byte> pack() {
    streams_[name_bit_stream] = name_bits_.finish();
    streams_[gate_bit_stream] = gate_bits_.finish();
    streams_[free_bit_stream] = free_bits_.finish();
    std::vector<std::byte> coded;
    for (const int s :
         {gate_stream, seed_stream, name_stream, gate_x, free_x, name_bit_stream, gate_bit_stream, free_bit_stream}) {
      append_number(coded, streams_[s].size());
    }
    append_frame(coded, streams_);
    return coded;
  }

  index::BuiltTile& tile_;
  std::unique_ptr<FrontVertex[]> vertices_;
  VertexTable table_;
  Growth<fine> growth_;
  int count_ = 0;  ///< of vertices
  std::size_t apexes_ = 0;
  GridPlace last_{};
  BitWriter name_bits_, gate_bits_, free_bits_;
  std::array<std::vector<std::byte>, stream_count> streams_;
};

}  // namespace

std::vector<std::byte> encode_tile(index::BuiltTile& tile) {
  if (shape_of(tile).bytes() > tile_bytes) {
    throw Error("a tile takes more memory than a store allows: it must be divided before it is encoded");
  }
  return tile.tile.fine ? TileEncoder<true>(tile).run() : TileEncoder<false>(tile).run();
}

}  // namespace roam::store
