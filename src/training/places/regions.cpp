#include "training/places/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace roam::training {

namespace {

std::string why(const Passage& passage) {
  const double width = 2.0 * passage.radius;
  if (passage.opening && passage.opening->kind == Opening::Kind::lintel)
    return fmt::format("lintel that a radius of {:.2f} m passes under", passage.radius);
  return fmt::format("{} {:.2f} m wide", passage.opening ? to_string(passage.opening->kind) : "passage", width);
}

/// The space for the middle of a body of `radius` that stands at one of the places or touches it.
Box box_around(const ways::Measure& measure, const ways::WidestTree& tree, const std::vector<ways::NodeId>& nodes,
               double radius) {
  Box box;
  for (const ways::NodeId id : nodes) box.include(tree.node(id).place);
  box.lower -= Vec3(radius);
  box.upper += Vec3(radius);
  if (measure.mode == Mode::walk) {
    box.lower.z = std::min(box.lower.z, box.lower.z + radius - measure.step);
    box.upper.z += std::max(measure.height, 2.0 * radius) - radius;
  }
  return box;
}

}  // namespace

std::vector<SizeRegion> make_regions(const ways::Measure& measure, const ways::WidestTree& tree, const Rooms& rooms,
                                     double least, double radius, std::span<const Passage> openings) {
  std::vector<SizeRegion> regions;
  std::vector<const Passage*> best(rooms.rooms.size(), nullptr);
  for (std::size_t i = 0; i < rooms.necks.size() && i < openings.size(); ++i) {
    const Passage& passage = openings[i];
    if (!passage.found || passage.radius >= radius || passage.radius < least) continue;
    regions.push_back({.bounds = box_around(measure, tree, rooms.necks[i].nodes, radius),
                       .radius = region_share * passage.radius,
                       .why = why(passage)});
    for (const std::uint32_t room : rooms.necks[i].rooms)
      if (best[room] == nullptr || best[room]->radius < passage.radius) best[room] = &passage;
  }
  for (std::size_t room = 0; room < rooms.rooms.size(); ++room) {
    const Room& r = rooms.rooms[room];
    if (best[room] == nullptr || tree.node(r.widest).clearance >= radius) continue;
    regions.push_back({.bounds = box_around(measure, tree, r.nodes, radius),
                       .radius = region_share * best[room]->radius,
                       .why = "behind " + why(*best[room])});
  }
  return regions;
}

}  // namespace roam::training
