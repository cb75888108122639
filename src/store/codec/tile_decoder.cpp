#include <zstd.h>

#include <cstring>
#include <new>

#include "index/partition.h"
#include "store/codec/frame.h"
#include "store/codec/front.h"
#include "store/codec/magnitude.h"
#include "store/codec/streams.h"

namespace roam::store {
namespace {

/// More than the streams of any tile: three classes and three times 30 bits for each vertex, and the other streams.
constexpr std::size_t most_bytes = tile_vertices * 15 + tile_bytes;
/// Bytes beyond the streams that may be read for a leaf that does not end in time.
constexpr std::size_t overrun = 1024;

/// A sequence of letters. All letters beyond the end of the stream are zero.
class Letters {
 public:
  Letters() = default;
  Letters(const std::byte* begin, std::size_t size) : at_(begin), end_(begin + size) {}
  [[nodiscard]] const std::byte* at() const { return at_; }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end_ - at_); }
  bool next(std::uint8_t& letter) {
    if (at_ == end_) return false;
    letter = std::to_integer<std::uint8_t>(*at_++);
    return true;
  }
  [[nodiscard]] bool finished() const { return at_ == end_; }

 private:
  const std::byte *at_ = nullptr, *end_ = nullptr;
};

/// The base and number of bits of a class, in a table. Letters that are no class count as zero.
struct Magnitude {
  std::uint32_t base, bits;
  [[nodiscard]] std::uint32_t with(std::uint64_t word) const {
    return base + (static_cast<std::uint32_t>(word) & ((1U << bits) - 1));
  }
};
constexpr auto magnitudes() {
  std::array<Magnitude, 256> table{};
  for (std::uint32_t c = 0; c < class_count; ++c) table[c] = {base_of(c), bits_of(c)};
  return table;
}
constexpr std::array<Magnitude, 256> magnitude_tables = magnitudes();

/// The three Apex of a letter of gate_stream, three bits each, and a one above.
constexpr auto apexes() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned l = 0; l < 256; ++l) {
    const unsigned known = l < apex_stream * apex_stream * apex_stream ? l : 0;
    table[l] = static_cast<std::uint16_t>(known % apex_stream | known / apex_stream % apex_stream << 3U |
                                          known / apex_stream / apex_stream << 6U | 1U << 9U);
  }
  return table;
}
constexpr std::array<std::uint16_t, 256> apexes_of_letter = apexes();

using GridPlace = std::array<std::uint32_t, 3>;

/// Reads the differences of vertices that share a kind of prediction, from their classes and bits. This loop is
/// separate from the rest of the decoding because no value in it depends on a branch. False if there are too few
/// bits.
template <bool fine>
bool read_differences(const std::array<const std::byte*, 3>& letters, BitReader bits,
                      std::span<GridPlace> differences) {
  for (std::size_t i = 0; i < differences.size(); ++i) {
    std::uint64_t word = bits.peek();
    for (int k = 0; k < 3; ++k) {
      if (fine && k > 0) word = bits.peek();  // one word holds three numbers of 16 bits, but not of 32
      const Magnitude m = magnitude_tables[std::to_integer<std::size_t>(letters[k][i])];
      differences[i][k] = unzigzag(m.with(word));
      word >>= m.bits;
      bits.skip(m.bits);
    }
    if (!bits.within()) return false;
  }
  return bits.finished();
}

/// Fills the leaves of a tile from its streams.
template <bool fine>
class LeafDecoder {
 public:
  LeafDecoder(const std::array<Letters, stream_count>& streams, BitReader name_bits,
              std::span<const GridPlace> beyond_gates, std::span<const GridPlace> free, FrontVertex* vertices)
      : gates_(streams[gate_stream]),
        seeds_(streams[seed_stream]),
        names_(streams[name_stream]),
        name_bits_(name_bits),
        beyond_gates_(beyond_gates),
        free_(free),
        vertices_(vertices),
        growth_(vertices) {}

  bool leaf(std::uint32_t number, unsigned triangles, index::Leaf& leaf, index::FineLeaf* low) {
    growth_.begin(number, leaf, low);
    Gate gate{};
    Step step = Step::closed;
    while (growth_.triangles() < triangles) {
      if (step == Step::closed && !growth_.pop(gate)) {
        step = seed(gate);
      } else if (const Apex apex = next_apex(); apex != Apex::none) {
        step = beyond(gate, apex);
      } else {
        step = Step::closed;
      }
      if (step == Step::full) return false;
    }
    growth_.finish();
    return name_bits_.within();
  }

