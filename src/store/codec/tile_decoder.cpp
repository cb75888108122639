#include <zstd.h>

#include <cstring>
#include <new>

#include "index/partition.h"
#include "store/codec/front.h"
#include "store/codec/magnitude.h"
#include "store/codec/streams.h"

namespace roam::store {
namespace {

/// More than the streams of any tile: three classes and three times 30 bits a vertex, and what else there is.
constexpr std::size_t kMostBytes = kTileVertices * 15 + kTileBytes;
/// How far a leaf that does not end in time reads beyond its streams.
constexpr std::size_t kOverrun = 1024;

/// The numbers before the frame, seven bits a byte, the lowest first.
bool read_number(std::span<const std::byte>& coded, std::uint32_t& number) {
  number = 0;
  for (int shift = 0; shift < 28 && !coded.empty(); shift += 7) {
    const auto byte = std::to_integer<std::uint32_t>(coded.front());
    coded = coded.subspan(1);
    number |= (byte & 127U) << shift;
    if (byte < 128) return true;
  }
  return false;
}

/// Letters, one after the other. Beyond the end of the stream all are zero.
class Letters {
 public:
  Letters() = default;
  Letters(const std::byte* begin, std::size_t size) : at_(begin), end_(begin + size) {}
  [[nodiscard]] const std::byte* at() const { return at_; }
  bool next(std::uint8_t& letter) {
    if (at_ == end_) return false;
    letter = std::to_integer<std::uint8_t>(*at_++);
    return true;
  }
  [[nodiscard]] bool finished() const { return at_ == end_; }

 private:
  const std::byte *at_ = nullptr, *end_ = nullptr;
};

/// What a class stands for, in a table. Letters that are no class are as good as zero.
struct Magnitude {
  std::uint32_t base, bits;
  [[nodiscard]] std::uint32_t with(std::uint64_t word) const {
    return base + (static_cast<std::uint32_t>(word) & ((1U << bits) - 1));
  }
};
constexpr auto magnitudes() {
  std::array<Magnitude, 256> table{};
  for (std::uint32_t c = 0; c < kClasses; ++c) table[c] = {base_of(c), bits_of(c)};
  return table;
}
constexpr std::array<Magnitude, 256> kMagnitudes = magnitudes();

/// The three Apex of a letter of kGates, three bits each, and a one above.
constexpr auto apexes() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned l = 0; l < 256; ++l) {
    const unsigned known = l < kApexes * kApexes * kApexes ? l : 0;
    table[l] = static_cast<std::uint16_t>(known % kApexes | known / kApexes % kApexes << 3U |
                                          known / kApexes / kApexes << 6U | 1U << 9U);
  }
  return table;
}
constexpr std::array<std::uint16_t, 256> kApexesOfLetter = apexes();

/// The three streams of classes of vertices that are predicted alike.
struct VertexLetters {
  std::array<const std::byte*, 3> at;
  std::size_t left;
  Magnitude next(int k) { return kMagnitudes[std::to_integer<std::size_t>(*at[k]++)]; }
};

/// Fills the leaves of a tile from its streams.
template <bool fine>
class LeafDecoder {
 public:
  LeafDecoder(const std::array<Letters, kBits>& letters, const StreamSizes& sizes, BitReader bits,
              FrontVertex* vertices)
      : gates_(letters[kGates]),
        seeds_(letters[kSeeds]),
        names_(letters[kNames]),
        gate_vertices_{{letters[kGateX].at(), letters[kGateY].at(), letters[kGateZ].at()}, sizes.gate_vertices},
        free_vertices_{{letters[kFreeX].at(), letters[kFreeY].at(), letters[kFreeZ].at()}, sizes.free_vertices},
        bits_(bits),
        vertices_(vertices),
        growth_(vertices) {}

  bool leaf(std::uint32_t number, unsigned triangles, index::Leaf& leaf, index::FineLeaf* low) {
    growth_.begin(number, leaf, low);
    while (growth_.triangles() < triangles) {
      Gate gate{};
      if (growth_.pop(gate)) {
        const Apex apex = next_apex();
        if (apex != Apex::none && !beyond(gate, apex)) return false;
      } else if (!seed()) {
        return false;
      }
    }
    growth_.finish();
    return bits_.within();
  }

