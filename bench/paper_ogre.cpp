// OGRE without a display. It writes meshes to its own files, and loads them into buffers of main memory, as its tools
// do. A drawing program makes the same calls, and also has a window and buffers of the graphics card.

#include <OgreDataStream.h>
#include <OgreDefaultHardwareBufferManager.h>
#include <OgreLogManager.h>
#include <OgreManualObject.h>
#include <OgreMaterialManager.h>
#include <OgreMesh.h>
#include <OgreMeshManager.h>
#include <OgreMeshSerializer.h>
#include <OgreResourceGroupManager.h>
#include <OgreRoot.h>
#include <OgreSubMesh.h>

#include <fstream>
#include <memory>

#include "paper_movers.h"
#include "roam/error.h"

namespace roam::bench {
namespace {

constexpr const char* group = "tiles";

Ogre::Vector3 to_ogre(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::string tile_name(std::size_t i) { return std::to_string(i) + ".mesh"; }

/// OGRE allows one of each of these in a program.
struct Engine {
  /// Silent. Reads meshes of `folder`.
  explicit Engine(const std::string& folder) {
    logs.createLog("", true, false, true);
    root = std::make_unique<Ogre::Root>("", "", "");
    Ogre::MaterialManager::getSingleton().initialise();  // with a window, the root does this
    Ogre::ResourceGroupManager::getSingleton().addResourceLocation(folder, "FileSystem", group);
  }

  Ogre::LogManager logs;
  Ogre::DefaultHardwareBufferManager buffers;  // meshes return their buffers to it, so the root ends first
  std::unique_ptr<Ogre::Root> root;
};

template <class Index>
void take_indices(const Ogre::IndexData& data, std::vector<std::uint32_t>& indices) {
  const Ogre::HardwareBufferLockGuard lock(data.indexBuffer, Ogre::HardwareBuffer::HBL_READ_ONLY);
  const auto* first = static_cast<const Index*>(lock.pData) + data.indexStart;
  indices.assign(first, first + data.indexCount);
}

FloatMesh tile_of(const Ogre::SubMesh& mesh) {
  FloatMesh tile;
  const Ogre::VertexData& data = *mesh.vertexData;
  const auto* place = data.vertexDeclaration->findElementBySemantic(Ogre::VES_POSITION);
  const auto buffer = data.vertexBufferBinding->getBuffer(place->getSource());
  {
    const Ogre::HardwareBufferLockGuard lock(buffer, Ogre::HardwareBuffer::HBL_READ_ONLY);
    auto* vertex = static_cast<unsigned char*>(lock.pData) + data.vertexStart * buffer->getVertexSize();
    tile.vertices.reserve(3 * data.vertexCount);
    for (std::size_t i = 0; i < data.vertexCount; ++i, vertex += buffer->getVertexSize()) {
      float* p = nullptr;
      place->baseVertexPointerToElement(vertex, &p);
      tile.vertices.insert(tile.vertices.end(), p, p + 3);
    }
  }
  const bool small = mesh.indexData->indexBuffer->getType() == Ogre::HardwareIndexBuffer::IT_16BIT;
  (small ? take_indices<std::uint16_t> : take_indices<std::uint32_t>)(*mesh.indexData, tile.indices);
  return tile;
}

}  // namespace

std::function<void(const Mesh&)> ogre_tile_writer(const std::string& folder) {
  return [engine = std::make_shared<Engine>(folder), folder, count = std::size_t{0}](const Mesh& mesh) mutable {
    const std::string name = tile_name(count++);
    Ogre::ManualObject object(name);
    object.estimateVertexCount(mesh.vertices.size());
    object.estimateIndexCount(3 * mesh.triangles.size());
    object.begin("", Ogre::RenderOperation::OT_TRIANGLE_LIST);
    for (const Vec3& v : mesh.vertices) object.position(to_ogre(v + paper_shift));
    for (const auto& t : mesh.triangles) object.triangle(t[0], t[1], t[2]);
    object.end();
    const Ogre::MeshPtr made = object.convertToMesh(name, group);
    const std::string file = folder + "/" + name;
    std::fstream out(file, std::ios::out | std::ios::trunc | std::ios::binary);
    if (out) Ogre::MeshSerializer().exportMesh(made.get(), std::make_shared<Ogre::FileStreamDataStream>(&out, false));
    if (!out.flush()) throw Error("cannot write " + file + "; check the free space");
    Ogre::MeshManager::getSingleton().remove(made);
  };
}

void read_ogre_tiles(const PaperScene& scene, const std::function<void(FloatMesh tile)>& take) {
  const Engine engine(scene.tiles);
  Ogre::MeshManager& meshes = Ogre::MeshManager::getSingleton();
  for (std::size_t i = 0; i < scene.tile_count; ++i) {
    const Ogre::MeshPtr mesh = meshes.load(tile_name(i), group);
    take(tile_of(*mesh->getSubMesh(0)));
    meshes.remove(mesh);
  }
}

}  // namespace roam::bench
