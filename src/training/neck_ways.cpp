#include "training/neck_ways.h"

#include <algorithm>
#include <cstdint>
#include <queue>
#include <unordered_map>

namespace roam::training {

namespace {

/// Places by which a way continues into a room at each end, at most.
constexpr std::size_t most_steps = 10;

/// Ordered by the largest minimum clearance, then by node, so that the order is deterministic.
struct Front {
  float least;
  ways::NodeId node, from;
  bool operator<(const Front& other) const { return least != other.least ? least < other.least : node > other.node; }
};

class NeckWay {
 public:
  NeckWay(const ways::WidestTree& tree, const std::unordered_map<ways::NodeId, std::uint32_t>& room_of,
          const Neck& neck)
      : tree_(tree), room_of_(room_of), neck_(neck) {}

  [[nodiscard]] std::vector<Vec3> find() {
    for (const ways::NodeId id : neck_.nodes) {
      const ways::NodeId before = neighbour(id, [&](std::uint32_t room) { return room == neck_.rooms.front(); });
      if (before != ways::no_node) fronts_.push({tree_.node(id).clearance, id, before});
    }
    while (!fronts_.empty()) {
      const Front front = fronts_.top();
      fronts_.pop();
      if (!from_.emplace(front.node, front.from).second) continue;
      const ways::NodeId behind =
          neighbour(front.node, [&](std::uint32_t room) { return room != neck_.rooms.front(); });
      if (behind != ways::no_node) return back_from(front.node, behind);
      for (const ways::NodeId next : tree_.neighbours(front.node)) {
        if (is_in_neck(next) && !from_.contains(next))
          fronts_.push({std::min(front.least, tree_.node(next).clearance), next, front.node});
      }
    }
    return {};
  }

 private:
  [[nodiscard]] bool is_in_neck(ways::NodeId id) const {
    return std::binary_search(neck_.nodes.begin(), neck_.nodes.end(), id);
  }

  /// The widest neighbour in a room for which `wanted` is true.
  template <class Wanted>
  [[nodiscard]] ways::NodeId neighbour(ways::NodeId id, const Wanted& wanted) const {
    ways::NodeId best = ways::no_node;
    for (const ways::NodeId next : tree_.neighbours(id)) {
      const auto room = room_of_.find(next);
      if (room == room_of_.end() || !wanted(room->second)) continue;
      if (best == ways::no_node || tree_.node(next).clearance > tree_.node(best).clearance) best = next;
    }
    return best;
  }

  [[nodiscard]] std::vector<Vec3> back_from(ways::NodeId last, ways::NodeId behind) const {
    std::vector<Vec3> way{tree_.node(behind).place};
    add_widening(behind, way);
    std::reverse(way.begin(), way.end());
    ways::NodeId id = last;
    for (; is_in_neck(id); id = from_.at(id)) way.push_back(tree_.node(id).place);
    way.push_back(tree_.node(id).place);
    add_widening(id, way);
    std::reverse(way.begin(), way.end());
    return way;
  }

  /// Continues from a place of a room as long as the way widens. Refining keeps a way's ends, and beside a jamb they
  /// would be narrower than the door.
  void add_widening(ways::NodeId id, std::vector<Vec3>& way) const {
    const auto room = room_of_.find(id);
    if (room == room_of_.end()) return;
    for (std::size_t steps = 0; steps < most_steps; ++steps) {
      const ways::NodeId next = neighbour(id, [&](std::uint32_t other) { return other == room->second; });
      if (next == ways::no_node || tree_.node(next).clearance <= tree_.node(id).clearance) return;
      way.push_back(tree_.node(next).place);
      id = next;
    }
  }

  const ways::WidestTree& tree_;
  const std::unordered_map<ways::NodeId, std::uint32_t>& room_of_;
  const Neck& neck_;
  std::priority_queue<Front> fronts_;
  std::unordered_map<ways::NodeId, ways::NodeId> from_;
};

}  // namespace

std::vector<std::vector<Vec3>> neck_ways(const ways::WidestTree& tree, const Rooms& rooms) {
  std::unordered_map<ways::NodeId, std::uint32_t> room_of;
  for (std::uint32_t room = 0; room < rooms.rooms.size(); ++room)
    for (const ways::NodeId id : rooms.rooms[room].nodes) room_of.emplace(id, room);
  std::vector<std::vector<Vec3>> ways;
  for (const Neck& neck : rooms.necks) ways.push_back(NeckWay(tree, room_of, neck).find());
  return ways;
}

}  // namespace roam::training
