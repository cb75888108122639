#include "import/piece_receiver.h"

#include <utility>

namespace roam::reader {
namespace {

/// Room for more values, up to `limit` in all.
template <class T>
std::span<T> more(std::size_t count, std::size_t limit, std::vector<T>& values) {
  if (count > limit - values.size()) throw StreamReceiver::StreamDamaged{"a piece that is too large"};
  values.resize(values.size() + count);
  return std::span(values).last(count);
}

}  // namespace

void PieceReceiver::begin(std::string name, bool continues) {
  if (continues && (triangles() == 0 || name != piece_.name)) throw StreamDamaged{"a piece of no object"};
  continues_ = continues;
  piece_.name = std::move(name);
}

std::span<Vec3> PieceReceiver::more_vertices(std::size_t count) {
  return more(count, 3 * piece_triangles, piece_.vertices);
}

std::span<PieceReceiver::Corners> PieceReceiver::more_triangles(std::size_t count) {
  return more(count, piece_triangles, piece_.triangles);
}

void PieceReceiver::finish() {
  if (piece_.triangles.empty()) throw StreamDamaged{"a piece without triangles"};
  report_.vertices += piece_.vertices.size();
  report_.triangles += piece_.triangles.size();
  sink_(piece_, continues_);
  piece_.vertices.clear();
  piece_.triangles.clear();
}

}  // namespace roam::reader