  [[nodiscard]] bool finished() const {
    return gates_.finished() && seeds_.finished() && names_.finished() && name_bits_.finished() &&
           beyond_gates_.empty() && free_.empty();
  }

 private:
  Apex next_apex() {
    if (apexes_ == 1) {
      std::uint8_t letter = 0;
      gates_.next(letter);
      apexes_ = apexes_of_letter[letter];
    }
    const auto apex = static_cast<Apex>(apexes_ & 7U);
    apexes_ >>= 3U;
    return apex;
  }

  Step beyond(Gate& gate, Apex apex) {
    const FrontVertex &from = vertices_[gate.from], &to = vertices_[gate.to];
    std::uint16_t v = no_vertex;
    switch (apex) {
      case Apex::fresh: {
        const FrontVertex& across = vertices_[from.across];
        GridPlace near;
        for (int k = 0; k < 3; ++k) near[k] = from.at[k] + to.at[k] - across.at[k];
        v = fresh(beyond_gates_, near);
        return v == no_vertex ? Step::full : growth_.add(gate, Apex::fresh, v);
      }
      case Apex::next:
        v = to.onward();
        return v == no_vertex ? Step::full : growth_.add(gate, Apex::next, v);
      case Apex::previous:
        v = from.backward();
        return v == no_vertex ? Step::full : growth_.add(gate, Apex::previous, v);
      default:
        v = named();
        return v == no_vertex ? Step::full : growth_.add(gate, Apex::other, v);
    }
  }

  /// Adds a triangle that no gate of the leaf reaches.
  Step seed(Gate& gate) {
    std::uint8_t letter = 0;
    if (!seeds_.next(letter) || letter >= seed_letters) return Step::full;
    if (letter < free_seed) {
      const std::uint16_t from = named();
      if (from == no_vertex || !growth_.enter(from, gate)) return Step::full;
      return beyond(gate, static_cast<Apex>(letter + 1));
    }
    std::array<std::uint16_t, 3> corners;
    for (unsigned c = 0; c < 3; ++c) {
      corners[c] = ((letter - free_seed) >> c & 1U) != 0 ? fresh(free_, last_) : named();
      if (corners[c] == no_vertex) return Step::full;
      last_ = vertices_[corners[c]].at;
    }
    return growth_.add(corners);
  }

  /// Reads a vertex by slot or age.
  std::uint16_t named() {
    std::uint8_t letter = 0;
    if (!names_.next(letter)) return no_vertex;
    if (letter < age_name) return letter < growth_.slots() ? growth_.in_slot(letter) : no_vertex;
    const Magnitude m = magnitude_tables[letter - age_name];
    const std::uint32_t age = m.with(name_bits_.peek());
    name_bits_.skip(m.bits);
    return age < count_ ? static_cast<std::uint16_t>(count_ - 1 - age) : no_vertex;
  }

  std::uint16_t fresh(std::span<const GridPlace>& differences, const GridPlace& near) {
    if (differences.empty()) return no_vertex;
    FrontVertex& v = vertices_[count_];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t at = near[k] + differences.front()[k];
      v.at[k] = fine ? at : at & 0xffffU;
    }
    differences = differences.subspan(1);
    v.next = v.previous = v.after = v.before = v.across = v.place = no_vertex;
    return static_cast<std::uint16_t>(count_++);
  }

  Letters gates_, seeds_, names_;
  BitReader name_bits_;
  std::span<const GridPlace> beyond_gates_, free_;  ///< differences of the vertices to come
  FrontVertex* vertices_;
  std::size_t count_ = 0;  ///< of vertices
  Growth<fine> growth_;
  GridPlace last_{};
  std::uint32_t apexes_ = 1;  ///< the remaining ones of the letter, and a one above
};

}  // namespace

struct TileDecoder::State {
  ZSTD_DCtx* zstd = ZSTD_createDCtx();
  TreeBuilder tree;
  std::array<std::byte, most_bytes + overrun> raw;
  std::array<FrontVertex, tile_vertices> vertices;
  std::array<GridPlace, tile_vertices> differences;

