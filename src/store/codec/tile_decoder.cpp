#include <zstd.h>

#include <cstring>
#include <new>

#include "index/partition.h"
#include "store/codec/tile_codec.h"
#include "store/codec/tree_shape.h"

namespace roam::store {

struct TileDecoder::State {
  ZSTD_DCtx* zstd = ZSTD_createDCtx();
  TreeBuilder tree;
  std::array<std::byte, 2 * kTileBytes> raw;
  std::array<std::uint16_t, kTileBlocks> counts;

  State() {
    if (zstd == nullptr) throw std::bad_alloc();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { ZSTD_freeDCtx(zstd); }
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
  // The one format of frame that the library decodes without allocating.
  static constexpr unsigned char magic[] = {0x28, 0xb5, 0x2f, 0xfd};
  if (coded.size() < sizeof(magic) || std::memcmp(coded.data(), magic, sizeof(magic)) != 0 ||
      ZSTD_findFrameCompressedSize(coded.data(), coded.size()) != coded.size()) {
    return "its bytes are not compressed as those of a tile";
  }
  const std::size_t per_leaf =
      sizeof(index::Leaf::vertex) + sizeof(index::Leaf::corner) + 1 + (shape.fine ? sizeof(index::FineLeaf) : 0);
  const std::size_t size = ZSTD_decompressDCtx(s.zstd, s.raw.data(), s.raw.size(), coded.data(), coded.size());
  if (size != shape.nodes * 2 + shape.leaves * per_leaf) return "its bytes are damaged";
  const std::byte* at = s.raw.data();
  const auto get = [&at](auto& value) {
    std::memcpy(&value, at, sizeof(value));
    at += sizeof(value);
  };
  const std::span<index::Node> nodes{reinterpret_cast<index::Node*>(out.data()), shape.nodes};
  const std::span<index::Leaf> leaves{reinterpret_cast<index::Leaf*>(nodes.data() + nodes.size()), shape.leaves};
  auto* fine = reinterpret_cast<index::FineLeaf*>(leaves.data() + leaves.size());
  for (std::uint32_t i = 0; i < shape.nodes; ++i) get(s.counts[i]);
  if (const char* why = s.tree.topology({s.counts.data(), shape.nodes}, nodes, shape.leaves)) return why;
  if (shape.fine) std::memset(fine, 0, shape.bytes() - (nodes.size() + leaves.size()) * sizeof(index::Block));
  std::uint32_t triangles = 0;
  for (index::Leaf& leaf : leaves) {
    leaf = {};
    get(leaf.vertex);
    get(leaf.corner);
    get(leaf.triangle_count);
    if (leaf.triangle_count < 1 || leaf.triangle_count > index::kWidth) return "a leaf has a wrong count";
    leaf.ids = triangles;
    triangles += leaf.triangle_count;
    if (shape.fine) get(*fine++);
  }
  if (triangles != shape.triangles) return "it has another number of triangles";
  s.tree.refit(nodes, leaves);
  return nullptr;
}

}  // namespace roam::store