  [[nodiscard]] bool finished() const {
    return gates_.finished() && seeds_.finished() && names_.finished() && gate_vertices_.left == 0 &&
           free_vertices_.left == 0 && bits_.finished();
  }

 private:
  Apex next_apex() {
    if (apexes_ == 1) {
      std::uint8_t letter = 0;
      gates_.next(letter);
      apexes_ = kApexesOfLetter[letter];
    }
    const auto apex = static_cast<Apex>(apexes_ & 7U);
    apexes_ >>= 3U;
    return apex;
  }

  bool beyond(const Gate& gate, Apex apex) {
    const FrontVertex &from = vertices_[gate.from], &to = vertices_[gate.to];
    std::uint16_t v = kNoVertex;
    switch (apex) {
      case Apex::fresh: {
        const FrontVertex& across = vertices_[from.across];
        std::array<std::uint32_t, 3> near;
        for (int k = 0; k < 3; ++k) near[k] = from.at[k] + to.at[k] - across.at[k];
        v = fresh(gate_vertices_, near);
        return v != kNoVertex && growth_.add(gate, Apex::fresh, v);
      }
      case Apex::next:
        v = to.onward();
        return v != kNoVertex && growth_.add(gate, Apex::next, v);
      case Apex::previous:
        v = from.backward();
        return v != kNoVertex && growth_.add(gate, Apex::previous, v);
      default:
        v = named();
        return v != kNoVertex && growth_.add(gate, Apex::other, v);
    }
  }

  bool seed() {
    std::uint8_t letter = 0;
    if (!seeds_.next(letter) || letter >= kSeedLetters) return false;
    if (letter < kFreeSeed) {
      const std::uint16_t from = named();
      Gate gate{};
      return from != kNoVertex && growth_.enter(from, gate) && beyond(gate, static_cast<Apex>(letter + 1));
    }
    std::array<std::uint16_t, 3> corners;
    for (unsigned c = 0; c < 3; ++c) {
      corners[c] = (letter - kFreeSeed) >> c & 1U ? fresh(free_vertices_, last_) : named();
      if (corners[c] == kNoVertex) return false;
      last_ = vertices_[corners[c]].at;
    }
    return growth_.add(corners);
  }

  /// A vertex by slot or age.
  std::uint16_t named() {
    std::uint8_t letter = 0;
    if (!names_.next(letter)) return kNoVertex;
    if (letter < kAgeName) return letter < growth_.slots() ? growth_.in_slot(letter) : kNoVertex;
    const Magnitude m = kMagnitudes[letter - kAgeName];
    const std::uint32_t age = m.with(bits_.peek());
    bits_.skip(m.bits);
    return age < count_ ? static_cast<std::uint16_t>(count_ - 1 - age) : kNoVertex;
  }

  std::uint16_t fresh(VertexLetters& letters, const std::array<std::uint32_t, 3>& near) {
    if (letters.left == 0) return kNoVertex;
    --letters.left;
    const std::array<Magnitude, 3> m{letters.next(0), letters.next(1), letters.next(2)};
    FrontVertex& v = vertices_[count_];
    std::uint64_t word = bits_.peek();
    for (int k = 0; k < 3; ++k) {
      if (fine && k > 0) word = bits_.peek();  // three numbers of 16 bits are in one word, of 32 bits not
      const std::uint32_t at = near[k] + unzigzag(m[k].with(word));
      v.at[k] = fine ? at : at & 0xffffU;
      word >>= m[k].bits;
      bits_.skip(m[k].bits);
    }
    v.next = v.previous = v.after = v.before = v.across = v.place = kNoVertex;
    return static_cast<std::uint16_t>(count_++);
  }

  Letters gates_, seeds_, names_;
  VertexLetters gate_vertices_, free_vertices_;
  BitReader bits_;
  FrontVertex* vertices_;
  std::size_t count_ = 0;  ///< of vertices
  Growth<fine> growth_;
  std::array<std::uint32_t, 3> last_{};
  std::uint32_t apexes_ = 1;  ///< those of the letter that are left, and a one above
};

}  // namespace

