// roam walk --verify through real scenes: no step of any walk comes nearer to a triangle than the radius.
#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "import_files.h"
#include "program.h"
#include "roam/import.h"
#include "verify/swept_distance.h"

namespace {

/// Runs `roam walk SCENE ARGUMENTS... --verify --json` and checks what must hold of every walk.
nlohmann::json walk(const std::string& scene, std::vector<std::string> arguments) {
  const std::string file = (roam::test::test_data() / scene).string();
  arguments.insert(arguments.begin(), {"walk", file, "--verify", "--json"});
  const ProgramResult result = run_program(ROAM_PROGRAM, arguments);
  const auto report = nlohmann::json::parse(result.out, nullptr, false);
  EXPECT_TRUE(report.is_object()) << scene << ": " << result.err;
  if (!report.is_object()) return {};
  EXPECT_EQ(result.status, report["outcome"] == "reached" ? 0 : 3);
  EXPECT_EQ(report["violations"], 0) << scene << ": " << report["why"];
  EXPECT_EQ(report["verified"]["overstated_clearances"], 0) << scene;
  EXPECT_FALSE(report["why"].get<std::string>().empty());
  EXPECT_GE(report["least_clearance_m"].get<double>(), report["radius"].get<double>() - 1e-6) << scene;
  return report;
}

TEST(RealScenes, AreWanderedThroughOnFootAndFlying) {
  ROAM_NEEDS_TEST_DATA();
  struct Scene {
    std::string file;
    std::vector<std::string> options;
  };
  const std::vector<Scene> scenes = {{"underground/pittsburgh_mine.dae", {}},
                                     {"underground/subt_tunnel_practice_1.ive", {}},
                                     {"pit_osgb", {}},
                                     {"recast/dungeon.obj", {"--up", "y"}},
                                     {"building/willowgarage_visual.dae", {"--unit", "in"}},
                                     {"city/delft.obj", {}}};
  for (const Scene& scene : scenes) {
    std::vector<std::string> on_foot = scene.options;
    on_foot.insert(on_foot.end(), {"--wander", "60", "--height", "1.8"});
    const nlohmann::json walked = walk(scene.file, on_foot);
    EXPECT_EQ(walked.value("outcome", ""), "reached") << scene.file << ": " << walked.value("why", "");
    EXPECT_GT(walked.value("length_m", 0.0), 20.0) << scene.file;
    std::vector<std::string> flying = scene.options;
    flying.insert(flying.end(), {"--wander", "30", "--mode", "fly", "--speed", "10"});
    walk(scene.file, flying);
  }
}

constexpr const char* tunnel = "underground/subt_tunnel_practice_1.ive";

/// An edge of the tunnel's graph, from tile to tile at the height of the eyes.
struct Edge {
  std::string from, to;
  double named_clearance = 0.0;  ///< as the file gives it: from samples along the edge, so a wall between two is missed
};

struct TunnelGraph {
  std::map<std::string, roam::Vec3> nodes;
  std::vector<Edge> edges;
};

TunnelGraph read_tunnel_graph() {
  TunnelGraph graph;
  std::ifstream in(roam::test::test_data() / "underground/subt_tunnel_practice_1_walk_graph.csv");
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#' || line.starts_with("from,")) continue;
    std::vector<std::string> f;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) f.push_back(field);
    const auto point = [&](std::size_t i) {
      return roam::Vec3(std::stod(f[i]), std::stod(f[i + 1]), std::stod(f[i + 2]));
    };
    graph.nodes[f[0]] = point(4);
    graph.nodes[f[2]] = point(7);
    graph.edges.push_back({f[0], f[2], std::stod(f[10])});
  }
  return graph;
}

/// Paths that together go along every one of `edges`, one for each part that hangs together: there and back along each
/// branch.
std::vector<std::string> paths_along(const TunnelGraph& graph, const std::vector<Edge>& edges) {
  std::map<std::string, std::vector<std::string>> neighbours;
  for (const Edge& edge : edges) {
    neighbours[edge.from].push_back(edge.to);
    neighbours[edge.to].push_back(edge.from);
  }
  std::vector<std::string> result;
  std::set<std::pair<std::string, std::string>> gone;
  for (const auto& [start, unused] : neighbours) {
    std::ostringstream path;
    const auto add = [&](const std::string& node) {
      const roam::Vec3& p = graph.nodes.at(node);
      path << p.x << ' ' << p.y << ' ' << p.z << " # " << node << '\n';
    };
    const std::function<void(const std::string&)> visit = [&](const std::string& node) {
      add(node);
      for (const std::string& next : neighbours.at(node)) {
        if (!gone.insert(std::minmax(node, next)).second) continue;
        visit(next);
        add(node);
      }
    };
    visit(start);
    const std::string text = path.str();
    if (std::count(text.begin(), text.end(), '\n') > 1) result.push_back(text);
  }
  return result;
}

