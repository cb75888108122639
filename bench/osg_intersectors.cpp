// The comparison of Xie and Niu (2020): osgRoam::BoxIntersector, the successor of their intersector, and
// osgUtil::PolytopeIntersector, on path 1 of the gallery. In common scene graphs: one geode or many, with and without
// KdTree. Times are the thread's own, so other programs do not count.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <glm/geometric.hpp>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/KdTree>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/PolytopeIntersector>
#include <vector>

#include "cli/values.h"
#include "osgRoam/BoxIntersector.h"
#include "osg_scene.h"
#include "roam/generate.h"
#include "thread_clock.h"

namespace {

using roam::Vec3;
using roam::bench::to_osg;

constexpr double radius = 0.5;         ///< metres
constexpr double step_length = 0.833;  ///< metres: 50 m/s at 60 Hz

/// The triangles in `geodes` geodes of about the same size, in the gallery's order.
osg::ref_ptr<osg::Group> graph_of(const std::vector<roam::Mesh>& meshes, std::size_t geodes, bool kd_tree) {
  std::size_t triangles = 0, done = 0;
  for (const roam::Mesh& mesh : meshes) triangles += mesh.triangles.size();
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  roam::Mesh part;
  const auto end_part = [&] {
    if (!part.triangles.empty()) scene->addChild(roam::bench::to_geode(part));
    part = {};
  };
  for (const roam::Mesh& mesh : meshes) {
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i, ++done) {
      const bool next = done * geodes / triangles > scene->getNumChildren();
      if (next) end_part();
      if (next || i == 0) {
        first = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.insert(part.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
      }
      const auto& t = mesh.triangles[i];
      part.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  end_part();
  if (kd_tree) {
    osg::ref_ptr<osg::KdTreeBuilder> builder = new osg::KdTreeBuilder;
    scene->accept(*builder);
  }
  scene->getBound();
  return scene;
}

/// Whether the box meets any triangle.
bool ask_box(osg::Node& scene, const Vec3& from, const Vec3& to) {
  osg::ref_ptr<osgRoam::BoxIntersector> box = new osgRoam::BoxIntersector({.radius = radius}, to_osg(from), to_osg(to));
  osgUtil::IntersectionVisitor visitor(box);
  scene.accept(visitor);
  return box->containsIntersections();
}

/// The same. It stops at the first one, its fastest setting.
bool ask_polytope(osg::Node& scene, const Vec3& from, const Vec3& to) {
  osg::ref_ptr<osgUtil::PolytopeIntersector> intersector =
      new osgUtil::PolytopeIntersector(osgUtil::Intersector::MODEL, roam::bench::box_of_sweep(Vec3(radius), from, to));
  intersector->setPrimitiveMask(osgUtil::PolytopeIntersector::TRIANGLE_PRIMITIVES);
  intersector->setIntersectionLimit(osgUtil::Intersector::LIMIT_ONE);
  osgUtil::IntersectionVisitor visitor(intersector);
  scene.accept(visitor);
  return intersector->containsIntersections();
}

using Ask = bool (*)(osg::Node&, const Vec3&, const Vec3&);

/// Mean milliseconds of every `every`th step of the path.
double mean_step(Ask ask, osg::Node& scene, std::size_t every, std::size_t& hits) {
  const roam::generate::Path& path = roam::generate::gallery_paths[0];
  const double length = glm::length(path.to - path.from);
  const Vec3 step = (path.to - path.from) * (step_length / length);
  const auto steps = static_cast<std::size_t>(length / step_length);
  hits = 0;
  std::size_t asked = 0;
  const double start = roam::bench::thread_time();
  for (std::size_t i = 0; i < steps; i += every, ++asked) {
    const Vec3 from = path.from + static_cast<double>(i) * step;
    hits += ask(scene, from, from + step) ? 1 : 0;
  }
  return 1e-6 * (roam::bench::thread_time() - start) / static_cast<double>(asked);
}

void run(std::uint64_t triangles, std::size_t every) {
  const std::vector<roam::Mesh> meshes =
      roam::generate::collect(roam::generate::gallery({.triangles = triangles, .seed = 1, .origin = Vec3(0.0)}));
  std::printf("| scene | box (ms a step) | polytope (ms a step) | polytope / box | steps with hits: box, polytope |\n");
  std::printf("|---|---|---|---|---|\n");
  for (const bool kd_tree : {false, true}) {
    for (const std::size_t geodes : {std::size_t{1}, std::size_t{127}}) {
      const osg::ref_ptr<osg::Group> scene = graph_of(meshes, geodes, kd_tree);
      const std::size_t some = kd_tree ? 1 : geodes == 1 ? every : std::max<std::size_t>(every / 10, 1);
      std::size_t box_hits = 0, polytope_hits = 0;
      const double box = mean_step(&ask_box, *scene, some, box_hits);
      const double polytope = mean_step(&ask_polytope, *scene, some, polytope_hits);
      std::printf("| %zu geode%s%s | %.4g | %.4g | %.2f | %zu, %zu |\n", geodes, geodes > 1 ? "s" : "",
                  kd_tree ? " + KdTree" : "", box, polytope, polytope / box, box_hits, polytope_hits);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t triangles = 1'970'000;
  std::size_t every = 20;
  CLI::App app{"Times osgRoam::BoxIntersector and osgUtil::PolytopeIntersector on path 1 of the gallery"};
  roam::app::add_triangles(app, "--triangles", triangles, "triangles of the gallery");
  app.add_option("--every", every, "with one geode and no index, query at every Nth step only")
      ->capture_default_str()
      ->check(roam::app::at_least_one());
  CLI11_PARSE(app, argc, argv);
  try {
    run(triangles, every);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
