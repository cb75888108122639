#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <queue>
#include <set>

#include "math/disjoint_sets.h"
#include "training/places/basins.h"
#include "training/places/places.h"

namespace roam::training {

namespace {

/// Spacings: the largest distance of a place from the nearest lattice point, for a lattice that is not aligned with it.
constexpr double lattice_slack = 0.75;
/// m: with any_radius, necks between the same rooms are one if they are nearer.
constexpr double near_without_radius = 0.5;

class Partition {
 public:
  Partition(const Survey& survey, const ways::Measure& measure, const Component& component, const PlaceGraph& graph,
            double radius)
      : survey_(survey),
        measure_(measure),
        component_(component),
        graph_(graph),
        radius_(radius),
        room_(find_basins(graph, radius)),
        in_neck_(room_.size(), 0) {}

  Rooms run() {
    Rooms result;
    find_shores();
    if (std::isfinite(radius_)) find_narrows();
    make_necks(result);
    make_rooms(result);
    return result;
  }

 private:
  /// The places where two basins meet.
  void find_shores() {
    for (const PlaceEdge& edge : graph_.edges)
      if (room_[edge.a] != room_[edge.b]) in_neck_[edge.a] = in_neck_[edge.b] = 1;
  }

  /// Marks places more than radius_, in sight, from any place for a body of radius_, in basins that have such places.
  void find_narrows() {
    std::vector<char> has_wide(room_.size(), 0);
    for (Place p = 0; p < room_.size(); ++p)
      if (is_wide(p)) has_wide[room_[p]] = 1;
    const double reach = radius_ + lattice_slack * graph_.spacing;
    const std::vector<Place> nearest = nearest_wide(reach);
    for (Place p = 0; p < room_.size(); ++p)
      if (!is_wide(p) && has_wide[room_[p]] != 0 && nearest[p] == none) in_neck_[p] = 1;
  }

  [[nodiscard]] bool is_wide(Place p) const { return double(graph_.clearance[p]) >= radius_; }

  /// For each place, a wide one at most `reach` away and in sight; `none` if there is none. Fronts spread from all wide
  /// places over their neighbours and remember their origin.
  [[nodiscard]] std::vector<Place> nearest_wide(double reach) const {
    struct Front {
      double distance = 0.0;
      Place at = 0, from = 0;
      bool operator>(const Front& other) const {
        return distance != other.distance ? distance > other.distance
                                          : std::pair(at, from) > std::pair(other.at, other.from);
      }
    };
    std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
    std::vector<Place> nearest(room_.size(), none);
    const auto spread = [&](Place at, Place from) {
      for (const Place next : graph_.beside[at]) {
        if (nearest[next] != none || is_wide(next)) continue;
        const double distance = glm::length(graph_.where[next] - graph_.where[from]);
        if (distance <= reach) fronts.push({distance, next, from});
      }
    };
    for (Place p = 0; p < room_.size(); ++p) {
      if (!is_wide(p)) continue;
      nearest[p] = p;
      spread(p, p);
    }
    while (!fronts.empty()) {
      const Front front = fronts.top();
      fronts.pop();
      if (nearest[front.at] != none || !sees(front.from, front.at)) continue;
      nearest[front.at] = front.from;
      spread(front.at, front.from);
    }
    return nearest;
  }

  [[nodiscard]] bool sees(Place from, Place to) const {
    return goes_straight(survey_, measure_, graph_.where[from], graph_.where[to], measure_.narrowest);
  }

  /// A neck is a passage where two or more rooms meet. A passage that touches only one room is a corner of it and
  /// returns to it.
  void make_necks(Rooms& result) {
    DisjointSets passages(room_.size());
    for (const PlaceEdge& edge : graph_.edges)
      if (in_neck_[edge.a] != 0 && in_neck_[edge.b] != 0) passages.unite(edge.a, edge.b);
    std::map<std::uint32_t, Found> found;
    for (const PlaceEdge& edge : graph_.edges) {
      if (room_[edge.a] == room_[edge.b]) continue;
      Found& neck = found[passages.find(edge.a)];
      neck.rooms.insert({room_[edge.a], room_[edge.b]});
      neck.radius = std::max(neck.radius, double(edge.clearance));
    }
    for (Place p = 0; p < room_.size(); ++p) {
      if (in_neck_[p] == 0) continue;
      const auto neck = found.find(passages.find(p));
      if (neck == found.end())
        in_neck_[p] = 0;
      else
        neck->second.places.push_back(p);
    }
    keep_rooms_from_vanishing(found);
    for (Found& neck : merged(found)) {
      std::sort(neck.places.begin(), neck.places.end());
      Neck made;
      for (const Place p : neck.places) made.nodes.push_back(component_.nodes[p]);
      made.rooms.assign(neck.rooms.begin(), neck.rooms.end());
      made.radius = neck.radius;
      result.necks.push_back(std::move(made));
    }
    std::stable_sort(result.necks.begin(), result.necks.end(),
                     [](const Neck& a, const Neck& b) { return a.radius > b.radius; });
  }

