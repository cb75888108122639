#include "generate/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string>

#include "files/extension.h"
#include "files/whole_file.h"
#include "roam/error.h"
#include "roam/generate.h"

namespace roam::generate {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY and STL are written as they lie in memory");

/// A buffered writer that appends data at one position of a file.
class Cursor {
 public:
  Cursor(files::WholeFile& file, std::uint64_t offset) : file_(file), offset_(offset) {
    buffer_.reserve(capacity + slack);
  }

  template <class T>
  void put(const T& value) {
    const char* bytes = reinterpret_cast<const char*>(&value);
    buffer_.insert(buffer_.end(), bytes, bytes + sizeof value);
    drain();
  }
  template <class... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Arguments>(arguments)...);
    drain();
  }
  void flush() {
    file_.write_at(offset_, std::as_bytes(std::span(buffer_)));
    offset_ += buffer_.size();
    buffer_.clear();
  }

 private:
  static constexpr std::size_t capacity = 1 << 20, slack = 1 << 12;
  void drain() {
    if (buffer_.size() >= capacity) flush();
  }
  files::WholeFile& file_;
  std::uint64_t offset_;
  std::vector<char> buffer_;
};

// Scenes have fewer vertices than corners, and exceed the requested number by 3 % at most, so all formats can count
// them.
static_assert(most_triangles + most_triangles / 32 <= std::numeric_limits<std::uint32_t>::max() / 3);

void write_ply(const Scene& scene, files::WholeFile& file, const Progress& progress) {
  const std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment made by roam; metres, up is +z\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      scene.vertices(), scene.triangles());
  file.write_at(0, std::as_bytes(std::span(header)));
  // All numbers are known, so vertices and faces are written in one pass, each at its own position in the file.
  Cursor vertices(file, header.size());
  Cursor faces(file, header.size() + scene.vertices() * 3 * sizeof(double));
  std::uint32_t first = 0;
  scene.stream(
      [&](const Mesh& mesh) {
        for (const Vec3& v : mesh.vertices) vertices.put(std::array<double, 3>{v.x, v.y, v.z});
        for (const auto& t : mesh.triangles) {
          faces.put(std::uint8_t{3});
          faces.put(std::array<std::uint32_t, 3>{first + t[0], first + t[1], first + t[2]});
        }
        first += static_cast<std::uint32_t>(mesh.vertices.size());
      },
      progress);
  vertices.flush();
  faces.flush();
}

void write_obj(const Scene& scene, files::WholeFile& file, const Progress& progress) {
  Cursor text(file, 0);
  text.print("# made by roam; metres, up is +z; {} vertices, {} triangles\n", scene.vertices(), scene.triangles());
  std::uint64_t first = 1;
  scene.stream(
      [&](const Mesh& mesh) {
        text.print("o {}\n", mesh.name);
        for (const Vec3& v : mesh.vertices) text.print("v {} {} {}\n", v.x, v.y, v.z);
        for (const auto& t : mesh.triangles) text.print("f {} {} {}\n", first + t[0], first + t[1], first + t[2]);
        first += mesh.vertices.size();
      },
      progress);
  text.flush();
}

/// Rounding a coordinate to float moves it by at most half a unit in the last place: 2^-24 of the next power of two.
constexpr double stl_coordinate_limit = 32768.0;  // below it half a unit is 0.98 mm at most, above it 1.95 mm or more

void write_stl(const Scene& scene, files::WholeFile& file, const Progress& progress) {
  std::array<char, 80> header{};
  const std::string title = "binary STL made by roam; metres, up is +z";
  std::copy(title.begin(), title.end(), header.begin());
  Cursor data(file, 0);
  data.put(header);
  data.put(static_cast<std::uint32_t>(scene.triangles()));
  scene.stream(
      [&](const Mesh& mesh) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
          const Triangle t = mesh.triangle(i);
          const Vec3 a = t[1] - t[0], b = t[2] - t[0];
          const Vec3 n{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
          const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
          std::array<float, 12> facet;
          for (int k = 0; k < 3; ++k) {
            facet[static_cast<std::size_t>(k)] = static_cast<float>(n[k] / length);
            for (int v = 0; v < 3; ++v) {
              facet[static_cast<std::size_t>(3 + 3 * v + k)] = static_cast<float>(t[static_cast<std::size_t>(v)][k]);
            }
          }
          data.put(facet);
          data.put(std::uint16_t{0});
        }
      },
      progress);
  data.flush();
}

}  // namespace

bool has_scene_extension(const std::filesystem::path& path) {
  const std::string extension = files::lower_extension(path);
  return extension == ".ply" || extension == ".obj" || extension == ".stl";
}

void write_scene(const Scene& scene, const std::filesystem::path& path, const Progress& progress) {
  write_scene(scene, path, {}, progress);
}

void write_scene(const Scene& scene, const std::filesystem::path& path, files::FileKind replaced,
                 const Progress& progress) {
  const std::string extension = files::lower_extension(path);
  if (!has_scene_extension(path)) {
    throw Error::at(path.string(),
                    fmt::format("{} cannot be written: its extension must be .ply, .obj or .stl.", path.string()));
  }
  if (extension == ".stl") {
    const Box& box = scene.bounds();
    double farthest = 0.0;
    for (int k = 0; k < 3; ++k) farthest = std::max({farthest, std::fabs(box.lower[k]), std::fabs(box.upper[k])});
    if (farthest > stl_coordinate_limit) {
      throw Error::at(
          path.string(),
          fmt::format("{} cannot be written: STL holds floats, which are coarser than 1 mm at {:.0f} m from the "
                      "origin. Choose .ply or .obj, or an origin nearer to 0.",
                      path.string(), farthest));
    }
  }
  files::WholeFile file(path, files::Naming::exact, std::move(replaced));
  if (extension == ".ply") write_ply(scene, file, progress);
  if (extension == ".obj") write_obj(scene, file, progress);
  if (extension == ".stl") write_stl(scene, file, progress);
  file.commit();
}

}  // namespace roam::generate