/// The distance of the straight way along an edge from the nearest of all triangles, as far as `reach`.
double true_clearance(const roam::ImportedScene& scene, const roam::Vec3& from, const roam::Vec3& to, double reach) {
  long double least = reach;
  roam::Box way;
  way.include(from);
  way.include(to);
  for (const roam::Mesh& mesh : scene.meshes) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const roam::Triangle triangle = mesh.triangle(t);
      roam::Box box;
      for (const roam::Vec3& corner : triangle) box.include(corner);
      bool near = true;
      for (int k = 0; k < 3; ++k)
        near = near && box.lower[k] - reach <= way.upper[k] && way.lower[k] - reach <= box.upper[k];
      if (near) least = std::min(least, roam::verification::swept_distance(from, to, 0.0, triangle));
    }
  }
  return static_cast<double>(least);
}

TEST(RealScenes, TheTunnelIsFlownAlongEveryEdgeThatIsClear) {
  ROAM_NEEDS_TEST_DATA();
  const TunnelGraph graph = read_tunnel_graph();
  const roam::ImportedScene scene = roam::import_scene(roam::test::test_data() / tunnel);
  constexpr double radius = 0.5;
  constexpr double answered_as_hit = 0.002;  // m: so much early a hit may be answered
  std::vector<Edge> clear;
  std::vector<Edge> through_a_wall;
  for (const Edge& edge : graph.edges) {
    if (edge.named_clearance <= radius) continue;
    const double clearance = true_clearance(scene, graph.nodes.at(edge.from), graph.nodes.at(edge.to), 1.0);
    (clearance > radius + answered_as_hit ? clear : through_a_wall).push_back(edge);
  }
  // Of the edges that the file calls clear, those to the middle of a bend pierce its wall between two samples.
  EXPECT_EQ(clear.size(), 16u);
  EXPECT_EQ(through_a_wall.size(), 22u);
  const TestFolder folder;
  for (const std::string& path : paths_along(graph, clear)) {
    const nlohmann::json report =
        walk(tunnel, {"--mode", "fly", "--radius", "0.5", "--speed", "10", "--path", folder.write("clear.path", path)});
    EXPECT_EQ(report.value("outcome", ""), "reached") << report.value("why", "") << "\n" << path;
  }
  for (const Edge& edge : through_a_wall) {
    const roam::Vec3 from = graph.nodes.at(edge.from);
    const roam::Vec3 to = graph.nodes.at(edge.to);
    EXPECT_EQ(true_clearance(scene, from, to, 1.0), 0.0) << edge.from << " to " << edge.to;
    const nlohmann::json report = walk(tunnel, {"--mode", "fly", "--radius", "0.5", "--speed", "10", "--path",
                                                folder.write("wall.path", paths_along(graph, {edge}).front())});
    // Blocked, or there by a detour along the wall.
    const std::string outcome = report.value("outcome", "");
    EXPECT_TRUE(outcome == "blocked" || outcome == "reached") << outcome;
    if (outcome == "reached") {
      EXPECT_GT(report.value("length_m", 0.0), 2.0 * glm::distance(from, to) + radius);
    }
  }
}

TEST(RealScenes, TheTunnelIsWalkedAlongItsLevelEdges) {
  ROAM_NEEDS_TEST_DATA();
  const TunnelGraph graph = read_tunnel_graph();
  std::vector<Edge> level;
  for (const Edge& edge : graph.edges) {
    // Nothing is nearer than the floor below the eyes.
    if (edge.named_clearance >= 1.6) level.push_back(edge);
  }
  EXPECT_GE(level.size(), 10u);
  const TestFolder folder;
  for (const std::string& path : paths_along(graph, level)) {
    const nlohmann::json report =
        walk(tunnel, {"--height", "1.8", "--speed", "5", "--path", folder.write("level.path", path)});
    EXPECT_EQ(report.value("outcome", ""), "reached") << report.value("why", "") << "\n" << path;
  }
}

TEST(RealScenes, TheMineIsTheSameInEveryFormat) {
  ROAM_NEEDS_TEST_DATA();
  // The order of triangles differs between formats, so the walk may differ in the last digits; how it ends may not.
  for (const char* file :
       {"underground/pittsburgh_mine.dae", "formats/pittsburgh_mine.osg", "formats/pittsburgh_mine.osgt",
        "formats/pittsburgh_mine.flt", "formats/pittsburgh_mine.stl", "formats/pittsburgh_mine.ply"}) {
    const nlohmann::json report = walk(file, {"--wander", "20", "--height", "1.8"});
    EXPECT_EQ(report.value("triangles", 0), 13834) << file;
    EXPECT_EQ(report.value("outcome", ""), "reached") << file;
    EXPECT_NEAR(report.value("length_m", 0.0), 28.0, 0.5) << file;
  }
}

}  // namespace
