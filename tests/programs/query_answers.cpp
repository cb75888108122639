// query_answers IN OUT: queries of C++ for tests of other languages.
// query_answers IN: the seconds of a batch of sweeps, on all cores, for each line that it reads.
//
// IN: three uint64 (vertices, triangles, queries), then packed arrays: vertices (3 doubles), triangles (3 uint32),
// radii, half heights, positions and motions. OUT: a Row a query.
#include <chrono>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "roam/world.h"

namespace {

struct [[gnu::packed]] Row {
  std::uint8_t hit, unknown, fits, found;
  std::uint32_t object;
  double time, gap;
  double point[3], normal[3];
  std::uint64_t triangle;
  double near_gap, near_point[3];
  std::uint64_t near_triangle, count;
  std::uint64_t contacts[4];
};

template <class T>
std::vector<T> read(std::istream& in, std::uint64_t count) {
  std::vector<T> values(count);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
  return values;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) return 2;
  std::ifstream in(argv[1], std::ios::binary);
  const auto counts = read<std::uint64_t>(in, 3);
  roam::Mesh mesh;
  mesh.vertices = read<roam::Vec3>(in, counts[0]);
  mesh.triangles = read<std::array<std::uint32_t, 3>>(in, counts[1]);
  const auto radii = read<double>(in, counts[2]);
  const auto half_heights = read<double>(in, counts[2]);
  const auto positions = read<roam::Vec3>(in, counts[2]);
  const auto motions = read<roam::Vec3>(in, counts[2]);
  if (!in) return 1;
  const roam::World world = roam::World::build({&mesh, 1});

  if (argc == 2) {
    std::vector<roam::Query> queries(counts[2]);
    for (std::size_t i = 0; i < counts[2]; ++i) queries[i] = {{radii[i], half_heights[i]}, positions[i], motions[i]};
    std::vector<roam::Impact> impacts(counts[2]);
    for (std::string line; std::getline(std::cin, line);) {
      const auto begin = std::chrono::steady_clock::now();
      world.sweep(queries, impacts);
      std::cout << std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() << std::endl;
    }
    return 0;
  }

  std::ofstream out(argv[2], std::ios::binary);
  constexpr double reach = 1.5;
  for (std::size_t i = 0; i < counts[2]; ++i) {
    const roam::Body body{radii[i], half_heights[i]};
    const roam::Impact impact = world.sweep(body, positions[i], motions[i]);
    const roam::Clearance near = world.clearance(body, positions[i], reach);
    roam::Contact contacts[4];
    Row row{};
    row.hit = impact.hit;
    row.unknown = impact.unknown;
    row.fits = world.fits(body, positions[i]);
    row.found = near.found;
    row.object = impact.object;
    row.time = impact.time;
    row.gap = impact.distance;
    std::memcpy(row.point, &impact.point, sizeof row.point);
    std::memcpy(row.normal, &impact.normal, sizeof row.normal);
    row.triangle = impact.triangle;
    row.near_gap = near.distance;
    std::memcpy(row.near_point, &near.point, sizeof row.near_point);
    row.near_triangle = near.triangle;
    row.count = world.contacts(body, positions[i], roam::Vec3(0.0), reach, contacts);
    for (std::size_t k = 0; k < 4; ++k) row.contacts[k] = k < row.count ? contacts[k].triangle : roam::no_triangle;
    out.write(reinterpret_cast<const char*>(&row), sizeof row);
  }
  return out ? 0 : 1;
}
