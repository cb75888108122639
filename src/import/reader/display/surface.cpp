#include "import/reader/display/surface.h"

#include <algorithm>
#include <numeric>

namespace roam::reader {
namespace {

/// Metres. Floats are precise to a tenth of a millimetre over this size. Only a chunk of few triangles may be larger.
constexpr double chunk_size = 2000.0;
constexpr std::size_t few_triangles = 256;

class Cutter {
 public:
  Cutter(const Surface& surface, std::vector<std::span<const std::uint32_t>>& chunks)
      : surface_(surface), chunks_(chunks) {}

  void cut(std::span<std::uint32_t> triangles) {
    if (triangles.size() <= few_triangles) return finish(triangles);
    Box box;
    for (const std::uint32_t t : triangles) box.include(centre(t));
    const Vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (triangles.size() <= chunk_triangles && size[axis] <= chunk_size) return finish(triangles);
    const auto middle = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
    std::nth_element(triangles.begin(), middle, triangles.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double ca = centre(a)[axis], cb = centre(b)[axis];
      return ca != cb ? ca < cb : a < b;
    });
    cut(triangles.first(triangles.size() / 2));
    cut(triangles.subspan(triangles.size() / 2));
  }

 private:
  /// Triangles of one object follow each other, as in the file.
  void finish(std::span<std::uint32_t> triangles) {
    std::sort(triangles.begin(), triangles.end());
    chunks_.emplace_back(triangles);
  }
  [[nodiscard]] Vec3 centre(std::uint32_t triangle) const {
    const Corners& c = surface_.triangles[triangle];
    return (surface_.vertices[c[0]] + surface_.vertices[c[1]] + surface_.vertices[c[2]]) / 3.0;
  }

  const Surface& surface_;
  std::vector<std::span<const std::uint32_t>>& chunks_;
};

}  // namespace

std::vector<std::span<const std::uint32_t>> cut_into_chunks(const Surface& surface, std::vector<std::uint32_t>& order) {
  order.resize(surface.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<std::span<const std::uint32_t>> chunks;
  if (!order.empty()) Cutter(surface, chunks).cut(order);
  return chunks;
}

}  // namespace roam::reader
