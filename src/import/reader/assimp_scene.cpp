#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "import/reader/display/assimp_looks.h"
#include "import/reader/formats.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

/// Limit of nesting. A deeper file is damaged, and would exhaust the stack.
constexpr std::size_t depth_limit = 2000;

/// A 4x4 matrix in doubles. assimp's matrices are floats and lose precision with each multiplication.
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
  /// The images of the axes, as columns.
  [[nodiscard]] glm::dmat3 linear() const {
    glm::dmat3 columns;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) columns[j][i] = m[i][j];
    }
    return columns;
  }
  Vec3 operator*(const aiVector3D& v) const {
    Vec3 p;
    for (int i = 0; i < 3; ++i) p[i] = m[i][0] * v.x + m[i][1] * v.y + m[i][2] * v.z + m[i][3];
    return p;
  }
};

/// The node's name in the file. assimp names unnamed roots "<GLTFRoot>" and the like.
std::string name_of(const aiNode& node) {
  std::string name = node.mName.C_Str();
  return name.starts_with('<') && name.ends_with('>') ? std::string() : name;
}

class AssimpWalk {
 public:
  /// `looks`: null unless looks are requested.
  AssimpWalk(const aiScene& scene, std::string path, std::string stem, AssimpLooks* looks, MeshSink& sink)
      : scene_(scene), path_(std::move(path)), stem_(std::move(stem)), looks_(looks), sink_(sink) {}

  void walk(const aiNode& node, const Matrix& parent) { walk_in(node, parent * Matrix::of(node.mTransformation)); }

  /// Walks a node with `to_world` in place of its own and its ancestors' transforms.
  void walk_in(const aiNode& node, const Matrix& to_world) {
    if (names_.size() >= depth_limit) {
      throw Error(path_, fmt::format("its nodes are nested more than {} deep; the file is damaged.", depth_limit));
    }
    names_.push_back(name_of(node));
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] < scene_.mNumMeshes) add_mesh(*scene_.mMeshes[node.mMeshes[i]], to_world);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], to_world);
    names_.pop_back();
  }

 private:
  void add_mesh(const aiMesh& mesh, const Matrix& to_world) {
    // People name the node; several nodes may share its mesh.
    names_.insert(names_.end() - 1, mesh.mName.C_Str());
    sink_.begin_object(names_, stem_);
    index_.clear();
    if (looks_ != nullptr) looks_->begin_mesh(mesh, to_world.linear());
    const unsigned count = mesh.mVertices == nullptr ? 0 : mesh.mNumVertices;
    // Most of assimp's readers give each face its own corners.
    for (unsigned i = 0; i < count; ++i) {
      const Vec3 v = to_world * mesh.mVertices[i];
      // assimp's vertices and transforms are both floats.
      for (int k = 0; k < 3; ++k) sink_.note_rounded(v[k]);
      index_.push_back(sink_.add_shared_vertex(v, looks_ == nullptr ? VertexLook{} : looks_->of(i)));
    }
    const auto corner = [&](unsigned i) { return i < count ? index_[i] : std::numeric_limits<std::uint32_t>::max(); };
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned i = 2; i < face.mNumIndices; ++i) {
        sink_.add_triangle(corner(face.mIndices[0]), corner(face.mIndices[i - 1]), corner(face.mIndices[i]));
      }
    }
    names_.erase(names_.end() - 2);
  }

  const aiScene& scene_;
  std::string path_;
  std::string stem_;
  AssimpLooks* looks_;
  MeshSink& sink_;
  std::vector<std::string> names_;
  std::vector<std::uint32_t> index_;  ///< of each vertex of the mesh, in the sink's object
};

/// Lets assimp open only the scene's files, and write none.
class AssimpFiles : public Assimp::DefaultIOSystem {
 public:
  explicit AssimpFiles(SceneFiles& files) : files_(files) {}

  bool Exists(const char* name) const override { return !files_.look_up(name).empty(); }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (!files_.resolve(name)) files_.leave_out(name);
    const std::filesystem::path file = files_.open(name);
    return file.empty() || mode == nullptr || *mode != 'r' ? nullptr : DefaultIOSystem::Open(file.c_str(), "rb");
  }

 private:
  SceneFiles& files_;
};