  State() : raw{} {
    if (zstd == nullptr) throw std::bad_alloc();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { ZSTD_freeDCtx(zstd); }

  template <bool fine>
  const char* leaves(const std::array<Letters, stream_count>& streams, const StreamSizes& sizes,
                     std::span<index::Leaf> leaves, index::FineLeaf* low, std::uint32_t triangles) {
    const std::span<GridPlace> beyond_gates{differences.data(), sizes.gate_vertices};
    const std::span<GridPlace> free{differences.data() + sizes.gate_vertices, sizes.free_vertices};
    const auto bits = [&streams](Stream s) { return BitReader(streams[s].at(), streams[s].size()); };
    const auto places = [&streams](Stream x) {
      return std::array<const std::byte*, 3>{streams[x].at(), streams[x + 1].at(), streams[x + 2].at()};
    };
    if (!read_differences<fine>(places(gate_x), bits(gate_bit_stream), beyond_gates) ||
        !read_differences<fine>(places(free_x), bits(free_bit_stream), free)) {
      return "its vertices are damaged";
    }
    LeafDecoder<fine> decoder(streams, bits(name_bit_stream), beyond_gates, free, vertices.data());
    Letters counts = streams[count_stream];
    std::uint32_t done = 0;
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
      std::uint8_t letter = 0;
      if (!counts.next(letter) || letter >= index::node_width) return "a leaf has a wrong number of triangles";
      leaves[i].id_bytes = 0;
      leaves[i].ids = done;
      done += letter + 1U;
      if (!decoder.leaf(i, letter + 1U, leaves[i], fine ? low + i : nullptr)) return "its triangles are damaged";
    }
    if (done != triangles) return "it has another number of triangles";
    return decoder.finished() ? nullptr : "there is more in it than a tile needs";
  }
};

TileDecoder::TileDecoder() : state_(std::make_unique<State>()) {}
TileDecoder::~TileDecoder() = default;

const char* TileDecoder::decode(std::span<const std::byte> coded, const TileShape& shape, std::span<std::byte> out) {
  State& s = *state_;
  if (shape.triangles < 1 || shape.triangles > index::most_tile_triangles || shape.nodes < 1 || shape.leaves < 1 ||
      shape.nodes > tile_blocks || shape.leaves > tile_blocks || shape.bytes() > tile_bytes ||
      out.size() < shape.bytes()) {
    return "no tile has this shape";
  }
  StreamSizes n;
  for (std::uint32_t* number :
       {&n.gates, &n.seeds, &n.names, &n.gate_vertices, &n.free_vertices, &n.name_bits, &n.gate_bits, &n.free_bits}) {
    std::uint64_t value = 0;
    if (!read_number(coded, 28, value)) return "its bytes are none of a tile";
    *number = static_cast<std::uint32_t>(value);
  }
  const std::size_t vertex_count = std::size_t{n.gate_vertices} + n.free_vertices;
  if (vertex_count > shape.leaves * index::node_width) return "it has more vertices than its leaves hold";
  const std::array<std::size_t, stream_count> sizes{
      shape.nodes,     shape.leaves,    n.gates,         n.seeds,         n.names,     n.gate_vertices, n.gate_vertices,
      n.gate_vertices, n.free_vertices, n.free_vertices, n.free_vertices, n.name_bits, n.gate_bits,     n.free_bits};
  std::size_t expected = 0;
  for (const std::size_t size : sizes) expected += size;
  if (expected > most_bytes || !is_one_frame(coded) ||
      ZSTD_decompressDCtx(s.zstd, s.raw.data(), most_bytes, coded.data(), coded.size()) != expected) {
    return "its bytes are damaged";
  }
  std::array<Letters, stream_count> streams;
  const std::byte* at = s.raw.data();
  for (int i = 0; i < stream_count; ++i) {
    streams[i] = Letters(at, sizes[i]);
    at += sizes[i];
  }

  const std::span<index::Node> nodes{reinterpret_cast<index::Node*>(out.data()), shape.nodes};
  const std::span<index::Leaf> leaves{reinterpret_cast<index::Leaf*>(nodes.data() + nodes.size()), shape.leaves};
  auto* low = reinterpret_cast<index::FineLeaf*>(leaves.data() + leaves.size());
  if (const char* why = s.tree.topology({s.raw.data(), shape.nodes}, nodes, shape.leaves)) return why;
  if (shape.fine) std::memset(low, 0, shape.bytes() - (nodes.size() + leaves.size()) * sizeof(index::Block));
  if (const char* why = shape.fine ? s.leaves<true>(streams, n, leaves, low, shape.triangles)
                                   : s.leaves<false>(streams, n, leaves, low, shape.triangles)) {
    return why;
  }
  s.tree.refit(nodes, leaves);
  return nullptr;
}

}  // namespace roam::store
