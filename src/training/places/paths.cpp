#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <queue>
#include <set>
#include <unordered_map>

#include "math/random.h"
#include "training/places/places.h"

namespace roam::training {

namespace {

/// Paths of a simple scene, as in the paper.
constexpr std::size_t usual_paths = 5;
/// m: how far an end may move to a wider place.
constexpr double end_reach = 2.0;

constexpr std::uint32_t no_room = ~std::uint32_t(0);
constexpr std::uint32_t nowhere = ~std::uint32_t(0);

class PathDrawer {
 public:
  PathDrawer(const ways::WidestTree& tree, const Component& component, const Rooms& rooms, std::uint64_t seed)
      : tree_(tree),
        component_(component),
        rooms_(rooms),
        draw_(seed),
        index_(tree.size(), nowhere),
        room_of_(component.nodes.size(), no_room) {
    for (std::size_t i = 0; i < component.nodes.size(); ++i) index_[component.nodes[i]] = static_cast<std::uint32_t>(i);
    for (std::uint32_t r = 0; r < rooms.rooms.size(); ++r)
      for (const ways::NodeId id : rooms.rooms[r].nodes) room_of_[index(id)] = r;
  }

  std::vector<Ends> run(std::size_t count, bool may_add) {
    cross_every_room(count);
    while (ends_.size() < count && add_far_path()) {
    }
    if (may_add) visit_what_is_left();
    return ends_;
  }

 private:
  [[nodiscard]] std::size_t index(ways::NodeId id) const { return index_[id]; }
  [[nodiscard]] bool is_here(ways::NodeId id) const { return index_[id] != nowhere; }

  /// For each room, the rooms that the tree's ways lead to directly.
  [[nodiscard]] std::vector<std::set<std::uint32_t>> links() const {
    std::vector<std::set<std::uint32_t>> links(rooms_.rooms.size());
    std::vector<std::vector<ways::NodeId>> children(component_.nodes.size());
    for (const ways::NodeId id : component_.nodes)
      if (tree_.parent(id) != ways::no_node && is_here(tree_.parent(id)))
        children[index(tree_.parent(id))].push_back(id);
    // Goes from the root outwards with the last room passed. Ways that begin in a neck take their first room from
    // `first`.
    std::uint32_t first = no_room;
    std::vector<std::pair<ways::NodeId, std::uint32_t>> stack{{component_.root, no_room}};
    while (!stack.empty()) {
      const auto [id, from] = stack.back();
      stack.pop_back();
      std::uint32_t room = room_of_[index(id)];
      if (room == no_room) {
        room = from;
      } else {
        const std::uint32_t other = from == no_room ? first : from;
        if (other != no_room && other != room) {
          links[other].insert(room);
          links[room].insert(other);
        }
        if (first == no_room) first = room;
      }
      for (const ways::NodeId child : children[index(id)]) stack.emplace_back(child, room);
    }
    return links;
  }

  /// The rooms with one link, in the order of a walk that always keeps to one hand.
  [[nodiscard]] static std::vector<std::uint32_t> leaves(const std::vector<std::set<std::uint32_t>>& links) {
    std::vector<std::uint32_t> order;
    std::vector<char> seen(links.size(), 0);
    for (std::uint32_t start = 0; start < links.size(); ++start) {
      std::vector<std::uint32_t> stack{start};
      while (!stack.empty()) {
        const std::uint32_t room = stack.back();
        stack.pop_back();
        if (seen[room] != 0) continue;
        seen[room] = 1;
        if (links[room].size() == 1) order.push_back(room);
        for (const std::uint32_t next : links[room])
          if (seen[next] == 0) stack.push_back(next);
      }
    }
    return order;
  }

  /// Joins each dead end with the one half way around. Any link divides the round into two parts, so some path crosses
  /// it.
  void cross_every_room(std::size_t count) {
    const std::vector<std::uint32_t> round = leaves(links());
    if (round.size() < 2) return;
    const std::size_t half = round.size() / 2, start = draw_.below(round.size());
    for (std::size_t i = 0; i < round.size() && ends_.size() < count; ++i) {
      const std::uint32_t from = round[(start + i) % round.size()], to = round[(start + i + half) % round.size()];
      add(drawn_from(from), drawn_from(to));
    }
  }

  /// The widest place near a random place of a room.
  [[nodiscard]] ways::NodeId drawn_from(std::uint32_t room) {
    const std::vector<ways::NodeId>& nodes = rooms_.rooms[room].nodes;
    if (nodes.empty()) return rooms_.rooms[room].widest;
    return widest_near(nodes[draw_.below(nodes.size())]);
  }

  /// The widest place of the same room within end_reach along the lattice; the nearest among equals.
  [[nodiscard]] ways::NodeId widest_near(ways::NodeId start) const {
    struct Step {
      double distance = 0.0;
      ways::NodeId id = ways::no_node;
      bool operator>(const Step& other) const {
        return distance != other.distance ? distance > other.distance : id > other.id;
      }
    };
    std::priority_queue<Step, std::vector<Step>, std::greater<>> steps;
    std::set<ways::NodeId> done;
    steps.push({0.0, start});
    ways::NodeId widest = start;
    while (!steps.empty()) {
      const Step step = steps.top();
      steps.pop();
      if (!done.insert(step.id).second) continue;
      if (tree_.node(step.id).clearance > tree_.node(widest).clearance) widest = step.id;
      for (const ways::NodeId next : tree_.neighbours(step.id)) {
        if (!is_here(next) || room_of_[index(next)] != room_of_[index(start)]) continue;
        const double distance = step.distance + glm::length(tree_.node(next).place - tree_.node(step.id).place);
        if (distance <= end_reach) steps.push({distance, next});
      }
    }
    return widest;
  }