/// Whether `word` is one of the words, separated by blanks.
bool lists(std::string_view words, std::string_view word) {
  while (!words.empty()) {
    const auto end = std::min(words.find(' '), words.size());
    if (words.substr(0, end) == word) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

/// Leaves only assimp's readers of this format. Otherwise assimp would guess a format from the contents.
void keep_format(Assimp::Importer& importer, const std::string& extension) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    if (lists(importer.GetImporterInfo(i)->mFileExtensions, extension)) continue;
    Assimp::BaseImporter* other = importer.GetImporter(i);
    importer.UnregisterLoader(other);
    delete other;
  }
}

/// The integer or real number of `key` in the file's metadata.
std::optional<double> stated_number(const aiScene& scene, const char* key) {
  if (scene.mMetaData == nullptr) return std::nullopt;
  for (unsigned i = 0; i < scene.mMetaData->mNumProperties; ++i) {
    if (std::strcmp(scene.mMetaData->mKeys[i].C_Str(), key) != 0) continue;
    const aiMetadataEntry& entry = scene.mMetaData->mValues[i];
    if (entry.mType == AI_INT32) return *static_cast<const std::int32_t*>(entry.mData);
    if (entry.mType == AI_FLOAT) return static_cast<double>(*static_cast<const float*>(entry.mData));
    if (entry.mType == AI_DOUBLE) return *static_cast<const double*>(entry.mData);
  }
  return std::nullopt;
}

/// Collada: assimp converts the file's up axis to y and its unit to metres by the transform of the root. The root (the
/// visual_scene) has no transform of its own.
void compare_collada(const aiMatrix4x4& root, const std::string& file, MeshSink& sink) {
  const double unit = std::hypot(root.a1, root.b1, root.c1);
  const UpAxis up = root.b3 != 0.0f ? UpAxis::z : root.b1 != 0.0f ? UpAxis::x : UpAxis::y;
  sink.compare_with_stated(up, unit, file);
}

/// FBX: assimp keeps the file's numbers and passes its metadata on. Its unit is in centimetres.
void compare_fbx(const aiScene& scene, const std::string& file, MeshSink& sink) {
  std::optional<UpAxis> up;
  if (const auto axis = stated_number(scene, "UpAxis"); axis && *axis >= 0 && *axis <= 2) {
    const bool down = stated_number(scene, "UpAxisSign").value_or(1.0) < 0.0;
    up = static_cast<UpAxis>(static_cast<int>(*axis) + (down ? 3 : 0));
  }
  std::optional<double> metres;
  if (const auto centimetres = stated_number(scene, "UnitScaleFactor")) metres = *centimetres / 100.0;
  sink.compare_with_stated(up, metres, file);
}

}  // namespace

void read_assimp(const std::filesystem::path& path, const std::string& extension, SceneFiles& files, MeshSink& sink) {
  const std::string file = path.string();
  const bool ifc = extension == "ifc";
  if (extension == "glb" || extension == "gltf") sink.set_format_up(UpAxis::y);

  Assimp::Importer importer;
  keep_format(importer, extension);
  importer.SetIOHandler(new AssimpFiles(files));
  // Otherwise assimp names Collada's nodes by their ids.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  // Faces of IFC are often concave. In other formats polygons are fanned, as everywhere in roam.
  const unsigned triangulate = ifc ? static_cast<unsigned>(aiProcess_Triangulate) : 0u;
  const bool shown = sink.parts() != nullptr;
  const unsigned coordinates = shown ? static_cast<unsigned>(aiProcess_TransformUVCoords) : 0u;
  const aiScene* scene = importer.ReadFile(file, triangulate | coordinates);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    if (std::strstr(importer.GetErrorString(), "bad_alloc") != nullptr) throw std::bad_alloc();
    throw Error(
        file, fmt::format("assimp cannot read this file ({}); it is damaged, or not of the format that its name says.",
                          importer.GetErrorString()));
  }
  sink.count_file();
  std::optional<AssimpLooks> looks;
  if (shown) looks.emplace(*scene, path, sink);
  AssimpWalk walk(*scene, file, path.stem().string(), looks ? &*looks : nullptr, sink);
  if (extension == "dae") {
    compare_collada(scene->mRootNode->mTransformation, file, sink);
    walk.walk_in(*scene->mRootNode, Matrix::identity());
  } else {
    if (extension == "fbx") compare_fbx(*scene, file, sink);
    // assimp turns the z axis of IFC to y. This matrix turns it back: (x, y, z) -> (x, -z, y).
    const Matrix upright{{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}};
    walk.walk(*scene->mRootNode, ifc ? upright : Matrix::identity());
  }
  // Send now: images embedded in the file are freed with it.
  sink.send_parts();
}

}  // namespace roam::reader
