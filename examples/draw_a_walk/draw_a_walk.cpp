// A floor plan as SVG: what a horizontal plane at the start's height cuts out of a scene, and the way of a trace of
// `roam walk` through it.
#include <roam/import.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace {

/// The places of a trace.
std::vector<roam::Vec3> read_trace(const char* file) {
  std::ifstream in(file);
  std::vector<roam::Vec3> places;
  std::string line;
  while (std::getline(in, line)) {
    roam::Vec3 place(0.0);
    // step,t,x,y,z,...; the header has no numbers.
    if (std::sscanf(line.c_str(), "%*u,%*f,%lf,%lf,%lf", &place.x, &place.y, &place.z) == 3) places.push_back(place);
  }
  if (places.empty()) throw roam::Error(std::string(file) + " holds no trace; write one with `roam walk --trace`");
  return places;
}

/// Turns the plan so that the walk leads from left to right, around its start.
class Turn {
 public:
  explicit Turn(const std::vector<roam::Vec3>& places) : origin_(places.front()) {
    const roam::Vec3 way = places.back() - places.front();
    const double length = std::hypot(way.x, way.y);
    if (length > 0.0) right_ = {way.x / length, way.y / length, 0.0};
  }
  /// In a picture y points down.
  [[nodiscard]] roam::Vec3 operator()(const roam::Vec3& p) const {
    const roam::Vec3 d = p - origin_;
    return {d.x * right_.x + d.y * right_.y, d.x * right_.y - d.y * right_.x, d.z};
  }

 private:
  roam::Vec3 origin_;
  roam::Vec3 right_{1.0, 0.0, 0.0};
};

/// Where an edge crosses the height, if it does.
bool crossing(const roam::Vec3& a, const roam::Vec3& b, double height, std::vector<roam::Vec3>& points) {
  if ((a.z < height) == (b.z < height)) return false;
  points.push_back(a + (height - a.z) / (b.z - a.z) * (b - a));
  return true;
}

void draw_walls(const roam::Scene& scene, double height, const Turn& turn, const roam::Box& view) {
  std::printf("<path fill=\"none\" stroke=\"#334\" stroke-width=\".16\" stroke-linecap=\"round\" d=\"");
  std::vector<roam::Vec3> points;
  for (const roam::Mesh& mesh : scene.meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const roam::Triangle t = mesh.triangle(i);
      points.clear();
      for (int k = 0; k < 3; ++k) crossing(t[k], t[(k + 1) % 3], height, points);
      if (points.size() != 2) continue;
      roam::Box box;
      for (roam::Vec3& p : points) box.include(p = turn(p));
      const bool seen = box.lower.x < view.upper.x && view.lower.x < box.upper.x && box.lower.y < view.upper.y &&
                        view.lower.y < box.upper.y;
      if (seen) std::printf("M%.2f %.2fL%.2f %.2f", points[0].x, points[0].y, points[1].x, points[1].y);
    }
  }
  std::printf("\"/>\n");
}

void draw_way(const std::vector<roam::Vec3>& places, const Turn& turn) {
  std::printf("<path fill=\"none\" stroke=\"#2a8\" stroke-width=\".4\" stroke-linejoin=\"round\" d=\"");
  // A corner every few steps is as smooth as the eye can see.
  constexpr std::size_t every = 8;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i % every != 0 && i + 1 != places.size()) continue;
    const roam::Vec3 p = turn(places[i]);
    std::printf("%c%.2f %.2f", i == 0 ? 'M' : 'L', p.x, p.y);
  }
  std::printf("\"/>\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: draw_a_walk SCENE TRACE > plan.svg\n");
    return 2;
  }
  try {
    const roam::Scene scene = roam::import_scene(argv[1]);
    const std::vector<roam::Vec3> places = read_trace(argv[2]);
    constexpr double margin = 5.0;  // m around the way
    const Turn turn(places);
    roam::Box view;
    for (const roam::Vec3& place : places) view.include(turn(place));
    view.lower -= margin;
    view.upper += margin;
    const roam::Vec3 size = view.size();
    const auto frame = [&](const char* format) { std::printf(format, view.lower.x, view.lower.y, size.x, size.y); };
    frame("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"%.1f %.1f %.1f %.1f\" width=\"900\">\n");
    frame("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#fff\"/>\n");
    draw_walls(scene, places.front().z, turn, view);
    draw_way(places, turn);
    std::printf("<circle r=\".9\" fill=\"#2a8\"/>\n</svg>\n");
    return 0;
  } catch (const roam::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