struct TileDecoder::State {
  ZSTD_DCtx* zstd = ZSTD_createDCtx();
  TreeBuilder tree;
  std::array<std::byte, kMostBytes + kOverrun> raw;
  std::array<FrontVertex, kTileVertices> vertices;

  State() : raw{} {
    if (zstd == nullptr) throw std::bad_alloc();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { ZSTD_freeDCtx(zstd); }

  template <bool fine>
  const char* leaves(const std::array<Letters, kBits>& letters, BitReader bits, std::span<index::Leaf> leaves,
                     index::FineLeaf* low, std::uint32_t triangles, const StreamSizes& sizes) {
    LeafDecoder<fine> decoder(letters, sizes, bits, vertices.data());
    Letters counts = letters[kCounts];
    std::uint32_t done = 0;
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
      std::uint8_t letter = 0;
      if (!counts.next(letter) || letter >= index::kWidth) return "a leaf has a wrong number of triangles";
      leaves[i] = {};
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
  if (shape.triangles < 1 || shape.triangles > index::kTileTriangles || shape.nodes < 1 || shape.leaves < 1 ||
      shape.nodes > kTileBlocks || shape.leaves > kTileBlocks || shape.bytes() > kTileBytes ||
      out.size() < shape.bytes()) {
    return "no tile has this shape";
  }
  StreamSizes n;
  for (std::uint32_t* number : {&n.gates, &n.seeds, &n.names, &n.gate_vertices, &n.free_vertices, &n.bits}) {
    if (!read_number(coded, *number)) return "its bytes are none of a tile";
  }
  const std::size_t vertex_count = std::size_t{n.gate_vertices} + n.free_vertices;
  if (vertex_count > shape.leaves * index::kWidth) return "it has more vertices than its leaves hold";
  const std::array<std::size_t, kStreams> sizes{shape.nodes,     shape.leaves,    n.gates,         n.seeds,
                                                n.names,         n.gate_vertices, n.gate_vertices, n.gate_vertices,
                                                n.free_vertices, n.free_vertices, n.free_vertices, n.bits};
  std::size_t expected = 0;
  for (const std::size_t size : sizes) expected += size;
  // The library would allocate for frames of older formats, and look into a second frame.
  static constexpr unsigned char magic[] = {0x28, 0xb5, 0x2f, 0xfd};
  if (expected > kMostBytes || coded.size() < sizeof(magic) || std::memcmp(coded.data(), magic, sizeof(magic)) != 0 ||
      ZSTD_findFrameCompressedSize(coded.data(), coded.size()) != coded.size() ||
      ZSTD_decompressDCtx(s.zstd, s.raw.data(), kMostBytes, coded.data(), coded.size()) != expected) {
    return "its bytes are damaged";
  }
  std::array<Letters, kBits> letters;
  const std::byte* at = s.raw.data();
  for (int i = 0; i < kBits; ++i) {
    letters[i] = Letters(at, sizes[i]);
    at += sizes[i];
  }
  const BitReader bits(at, n.bits);

  const std::span<index::Node> nodes{reinterpret_cast<index::Node*>(out.data()), shape.nodes};
  const std::span<index::Leaf> leaves{reinterpret_cast<index::Leaf*>(nodes.data() + nodes.size()), shape.leaves};
  auto* low = reinterpret_cast<index::FineLeaf*>(leaves.data() + leaves.size());
  if (const char* why = s.tree.topology({s.raw.data(), shape.nodes}, nodes, shape.leaves)) return why;
  if (shape.fine) std::memset(low, 0, shape.bytes() - (nodes.size() + leaves.size()) * sizeof(index::Block));
  if (const char* why = shape.fine ? s.leaves<true>(letters, bits, leaves, low, shape.triangles, n)
                                   : s.leaves<false>(letters, bits, leaves, low, shape.triangles, n)) {
    return why;
  }
  s.tree.refit(nodes, leaves);
  return nullptr;
}

}  // namespace roam::store
