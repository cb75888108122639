#include "view/store_triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <osg/Geometry>

#include "cli/progress.h"
#include "roam/error.h"
#include "view/display_node.h"

namespace roam::app {
namespace {

constexpr std::size_t most_shown = 1'000'000;
constexpr std::size_t batch = 16'384;     // triangles that are drawn, or culled, together
constexpr std::size_t piece = 8 * batch;  // triangles that appear together

osg::ref_ptr<osg::Geometry> geometry_of(std::span<const Triangle> triangles, const Vec3& origin) {
  DisplayGeometry geometry;
  for (const Triangle& triangle : triangles) {
    for (const Vec3& corner : triangle) {
      geometry.indices.push_back(static_cast<std::uint16_t>(geometry.positions.size()));
      geometry.positions.emplace_back(corner - origin);
      geometry.colours.push_back({255, 255, 255, 255});
    }
  }
  return make_geometry(geometry);
}

std::string sentence(const Store& store, const StoreTriangles& shown) {
  std::string text = fmt::format("the scene of {} is not known: what is seen is what is collided with", store.name());
  if (!shown.all) {
    text += fmt::format(", within {:.3g} m of the start", 0.5 * (shown.box.upper.x - shown.box.lower.x));
  }
  return text + fmt::format("; `roam view SCENE --store {}` shows a scene", store.name());
}

}  // namespace

DisplayReport show_store(const Store& store, const Vec3& place,
                         const std::function<void(DisplayNode&&, std::uint64_t)>& take,
                         const std::function<bool()>& goes_on) {
  const Box& bounds = store.info().bounds;
  StoreTriangles shown;
  shown.all = store.info().triangles <= most_shown && triangles_in(store, bounds, most_shown, goes_on, shown);
  if (!shown.all) {
    // Widen the box while its triangles are few enough: less is read in vain than is shown.
    const Vec3 farthest = glm::max(bounds.upper - place, place - bounds.lower);
    const double enough = std::max({farthest.x, farthest.y, farthest.z, 1.0});
    shown = triangles_around(store, place, 8.0, most_shown, goes_on);
    for (double reach = 16.0; reach < 2.0 * enough; reach *= 2.0) {
      StoreTriangles wider;
      if (!triangles_in(store, {place - reach, place + reach}, most_shown, goes_on, wider)) break;
      shown = std::move(wider);
    }
  }
  DisplayReport report;
  report.origin = glm::floor(place);
  for (std::size_t first = 0; first < shown.triangles.size(); first += piece) {
    const std::size_t end = std::min(first + piece, shown.triangles.size());
    DisplayNode node;
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (std::size_t i = first; i < end; i += batch) {
      const auto part = std::span(shown.triangles).subspan(i, std::min(batch, end - i));
      group->addChild(geometry_of(part, report.origin));
      for (const Triangle& triangle : part) {
        for (const Vec3& corner : triangle) node.bounds.include(corner);
      }
    }
    node.node = group;
    node.origin = report.origin;
    report.bounds.include(node.bounds);
    ++report.parts;
    take(std::move(node), end - first);
    if (!goes_on()) throw Cancelled();
  }
  report.triangles = shown.triangles.size();
  report.notes.push_back(sentence(store, shown));
  if (!shown.missing.empty()) {
    const std::size_t more = shown.missing.size() - 1;
    report.notes.push_back(
        "not all of it is shown: " + shown.missing.front() +
        (more > 0 ? fmt::format("; and {} more (roam verify {} tells all)", more, store.name()) : ""));
  }
  return report;
}

}  // namespace roam::app
