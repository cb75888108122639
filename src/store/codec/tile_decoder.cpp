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
  bool next(std::uint8_t& letter) {
    if (at_ == end_) return false;
    letter = std::to_integer<std::uint8_t>(*at_++);
    return true;
  }
  [[nodiscard]] bool finished() const { return at_ == end_; }

 private:
  const std::byte *at_ = nullptr, *end_ = nullptr;
};

/// What a class stands for, in a table.
struct Magnitude {
  std::uint32_t base, bits;
};
constexpr auto magnitudes() {
  std::array<Magnitude, 256> table{};
  for (std::uint32_t c = 0; c < kClasses; ++c) {
    table[c] = {c < kOwnClass ? c : (4 + (c & 3U)) << ((c - kOwnClass) / 4 + 1),
                c < kOwnClass ? 0 : (c - kOwnClass) / 4 + 1};
  }
  return table;
}
constexpr std::array<Magnitude, 256> kMagnitudes = magnitudes();

/// Fills the leaves of a tile from its streams.
template <bool fine>
class LeafDecoder {
 public:
  LeafDecoder(const std::array<Letters, kBits>& letters, BitReader bits, FrontVertex* vertices, std::size_t limit)
      : letters_(letters), bits_(bits), vertices_(vertices), limit_(limit), growth_(vertices) {}

  bool leaf(std::uint32_t number, int triangles, index::Leaf& leaf, index::FineLeaf* low) {
    growth_.begin(number, leaf, low);
    while (growth_.triangles() < triangles) {
      Gate gate;
      if (growth_.pop(gate)) {
        const unsigned apex = next_apex();
        if (apex != 0 && !beyond(gate, static_cast<Apex>(apex))) return false;
      } else if (!seed()) {
        return false;
      }
    }
    growth_.template finish<fine>();
    return bits_.within();
  }

  [[nodiscard]] bool finished() const {
    bool all = bits_.finished();
    for (int s = kGates; s < kBits; ++s) all = all && letters_[s].finished();
    return all;
  }

 private:
  unsigned next_apex() {
    if (left_in_letter_ == 0) {
      if (!letters_[kGates].next(letter_)) letter_ = 0;
      left_in_letter_ = 3;
    }
    --left_in_letter_;
    const unsigned apex = letter_ % kApexes;
    letter_ /= kApexes;
    return apex;
  }

  bool beyond(const Gate& gate, Apex apex) {
    std::uint16_t v = kNoVertex;
    switch (apex) {
      case Apex::fresh: {
        const FrontVertex &from = vertices_[gate.from], &to = vertices_[gate.to], &across = vertices_[from.across];
        std::array<std::uint32_t, 3> near;
        for (int k = 0; k < 3; ++k) near[k] = from.at[k] + to.at[k] - across.at[k];
        v = fresh(kGateX, near);
        break;
      }
      case Apex::next:
        v = vertices_[gate.to].next;
        break;
      case Apex::previous:
        v = vertices_[gate.from].previous;
        break;
      default:
        v = named();
    }
    return v != kNoVertex && growth_.add(gate.to, gate.from, v);
  }

  bool seed() {
    std::uint8_t letter = 0;
    if (!letters_[kSeeds].next(letter) || letter >= kSeedLetters) return false;
    if (letter < kFreeSeed) {
      Gate gate;
      gate.from = named();
      if (gate.from == kNoVertex) return false;
      gate.to = vertices_[gate.from].next;
      return gate.to != kNoVertex && beyond(gate, static_cast<Apex>(letter + 1));
    }
    std::array<std::uint16_t, 3> corners;
    for (unsigned c = 0; c < 3; ++c) {
      corners[c] = (letter - kFreeSeed) >> c & 1U ? fresh(kFreeX, last_) : named();
      if (corners[c] == kNoVertex) return false;
      last_ = vertices_[corners[c]].at;
    }
    return growth_.add(corners[0], corners[1], corners[2]);
  }

  /// A vertex by slot or age.
  std::uint16_t named() {
    std::uint8_t letter = 0;
    if (!letters_[kNames].next(letter)) return kNoVertex;
    if (letter < kAgeName) return static_cast<int>(letter) < growth_.slots() ? growth_.in_slot(letter) : kNoVertex;
    const Magnitude m = kMagnitudes[letter - kAgeName];
    const std::uint32_t age = m.base + bits_.get(m.bits);
    return age < count_ ? static_cast<std::uint16_t>(count_ - 1 - age) : kNoVertex;
  }

  std::uint16_t fresh(int stream, const std::array<std::uint32_t, 3>& near) {
    if (count_ == limit_ || !bits_.within()) return kNoVertex;
    FrontVertex& v = vertices_[count_];
    for (int k = 0; k < 3; ++k) {
      std::uint8_t letter = 0;
      if (!letters_[stream + k].next(letter)) return kNoVertex;
      const Magnitude m = kMagnitudes[letter];
      const std::uint32_t at = near[k] + unzigzag(m.base + bits_.get(m.bits));
      v.at[k] = fine ? at : at & 0xffffU;
    }
    v.next = v.previous = v.across = v.place = kNoVertex;
    return static_cast<std::uint16_t>(count_++);
  }

  std::array<Letters, kBits> letters_;
  BitReader bits_;
  FrontVertex* vertices_;
  std::size_t limit_, count_ = 0;
  Growth growth_;
  std::array<std::uint32_t, 3> last_{};
  std::uint8_t letter_ = 0, left_in_letter_ = 0;
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
                     index::FineLeaf* low, std::uint32_t triangles, std::size_t vertex_count) {
    LeafDecoder<fine> decoder(letters, bits, vertices.data(), vertex_count);
    Letters counts = letters[kCounts];
    std::uint32_t done = 0;
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
      std::uint8_t letter = 0;
      if (!counts.next(letter) || letter >= index::kWidth) return "a leaf has a wrong number of triangles";
      leaves[i] = {};
      leaves[i].ids = done;
      done += letter + 1U;
      if (!decoder.leaf(i, letter + 1, leaves[i], fine ? low + i : nullptr)) return "its triangles are damaged";
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
  if (const char* why = shape.fine ? s.leaves<true>(letters, bits, leaves, low, shape.triangles, vertex_count)
                                   : s.leaves<false>(letters, bits, leaves, low, shape.triangles, vertex_count)) {
    return why;
  }
  s.tree.refit(nodes, leaves);
  return nullptr;
}

}  // namespace roam::store
