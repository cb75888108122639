#include "verify/verify_stored.h"

#include <algorithm>
#include <glm/common.hpp>

#include "roam/error.h"
#include "store/meshes.h"

namespace roam::verification {
namespace {

/// Metres. Pieces are checked together while they stay this near to each other.
constexpr double stretch = 100.0;
/// Pieces in memory at a time: 1.3 MB.
constexpr std::size_t pieces_together = 16'384;

Box box_of(std::span<const Piece> pieces) {
  Box box;
  for (const Piece& piece : pieces) {
    const double reach = std::max(piece.body.radius, piece.clearance) + piece.body.half_height;
    box.include(Box{glm::min(piece.from, piece.to), glm::max(piece.from, piece.to)}.grown(reach));
  }
  return box;
}

/// The end of the pieces from `begin` that stay near to each other. Never splits a step.
std::size_t end_of_stretch(std::span<const Piece> pieces, std::size_t begin) {
  Box box;
  std::size_t end = begin;
  for (std::size_t i = begin; i < pieces.size(); ++i) {
    box.include(pieces[i].from);
    box.include(pieces[i].to);
    const Vec3 size = box.size();
    if (end > begin && std::max({size.x, size.y, size.z}) > stretch) return end;
    if (i + 1 == pieces.size() || pieces[i + 1].step != pieces[i].step) end = i + 1;
  }
  return pieces.size();
}

/// Calls `go_on` now and then.
Verification verify_stretch(const Store& store, std::span<const Piece> pieces, const std::function<void()>& go_on) {
  Verifier verifier(pieces);
  std::vector<std::string> unread;
  TriangleId first = 0;
  const auto check = [&](const Mesh& some) {
    go_on();
    verifier.check({&some, 1}, first);
    first += some.triangles.size();
  };
  store::each_mesh(store, box_of(pieces), check, [&](const std::string& what) { unread.push_back(what); });
  Verification found = verifier.result();
  found.unread = std::move(unread);
  return found;
}

}  // namespace

Verification verify(const Store& store, const PieceLog& pieces, const std::function<bool(std::uint64_t)>& progress) {
  Verification all;
  all.scene = store.info().bounds;
  const auto go_on = [&] {
    if (progress && !progress(all.pieces)) throw Cancelled();
  };
  pieces.each(pieces_together, [&](std::span<const Piece> some) {
    for (std::size_t begin = 0; begin < some.size();) {
      const std::size_t end = end_of_stretch(some, begin);
      all.add(verify_stretch(store, some.subspan(begin, end - begin), go_on));
      begin = end;
      go_on();
    }
  });
  return all;
}

}  // namespace roam::verification
