#include "import/assembler.h"

#include <utility>

namespace roam::reader {
namespace {

template <class T>
std::vector<T> joined(std::vector<std::vector<T>>& pieces) {
  if (pieces.size() == 1) {
    std::vector<T> only = std::move(pieces.front());
    pieces.clear();
    return only;
  }
  std::size_t count = 0;
  for (const auto& piece : pieces) count += piece.size();
  std::vector<T> all;
  all.reserve(count);
  for (auto& piece : pieces) {
    all.insert(all.end(), piece.begin(), piece.end());
    std::vector<T>().swap(piece);
  }
  pieces.clear();
  return all;
}

}  // namespace

void Assembler::begin(std::string name, bool continues) {
  if (continues) throw StreamDamaged{"a piece of a mesh instead of a whole one"};
  name_ = std::move(name);
}

void Assembler::finish() {
  Mesh mesh;
  mesh.name = std::exchange(name_, {});
  mesh.vertices = joined(vertex_pieces_);
  mesh.triangles = joined(triangle_pieces_);
  if (mesh.triangles.empty()) return;
  scene_.report.vertices += mesh.vertices.size();
  scene_.report.triangles += mesh.triangles.size();
  scene_.meshes.push_back(std::move(mesh));
}

}  // namespace roam::reader
