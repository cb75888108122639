// A scene handed on in pieces is the scene that import_scene gives, whatever its format.

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "import_pieces.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

/// A grid of squares as text, `line(x, y, z)` for each vertex and `face(corners)` for each square.
struct Grid {
  int side;
  [[nodiscard]] int vertices() const { return (side + 1) * (side + 1); }
  [[nodiscard]] int squares() const { return side * side; }
  [[nodiscard]] Vec3 vertex(int i) const {
    const double x = i % (side + 1), y = i / (side + 1);
    return {0.1 * x + 4e6, 0.1 * y, std::sin(0.3 * x) * std::cos(0.2 * y)};
  }
  [[nodiscard]] std::array<int, 4> corners(int square) const {
    const int first = square / side * (side + 1) + square % side;
    return {first, first + 1, first + side + 2, first + side + 1};
  }
};

std::string digits(const Vec3& v) {
  std::ostringstream text;
  text.precision(17);
  text << v.x << ' ' << v.y << ' ' << v.z;
  return text.str();
}

/// More triangles than a piece has, most squares of an object that has more than one piece.
const Grid grid{300};

std::string grid_obj() {
  std::ostringstream text;
  for (int i = 0; i < grid.vertices(); ++i) text << "v " << digits(grid.vertex(i)) << "\n";
  text << "v nan 0 0\nv 0 0 2e9\n";
  const int bad = grid.vertices() + 1, far = grid.vertices() + 2;
  for (int i = 0; i < grid.squares(); ++i) {
    if (i == 0) text << "o west\n";
    if (i == 70'000) text << "o east\ng wall\n";
    if (i == 80'000) text << "o west\nf 1 2 " << bad << "\n";
    if (i == 85'000) text << "o door\nf 1 2 3\nf 2 3 " << bad << "\n";
    text << "f";
    // Every other square counts its corners from the last vertex back.
    for (const int corner : grid.corners(i)) text << " " << corner - (i % 2 == 0 ? far : -1);
    text << "\n";
  }
  text << "o broken\nf 1 " << bad << " " << far << "\nf 1 " << bad << "\nf 1 2 3\n";
  return text.str();
}

std::string grid_ply(const std::string& format) {
  std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(grid.vertices() + 1) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(grid.squares() + 1) + "\nproperty list uchar int vertex_indices\nend_header\n";
  const bool big = format == "binary_big_endian";
  const bool ascii = format == "ascii";
  for (int i = 0; i <= grid.vertices(); ++i) {
    const Vec3 v = i < grid.vertices() ? grid.vertex(i) : Vec3{1e300, 0, 0};
    if (ascii) {
      text += digits(v) + "\n";
    } else {
      for (int k = 0; k < 3; ++k) text += bytes_of(v[k], big);
    }
  }
  for (int i = 0; i <= grid.squares(); ++i) {
    std::array<int, 4> corners = grid.corners(i % grid.squares());
    if (i == grid.squares()) corners[2] = grid.vertices();
    text += ascii ? "4" : bytes_of(std::uint8_t{4}, big);
    for (const int corner : corners) {
      if (ascii) text += ' ';
      text += ascii ? std::to_string(corner) : bytes_of(corner, big);
    }
    if (ascii) text += '\n';
  }
  return text;
}

std::string grid_stl() {
  std::string text(80, ' ');
  text += bytes_of(static_cast<std::uint32_t>(grid.squares() * 2));
  for (int i = 0; i < grid.squares() * 2; ++i) {
    const auto corners = grid.corners(i / 2);
    text += std::string(12, '\0');
    for (const std::size_t k : {std::size_t{0}, i % 2 == 0 ? std::size_t{1} : 2, i % 2 == 0 ? std::size_t{2} : 3}) {
      const Vec3 v = grid.vertex(corners[k]);
      const bool bad = i % 5000 == 17 && k == 2;
      for (int axis = 0; axis < 3; ++axis) {
        text += bytes_of(bad ? std::numeric_limits<float>::infinity() : static_cast<float>(v[axis]));
      }
    }
    text += std::string(2, '\0');
  }
  return text;
}

std::string polygons_stl() {
  std::ostringstream text;
  for (int i = 0; i < 20'000; ++i) {
    if (i % 18'000 == 0) text << "solid number " << i << "\n";
    text << "facet normal 0 0 1\nouter loop\n";
    for (int k = 0; k < 9; ++k) {
      text << "vertex " << digits({0.1 * i, i == 30 && k == 5 ? 2e9 : 0.2 * k, 0.3 * (k % 2)}) << "\n";
    }
    text << "endloop\nendfacet\n";
    if (i == 17'999 || i == 19'999) text << "endsolid\n";
  }
  return text.str();
}

TEST(ImportStream, GivesObjAsImported) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("grid.obj", grid_obj());
  const std::uint64_t vertices = expect_streams_as_imported({file});
  // Neighbours share their vertices: pieces repeat few.
  EXPECT_LT(vertices, 1.1 * grid.vertices());
  expect_streams_as_imported({file}, {.up = UpAxis::y, .unit = LengthUnit::ft, .ignore = {"door", "we*", "none"}});
}

TEST(ImportStream, GivesPlyAsImported) {
  const TemporaryFolder folder;
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const fs::path file = folder.write(format + ".ply", grid_ply(format));
    expect_streams_as_imported({file});
    expect_streams_as_imported({file}, {.up = UpAxis::x, .unit = LengthUnit::mm});
  }
}

TEST(ImportStream, GivesStlAsImported) {
  const TemporaryFolder folder;
  const fs::path binary = folder.write("grid.stl", grid_stl()), ascii = folder.write("solids.stl", polygons_stl());
  expect_streams_as_imported({binary, ascii});
  expect_streams_as_imported({ascii, binary}, {.unit = LengthUnit::in, .ignore = {"number 18*"}});
}

TEST(ImportStream, GivesFilesOfForeignReadersAsImported) {
  const TemporaryFolder folder;
  std::ostringstream off;
  off << "OFF\n" << grid.vertices() << " " << grid.squares() << " 0\n";
  for (int i = 0; i < grid.vertices(); ++i) off << digits(grid.vertex(i)) << "\n";
  for (int i = 0; i < grid.squares(); ++i) {
    off << "4";
    for (const int corner : grid.corners(i)) off << " " << corner;
    off << "\n";
  }
  expect_streams_as_imported({folder.write("grid.off", off.str())});
}

TEST(ImportStream, GivesRealScenesAsImported) {
  ROAM_NEEDS_TEST_DATA();
  for (const char* path : {"underground/subt_tunnel_practice_1.ive", "underground/subt_tunnel_practice_1.osgb",
                           "formats/pittsburgh_mine.osg", "formats/pittsburgh_mine.flt", "formats/pittsburgh_mine.stl",
                           "formats/pittsburgh_mine.ply", "underground/pittsburgh_mine.dae", "building/small_house.glb",
                           "recast/nav_test.obj", "city/delft.obj", "bim/Duplex_A_20110907.ifc",
                           "contextcapture_tiles/Tile_+010_+005_L22_000000t6.osgb", "pit_osgb"}) {
    SCOPED_TRACE(path);
    expect_streams_as_imported({test_data() / path});
  }
  expect_streams_as_imported({test_data() / "pit_osgb", test_data() / "recast/dungeon.obj"});
}

TEST(ImportStream, RefusesWhatImportSceneRefuses) {
  const TemporaryFolder folder;
  for (const fs::path& file :
       {folder.path() / "none.obj", folder.write("empty.obj", ""), folder.write("no.xyz", "1 2 3\n"),
        folder.write("bad.obj", "v 1 2 3\nf 1 2 3\n"), folder.write("points.obj", "v 1 2 3\n"),
        folder.write("nan.obj", "v nan 2 3\nf 1 1 1\n")}) {
    const std::string wanted = import_error(file);
    ASSERT_NE(wanted, "");
    try {
      stream_scene(std::span(&file, 1), {}, [](const Mesh&, bool) {});
      ADD_FAILURE() << file << " was streamed";
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), wanted);
    }
  }
}

}  // namespace
}  // namespace roam::test