  /// The first room on a way.
  [[nodiscard]] std::uint32_t first_room(const std::vector<ways::NodeId>& way) const {
    for (const ways::NodeId id : way)
      if (room_of_[index(id)] != no_room) return room_of_[index(id)];
    return no_room;
  }

  /// `from`, or another place of its room if the way is narrowest inside that room: the way between rooms is to decide,
  /// not the corner where an end was drawn. If the way leaves the room, that place is the room's widest. Otherwise it
  /// lies along the way, as far as the way keeps widening.
  [[nodiscard]] ways::NodeId out_of_corner(ways::NodeId from, ways::NodeId to) const {
    std::vector<ways::NodeId> way = tree_.way(from, to);
    const std::uint32_t room = first_room(way);
    if (room == no_room) return from;
    const auto here = [&](ways::NodeId id) { return room_of_[index(id)] == room; };
    const auto left = std::find_if_not(std::find_if(way.begin(), way.end(), here), way.end(), here);
    if (left == way.end()) return widening(way);
    const auto within = std::min_element(way.begin(), left, narrower_),
               beyond = std::min_element(left, way.end(), narrower_);
    return narrower_(*within, *beyond) ? rooms_.rooms[room].widest : from;
  }

  /// The beginning of a way without the part where it widens. Moves on while the narrowest place lies within end_reach
  /// and a place wider by more than the lattice's error follows within that distance.
  [[nodiscard]] ways::NodeId widening(const std::vector<ways::NodeId>& way) const {
    constexpr float wider = 1.1F;
    auto begin = way.begin();
    for (;;) {
      auto end = begin;
      for (double gone = 0.0; end + 1 != way.end() && gone <= end_reach; ++end)
        gone += glm::length(tree_.node(*(end + 1)).place - tree_.node(*end).place);
      const auto narrowest = std::min_element(begin, way.end(), narrower_);
      const auto widest = std::max_element(begin, end, narrower_);
      if (narrowest >= end || tree_.node(*widest).clearance <= wider * tree_.node(*narrowest).clearance) return *begin;
      if (widest <= narrowest) return *begin;
      begin = widest;
    }
  }

  void add(ways::NodeId from, ways::NodeId to) {
    if (from == to) return;
    from = out_of_corner(from, to);
    to = out_of_corner(to, from);
    if (from == to) return;
    ends_.push_back({from, to});
    visited_.insert(from);
    visited_.insert(to);
  }

  /// The place with the most steps from all ends so far.
  [[nodiscard]] ways::NodeId farthest() const {
    std::vector<char> seen(component_.nodes.size(), 0);
    std::vector<std::size_t> round;
    for (const ways::NodeId id : visited_) {
      seen[index(id)] = 1;
      round.push_back(index(id));
    }
    for (std::size_t next = 0; next < round.size(); ++next) {
      for (const ways::NodeId beside : tree_.neighbours(component_.nodes[round[next]])) {
        if (!is_here(beside) || seen[index(beside)] != 0) continue;
        seen[index(beside)] = 1;
        round.push_back(index(beside));
      }
    }
    return component_.nodes[round.back()];
  }

  /// Adds a path from the place farthest from all ends so far to the place farthest after that. The first path begins
  /// at a random place.
  bool add_far_path() {
    const ways::NodeId from =
        widest_near(visited_.empty() ? component_.nodes[draw_.below(component_.nodes.size())] : farthest());
    const std::size_t before = visited_.size();
    visited_.insert(from);
    const ways::NodeId to = widest_near(farthest());
    add(from, to);
    return visited_.size() > before + (from == to ? 1 : 0) && from != to;
  }

  /// Gives each room that no way has crossed a path of its own.
  void visit_what_is_left() {
    if (rooms_.rooms.size() < 2) return;
    std::vector<char> crossed(rooms_.rooms.size(), 0);
    const auto mark = [&](const Ends& ends) {
      for (const ways::NodeId id : tree_.way(ends.from, ends.to))
        if (const std::uint32_t room = room_of_[index(id)]; room != no_room) crossed[room] = 1;
    };
    for (const Ends& ends : ends_) mark(ends);
    for (std::uint32_t room = 0; room < crossed.size(); ++room) {
      if (crossed[room] != 0) continue;
      add(rooms_.rooms[room].widest, rooms_.rooms[room == 0 ? 1 : 0].widest);
      mark(ends_.back());
    }
  }

  struct Narrower {
    const ways::WidestTree& tree;
    bool operator()(ways::NodeId a, ways::NodeId b) const { return tree.node(a).clearance < tree.node(b).clearance; }
  };

  const ways::WidestTree& tree_;
  const Narrower narrower_{tree_};
  const Component& component_;
  const Rooms& rooms_;
  Draw draw_;
  std::vector<std::uint32_t> index_;    ///< index in the component of each node of the tree; nowhere
  std::vector<std::uint32_t> room_of_;  ///< of each node of the component; no_room in necks
  std::vector<Ends> ends_;
  std::set<ways::NodeId> visited_;
};

}  // namespace

std::vector<Ends> draw_paths(const ways::WidestTree& tree, const Component& component, const Rooms& rooms, int count,
                             std::uint64_t seed) {
  if (component.nodes.size() < 2) return {};
  const bool given = count > 0;
  const std::size_t paths = given ? static_cast<std::size_t>(count) : std::max(usual_paths, rooms.dead_ends());
  return PathDrawer(tree, component, rooms, seed).run(paths, !given);
}

}  // namespace roam::training
