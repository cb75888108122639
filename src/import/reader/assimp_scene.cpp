#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "import/reader/formats.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

/// Nodes inside nodes; more is a damaged file, and would exhaust the stack.
constexpr std::size_t depth_limit = 2000;

/// A 4x4 matrix in doubles: assimp's own are floats, and lose more with each multiplication.
struct Matrix {
  double m[3][4];

  static Matrix identity() { return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}; }
  static Matrix of(const aiMatrix4x4& a) {
    return {{{a.a1, a.a2, a.a3, a.a4}, {a.b1, a.b2, a.b3, a.b4}, {a.c1, a.c2, a.c3, a.c4}}};
  }
  Matrix operator*(const Matrix& b) const {
    Matrix product{};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 4; ++j) {
        for (int k = 0; k < 3; ++k) product.m[i][j] += m[i][k] * b.m[k][j];
      }
      product.m[i][3] += m[i][3];
    }
    return product;
  }
  Vec3 operator*(const aiVector3D& v) const {
    Vec3 p;
    for (int i = 0; i < 3; ++i) p[i] = m[i][0] * v.x + m[i][1] * v.y + m[i][2] * v.z + m[i][3];
    return p;
  }
};

class AssimpWalk {
 public:
  AssimpWalk(const aiScene& scene, std::string path, std::string stem, MeshSink& sink)
      : scene_(scene), path_(std::move(path)), stem_(std::move(stem)), sink_(sink) {}

  void walk(const aiNode& node, const Matrix& parent) {
    if (names_.size() >= depth_limit) {
      throw Error(fmt::format("{}: its nodes are nested more than {} deep; the file is damaged.", path_, depth_limit));
    }
    const Matrix to_world = parent * Matrix::of(node.mTransformation);
    names_.emplace_back(node.mName.C_Str());
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] < scene_.mNumMeshes) add_mesh(*scene_.mMeshes[node.mMeshes[i]], to_world);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], to_world);
    names_.pop_back();
  }

 private:
  void add_mesh(const aiMesh& mesh, const Matrix& to_world) {
    names_.emplace_back(mesh.mName.C_Str());
    sink_.begin_object(names_, stem_);
    const std::uint32_t first = sink_.vertex_count();
    const unsigned count = mesh.mVertices == nullptr ? 0 : mesh.mNumVertices;
    for (unsigned i = 0; i < count; ++i) sink_.add_vertex(to_world * mesh.mVertices[i]);
    const auto corner = [&](unsigned index) {
      return index < count ? first + index : std::numeric_limits<std::uint32_t>::max();
    };
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned i = 2; i < face.mNumIndices; ++i) {
        sink_.add_triangle(corner(face.mIndices[0]), corner(face.mIndices[i - 1]), corner(face.mIndices[i]));
      }
    }
    names_.pop_back();
  }

  const aiScene& scene_;
  std::string path_;
  std::string stem_;
  MeshSink& sink_;
  std::vector<std::string> names_;
};

}  // namespace

void read_assimp(const std::filesystem::path& path, const std::string& extension, MeshSink& sink) {
  const bool ifc = extension == "ifc";
  if (extension == "glb" || extension == "gltf") sink.set_format_up(UpAxis::y);

  Assimp::Importer importer;
  // IFC's faces are concave as often as not; in other formats polygons are fanned as everywhere in roam.
  const aiScene* scene = importer.ReadFile(path.string(), ifc ? static_cast<unsigned>(aiProcess_Triangulate) : 0u);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw Error(
        fmt::format("{}: assimp cannot read this file ({}); it is damaged, or not of the format that its name "
                    "says.",
                    path.string(), importer.GetErrorString()));
  }
  sink.count_file();
  // assimp turns IFC, whose z axis is up, to y up; this turns it back: (x, y, z) -> (x, -z, y).
  const Matrix upright{{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}};
  AssimpWalk(*scene, path.string(), path.stem().string(), sink)
      .walk(*scene->mRootNode, ifc ? upright : Matrix::identity());
}

}  // namespace roam::reader