  struct Found {
    std::vector<Place> places;
    std::set<std::uint32_t> rooms;
    double radius = 0.0;
  };

  /// Takes each room's widest place out of its neck.
  void keep_rooms_from_vanishing(std::map<std::uint32_t, Found>& necks) {
    widest_.assign(room_.size(), none);
    for (Place p = 0; p < room_.size(); ++p) {
      Place& widest = widest_[room_[p]];
      if (widest == none || graph_.clearance[p] > graph_.clearance[widest]) widest = p;
    }
    for (auto& [name, neck] : necks) {
      const auto is_kept = [&](Place p) { return widest_[room_[p]] == p; };
      for (const Place p : neck.places)
        if (is_kept(p)) in_neck_[p] = 0;
      neck.places.erase(std::remove_if(neck.places.begin(), neck.places.end(), is_kept), neck.places.end());
    }
  }

  [[nodiscard]] Box box_of(const Found& neck) const {
    Box box;
    for (const Place p : neck.places) box.include(graph_.where[p]);
    return box;
  }

  /// Joins necks between the same rooms that lie near each other.
  [[nodiscard]] std::vector<Found> merged(const std::map<std::uint32_t, Found>& found) const {
    std::vector<Found> necks;
    for (const auto& [name, neck] : found)
      if (!neck.places.empty()) necks.push_back(neck);
    const double near = std::isfinite(radius_) ? 2.0 * radius_ : near_without_radius;
    const auto apart = [&](const Found& a, const Found& b) {
      const Box x = box_of(a), y = box_of(b);
      double most = 0.0;
      for (int k = 0; k < 3; ++k) most = std::max({most, x.lower[k] - y.upper[k], y.lower[k] - x.upper[k]});
      return most > near;
    };
    for (std::size_t i = 0; i < necks.size(); ++i) {
      for (std::size_t j = i + 1; j < necks.size();) {
        if (necks[i].rooms != necks[j].rooms || apart(necks[i], necks[j])) {
          ++j;
          continue;
        }
        necks[i].places.insert(necks[i].places.end(), necks[j].places.begin(), necks[j].places.end());
        necks[i].radius = std::max(necks[i].radius, necks[j].radius);
        necks.erase(necks.begin() + static_cast<std::ptrdiff_t>(j));
        j = i + 1;  // the neck has grown
      }
    }
    return necks;
  }

  /// Sorts the rooms by size, and updates their numbers in the necks.
  void make_rooms(Rooms& result) const {
    const std::uint32_t count = room_.empty() ? 0 : 1 + *std::max_element(room_.begin(), room_.end());
    std::vector<Room> rooms(count);
    for (Place p = 0; p < room_.size(); ++p) {
      if (in_neck_[p] == 0) rooms[room_[p]].nodes.push_back(component_.nodes[p]);
    }
    for (std::uint32_t r = 0; r < count; ++r) rooms[r].widest = component_.nodes[widest_[r]];
    std::vector<std::uint32_t> order(count), number(count);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return rooms[a].nodes.size() > rooms[b].nodes.size(); });
    for (std::uint32_t i = 0; i < count; ++i) {
      number[order[i]] = i;
      result.rooms.push_back(std::move(rooms[order[i]]));
    }
    for (Neck& neck : result.necks) {
      for (std::uint32_t& room : neck.rooms) room = number[room];
      std::sort(neck.rooms.begin(), neck.rooms.end());
    }
  }

  static constexpr Place none = ~Place(0);

  const Survey& survey_;
  const ways::Measure& measure_;
  const Component& component_;
  const PlaceGraph& graph_;
  double radius_;
  std::vector<std::uint32_t> room_;  ///< of each place
  std::vector<char> in_neck_;        ///< of each place
  std::vector<Place> widest_;        ///< of each room
};

}  // namespace

std::size_t Rooms::dead_ends() const {
  std::vector<std::set<std::uint32_t>> others(rooms.size());
  for (const Neck& neck : necks) {
    for (const std::uint32_t a : neck.rooms)
      for (const std::uint32_t b : neck.rooms)
        if (a != b) others[a].insert(b);
  }
  return static_cast<std::size_t>(
      std::count_if(others.begin(), others.end(), [](const auto& beside) { return beside.size() == 1; }));
}

Rooms find_rooms(const Survey& survey, const ways::Measure& measure, const ways::WidestTree& tree,
                 const Component& component, double radius) {
  const PlaceGraph graph = place_graph(survey, measure, tree, component, radius);
  return Partition(survey, measure, component, graph, radius).run();
}

}  // namespace roam::training
