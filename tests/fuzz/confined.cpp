// Files of other people's formats, read as roam-reader does: in a process of its own, behind its walls.
//
// The libraries that read them may crash and spin; the walls are what must hold. So a crash inside a library is no
// finding. These are: a forbidden system call, a stream that violates the protocol, and a sanitizer's report. The child
// hands its coverage back, so that libFuzzer is guided by it.
#include <assimp/scene.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/ProxyNode>
#include <osgDB/WriteFile>

#include "archive_made.h"
#include "fuzz.h"
#include "gltf_made.h"
#include "import/reader/osg_files.h"
#include "import/reader/sandbox/sandbox.h"
#include "import/scene_scope.h"
#include "reading.h"
#include "roam/import.h"

namespace fuzz {
namespace {

using roam::reader::Rights;

/// Seconds of processor time. The budget of a small file is 10 s; a fuzzer has better use for them.
constexpr rlim_t most_seconds = 1;
constexpr std::uint64_t most_memory = std::uint64_t{1} << 30;

/// Memory that children share with this process.
std::span<std::uint8_t> shared_counters() {
  static const std::span<std::uint8_t> memory = [] {
    const std::size_t size = std::max<std::size_t>(counters().size(), 1);
    void* at = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) fail("no memory");
    return std::span(static_cast<std::uint8_t*>(at), counters().size());
  }();
  return memory;
}

/// The child: reads behind the walls, and ends.
[[noreturn]] void read_confined(const Stream& stream, const Stream& words, const std::string& file, Wanted wanted) {
  dup2(words.descriptor(), STDERR_FILENO);
  for (const int signal_number : {SIGSEGV, SIGBUS, SIGABRT, SIGILL, SIGFPE, SIGXCPU}) signal(signal_number, SIG_DFL);
  const rlimit seconds{most_seconds, most_seconds};
  setrlimit(RLIMIT_CPU, &seconds);
  Rights rights;
  rights.scope = roam::reader::scope_of(file, {});
  rights.address_space = most_memory;
  rights.data = most_memory;
  rights.file_size = most_memory;
  try {
    read_to(stream, file, wanted, [&](const std::function<void()>& prepare) {
      const auto walls = roam::reader::confine(rights, stream.descriptor(), roam::reader::any_landlock, prepare);
      if (!walls.system_calls) _exit(EXIT_FAILURE);
    });
  } catch (const std::exception&) {
    // As in the reader: a message.
  }
  std::copy(counters().begin(), counters().end(), shared_counters().begin());
  _exit(EXIT_SUCCESS);
}

/// Whether a child ended because it wanted more memory than there is: its last words say so, with a sanitizer or not.
bool wanted_memory(const std::string& words) {
  for (const char* said : {"bad_alloc", "out of memory", "out-of-memory", "allocation-size-too-big", "malloc limit"}) {
    if (words.find(said) != std::string::npos) return true;
  }
  return false;
}

void run_confined(const std::string& name, Bytes input, Wanted wanted, bool our_code) {
  static const Stream words, stream;
  static const std::span<std::uint8_t> shared = shared_counters();
  const std::string file = write(name, text_of(input));
  stream.clear();
  words.clear();
  std::fill(shared.begin(), shared.end(), std::uint8_t{0});
  const pid_t child = fork();
  if (child < 0) fail("no child process");
  if (child == 0) read_confined(stream, words, file, wanted);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const std::span<std::uint8_t> own = counters();
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = std::max(own[i], shared[i]);
  if (WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS) {
    (void)taken(stream.bytes(), wanted);
    return;
  }
  const bool spun = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
  if (spun || wanted_memory(words.bytes())) return;
  const bool crashed = WIFSIGNALED(status) && WTERMSIG(status) != SIGSYS;
  if (!crashed || our_code) fail("the child ended with status " + std::to_string(status) + ": " + words.bytes());
}

/// The first byte chooses the format, and whether meshes, pieces or what is shown is wanted.
void run_format(std::span<const char* const> extensions, Bytes input, bool our_code) {
  static const bool ready = [] {
    roam::reader::load_osg_plugins("");
    roam::reader::close_osg_door();
    return true;
  }();
  demand(ready, "no plugins");
  Values values(input);
  const auto choice = values.take<std::uint8_t>();
  const char* const extension = extensions[choice % extensions.size()];
  const auto wanted = static_cast<Wanted>(choice / extensions.size() % 3);
  run_confined(std::string("scene.") + extension, values.rest(), wanted, our_code);
}

constexpr std::array gltf_extensions{"glb", "gltf", "b3dm", "i3dm", "cmpt", "json", "3tz"};
constexpr std::array osg_extensions{"osgt", "osgb", "osg", "ive"};
constexpr std::array foreign_extensions{"dae", "fbx", "ifc", "off", "3ds", "flt", "ac", "dxf", "lwo", "x", "3mf"};

void run_gltf(Bytes input) { run_format(gltf_extensions, input, true); }
void run_osg(Bytes input) { run_format(osg_extensions, input, false); }
void run_foreign(Bytes input) { run_format(foreign_extensions, input, false); }

/// A seed for each way of reading it.
template <std::size_t Count>
void add_seed(std::vector<std::string>& all, const std::array<const char*, Count>& extensions,
              std::string_view extension, const std::string& content) {
  const auto number =
      static_cast<std::size_t>(std::find(extensions.begin(), extensions.end(), extension) - extensions.begin());
  for (std::size_t wanted = 0; wanted < 3; ++wanted) {
    all.push_back(static_cast<char>(number + wanted * Count) + content);
  }
}

std::vector<std::string> gltf_seeds() {
  using namespace roam::test;
  const MadeGltf grid = MadeGrid(3).gltf();
  Json text = grid.json;
  const std::string buffer = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  text["buffers"] = {{{"byteLength", 36}, {"uri", buffer}}};
  text["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
  text["accessors"] = {{{"bufferView", 0}, {"componentType", type_f32}, {"type", "VEC3"}, {"count", 3}}};
  text["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
  const std::string places = packed(std::vector<float>{0, 0, 0, 9, 0, 0});
  const std::string instanced =
      made_tile("i3dm", grid.glb(), R"({"INSTANCES_LENGTH":2,"POSITION":{"byteOffset":0}})", places);
  const std::string model = made_tile("b3dm", grid.glb());
  std::vector<std::string> all;
  add_seed(all, gltf_extensions, "glb", grid.glb());
  add_seed(all, gltf_extensions, "gltf", text.dump());
  add_seed(all, gltf_extensions, "b3dm", model);
  add_seed(all, gltf_extensions, "i3dm", instanced);
  add_seed(all, gltf_extensions, "cmpt", made_composite({model, instanced}));
  add_seed(all, gltf_extensions, "json", made_tileset(made_node("", Json::array({made_node("none.b3dm")}))));
  add_seed(all, gltf_extensions, "3tz",
           made_archive({{"tileset.json", made_tileset(made_node("1.b3dm"))}, {"1.b3dm", model, 8}}));
  return all;
}

/// A triangle below a transform, and a file that is not there.
osg::ref_ptr<osg::Group> some_graph() {
  const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  for (const osg::Vec3& v : {osg::Vec3(0, 0, 0), osg::Vec3(1, 0, 0), osg::Vec3(1, 1, 0), osg::Vec3(0, 1, 0)})
    vertices->push_back(v);
  const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
  const osg::ref_ptr<osg::DrawElementsUShort> strip = new osg::DrawElementsUShort(GL_TRIANGLE_STRIP);
  for (const unsigned short corner : {0, 1, 3, 2}) strip->push_back(corner);
  geometry->addPrimitiveSet(strip);
  const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
  geode->setName("wall");
  geode->addDrawable(geometry);
  const osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrix::translate(1, 2, 3));
  moved->addChild(geode);
  const osg::ref_ptr<osg::ProxyNode> elsewhere = new osg::ProxyNode;
  elsewhere->setFileName(0, "none.osgt");
  osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(moved);
  root->addChild(geode);
  root->addChild(elsewhere);
  return root;
}

std::string content_of_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Written by OpenSceneGraph; empty if it cannot.
std::string written_by_osg(const std::string& extension) {
  const std::string file = folder() + "/seed." + extension;
  return osgDB::writeNodeFile(*some_graph(), file) ? content_of_file(file) : "";
}

std::vector<std::string> osg_seeds() {
  std::vector<std::string> all;
  for (const char* extension : osg_extensions) {
    if (const std::string content = written_by_osg(extension); !content.empty()) {
      add_seed(all, osg_extensions, extension, content);
    }
  }
  return all;
}

std::vector<std::string> foreign_seeds() {
  std::vector<std::string> all;
  const std::string off = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  add_seed(all, foreign_extensions, "off", off);
  add_seed(
      all, foreign_extensions, "ac",
      "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 10 trans 0\nOBJECT world\nkids 1\n"
      "OBJECT poly\nname \"t\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x20\nmat 0\nrefs 3\n0 0 0\n2 0 0\n"
      "1 0 0\nkids 0\n");
  add_seed(
      all, foreign_extensions, "dxf",
      "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n0\n22\n1\n32\n0\n13\n0\n"
      "23\n1\n33\n0\n0\nENDSEC\n0\nEOF\n");
  for (const char* extension : {"3ds", "flt"}) {
    if (const std::string content = written_by_osg(extension); !content.empty()) {
      add_seed(all, foreign_extensions, extension, content);
    }
  }
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(write("seed.off", off), 0);
  for (const auto& [extension, format] :
       {std::pair("dae", "collada"), std::pair("fbx", "fbxa"), std::pair("x", "x"), std::pair("3mf", "3mf")}) {
    Assimp::Exporter exporter;
    const std::string file = folder() + "/seed." + extension;
    if (scene != nullptr && exporter.Export(scene, format, file) == aiReturn_SUCCESS) {
      add_seed(all, foreign_extensions, extension, content_of_file(file));
    }
  }
  return all;
}

const Known gltf_target({"gltf",
                         run_gltf,
                         gltf_seeds,
                         {"\"accessors\"",
                          "\"bufferViews\"",
                          "\"byteOffset\"",
                          "\"byteStride\"",
                          "\"componentType\"",
                          "\"sparse\"",
                          "\"indices\"",
                          "\"POSITION\"",
                          "\"mode\"",
                          "\"children\"",
                          "\"matrix\"",
                          "\"nodes\"",
                          "\"extensions\"",
                          "\"KHR_draco_mesh_compression\"",
                          "\"EXT_meshopt_compression\"",
                          "\"EXT_mesh_gpu_instancing\"",
                          "\"KHR_mesh_quantization\"",
                          "\"implicitTiling\"",
                          "\"subtrees\"",
                          "\"uri\"",
                          "-1",
                          "4294967295",
                          "1e308"}});
const Known osg_target({"osg",
                        run_osg,
                        osg_seeds,
                        {"osg::Geometry", "osg::DrawElementsUInt", "osg::PagedLOD", "osg::ProxyNode", "osg::Switch",
                         "UniqueID ", "FileName ", "DatabasePath ", "Use ", "../", "/etc/passwd", "http://",
                         ".osgt.curl", "4294967295", "-1"}});
const Known foreign_target(
    {"foreign", run_foreign, foreign_seeds, {"numvert ", "SURF 0x", "3DFACE", "OFF\n", "4294967295", "-1"}});

}  // namespace
}  // namespace fuzz
