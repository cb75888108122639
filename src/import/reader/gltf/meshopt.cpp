#include "import/reader/gltf/meshopt.h"

#include <meshoptimizer.h>

namespace roam::reader {
namespace {

/// The codecs spend at least two bits on 16 bytes. Tails of streams take less than the rest.
constexpr std::uint64_t most_expansion = 64, tail_bytes = 4096;

bool is_valid(const MeshoptStretch& from) {
  const std::uint64_t stride = from.stride;
  if (stride == 0 || stride > 256) return false;
  if (from.count > (most_expansion * from.bytes.size() + tail_bytes) / stride) return false;
  if (from.mode == "ATTRIBUTES") {
    return stride % 4 == 0 && (from.filter != "OCTAHEDRAL" || stride == 4 || stride == 8) &&
           (from.filter != "QUATERNION" || stride == 8);
  }
  return (stride == 2 || stride == 4) && (from.mode == "INDICES" || (from.mode == "TRIANGLES" && from.count % 3 == 0));
}

}  // namespace

std::optional<std::vector<std::byte>> decode_meshopt(const MeshoptStretch& from) {
  if (!is_valid(from)) return std::nullopt;
  std::vector<std::byte> to(from.count * from.stride);
  if (to.empty()) return to;
  const auto* bytes = reinterpret_cast<const unsigned char*>(from.bytes.data());
  const std::size_t size = from.bytes.size();
  int failed = 0;
  if (from.mode == "ATTRIBUTES") {
    failed = meshopt_decodeVertexBuffer(to.data(), from.count, from.stride, bytes, size);
  } else if (from.mode == "TRIANGLES") {
    failed = meshopt_decodeIndexBuffer(to.data(), from.count, from.stride, bytes, size);
  } else {
    failed = meshopt_decodeIndexSequence(to.data(), from.count, from.stride, bytes, size);
  }
  if (failed != 0) return std::nullopt;
  if (from.mode != "ATTRIBUTES") return to;
  if (from.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(to.data(), from.count, from.stride);
  if (from.filter == "QUATERNION") meshopt_decodeFilterQuat(to.data(), from.count, from.stride);
  if (from.filter == "EXPONENTIAL") meshopt_decodeFilterExp(to.data(), from.count, from.stride);
  return to;
}

}  // namespace roam::reader
