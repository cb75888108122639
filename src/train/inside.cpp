#include "train/inside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "train/places_columns.h"

namespace roam::training {

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::inside:
      return "inside";
    case Verdict::backs:
      return "backs";
    case Verdict::on_top:
      return "on top";
    case Verdict::smaller:
      return "smaller";
  }
  return "";
}

namespace {

/// Places of a component that are asked, at most.
constexpr std::size_t asked = 64;
/// Of the places of a component, or the directions that lead out of it: more than so many decide.
constexpr double majority = 0.5;
/// Windings are trusted where so many of the shared edges run both ways.
constexpr double trusted_share = 0.9;
/// Places of which a body can make no way: a component of fewer is none that is meant to be walked in.
constexpr std::size_t least_places = 8;
/// m: what is no wider is a ledge, from which one falls on one side though there may be nothing at all on the other.
constexpr double ledge_width = 2.5;
/// What is open to the sky beside something closed is a roof, or a niche outside, when it has not so much of its
/// places.
constexpr double least_open_share = 0.1;
/// m: the columns in which places are looked up.
constexpr double column = 0.5;
/// m: how far beyond its last place a component is followed to where one falls from it.
constexpr double stride = 0.4;

class Judge {
 public:
  Judge(const Survey& survey, const Measure& measure, const WidestTree& tree, std::vector<Component>& components)
      : survey_(survey), measure_(measure), tree_(tree), components_(components) {}

  void run(bool trusted) {
    for (Component& c : components_) look(c);
    if (measure_.mode == Mode::walk) {
      for (std::uint32_t i = 0; i < components_.size(); ++i)
        for (const NodeId id : components_[i].nodes) columns_.add(tree_.node(id).place, i);
    }
    for (std::uint32_t i = 0; i < components_.size(); ++i)
      if (is_on_top(i)) components_[i].verdict = Verdict::on_top;
    if (trusted)
      sort_out_backs();
    else
      keep_the_largest();
    sort_out_small();
    // Something is what the scene is for: with nothing left, that with the most places.
    const auto is_inside = [](const Component& c) { return c.verdict == Verdict::inside; };
    if (std::none_of(components_.begin(), components_.end(), is_inside)) components_.front().verdict = Verdict::inside;
    for (Component& c : components_) c.inside = is_inside(c);
  }

 private:
  /// Some of the nodes of a component, spread over it.
  [[nodiscard]] std::vector<NodeId> some(const Component& c) const {
    const std::size_t count = std::min(asked, c.nodes.size());
    std::vector<NodeId> chosen;
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(c.nodes[i * c.nodes.size() / count]);
    return chosen;
  }

  void look(Component& c) const {
    const std::vector<NodeId> chosen = some(c);
    std::size_t backs = 0, open = 0;
    for (const NodeId id : chosen) {
      const Surroundings s = look_around(survey_, eye_over(measure_, tree_.node(id)));
      if (s.backs) ++backs;
      if (s.open) ++open;
    }
    c.back_share = static_cast<double>(backs) / static_cast<double>(chosen.size());
    c.open_share = static_cast<double>(open) / static_cast<double>(chosen.size());
  }

  [[nodiscard]] bool is_on_top(std::uint32_t i) const {
    const bool open = components_[i].open_share > majority;
    if (measure_.mode != Mode::walk) {
      // Who flies is over everything when outside: what is closed is the scene, where there is such a thing.
      return open && std::any_of(components_.begin(), components_.end(),
                                 [](const Component& c) { return c.open_share <= majority; });
    }
    return (open && is_lid(i)) || is_ledge(i);
  }

  /// Most places lie straight over another component: a roof, or the ground on top of a shallow tunnel.
  [[nodiscard]] bool is_lid(std::uint32_t i) const {
    const std::vector<NodeId> chosen = some(components_[i]);
    std::size_t over = 0;
    for (const NodeId id : chosen) {
      const Vec3 place = tree_.node(id).place;
      if (columns_.any(place, 0, [&](const auto& e) { return e.owner != i && e.z < place.z - measure_.step; })) ++over;
    }
    return static_cast<double>(over) > majority * static_cast<double>(chosen.size());
  }

  /// Most ways out of it fall into a larger component: the top of a wall, a wardrobe, a roof.
  [[nodiscard]] bool is_ledge(std::uint32_t i) const {
    if (i == 0) return false;  // nothing is larger
    std::size_t ways_out = 0, falls = 0, voids = 0, looked_at = 0;
    // Few places of a wide component are at its rim: all of a small one, and more of a large one, are asked.
    const std::vector<NodeId>& nodes = components_[i].nodes;
    const std::size_t stride_of_nodes = 1 + nodes.size() / (asked * asked);
    for (std::size_t n = 0; n < nodes.size(); n += stride_of_nodes) {
      const Node& node = tree_.node(nodes[n]);
      ++looked_at;
      for (const Vec3& direction : ways_out_of(nodes[n])) {
        ++ways_out;
        const Beyond beyond = beyond_rim(node, direction, i);
        if (beyond == Beyond::larger) ++falls;
        if (beyond == Beyond::nothing) ++voids;
      }
    }
    // A strip of width w has two rims: 2 ways out for every w / spacing places.
    const double cell = spacing_of(tree_, nodes.front());
    const bool narrow = 2.0 * cell * static_cast<double>(looked_at) <= ledge_width * static_cast<double>(ways_out);
    if (narrow) ways_out -= voids;
    return static_cast<double>(falls) > majority * static_cast<double>(ways_out);
  }

  /// The directions along the lattice in which a place has no neighbour.
  [[nodiscard]] std::vector<Vec3> ways_out_of(NodeId id) const {
    static constexpr std::array<Vec3, 4> compass{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)};
    constexpr double about_that_way = 0.9;  // cosine
    const Vec3 place = tree_.node(id).place;
    const Neighbours neighbours = tree_.neighbours(id);
    std::vector<Vec3> out;
    for (const Vec3& direction : compass) {
      const bool taken = std::any_of(neighbours.begin(), neighbours.end(), [&](NodeId n) {
        Vec3 to = tree_.node(n).place - place;
        to.z = 0.0;
        return glm::dot(to, direction) > about_that_way * glm::length(to);
      });
      if (!taken) out.push_back(direction);
    }
    return out;
  }

  /// What one who goes on over the rim comes to.
  enum class Beyond : std::uint8_t { other, larger, nothing };
  [[nodiscard]] Beyond beyond_rim(const Node& node, const Vec3& direction, std::uint32_t i) const {
    const Vec3 eye = eye_over(measure_, node);
    const World& world = survey_.world();
    if (world.ray(eye, stride * direction).hit) return Beyond::other;
    const Vec3 beyond = eye + stride * direction;
    const double deep = std::clamp(beyond.z - world.bounds().lower.z + 1.0, 1.0, 1e5);
    const Impact down = world.ray(beyond, Vec3(0.0, 0.0, -deep));
    if (!down.hit) return Beyond::nothing;
    if (down.point.z > node.place.z - measure_.step) return Beyond::other;
    const double level = down.point.z;
    const bool larger = columns_.any(
        down.point, 1, [&](const auto& e) { return e.owner < i && std::abs(e.z - level) <= measure_.step; });
    return larger ? Beyond::larger : Beyond::other;
  }

  /// Windings say which side is out, and how much of the scene looks at which side says whether they say it right.
  void sort_out_backs() {
    double fronts = 0.0, backs = 0.0;
    for (const Component& c : components_) {
      if (c.verdict == Verdict::on_top) continue;
      (c.back_share > majority ? backs : fronts) += static_cast<double>(c.nodes.size());
    }
    const bool reversed = fronts * reversed_ratio < backs;
    for (Component& c : components_)
      if (c.verdict != Verdict::on_top && (c.back_share > majority) != reversed) c.verdict = Verdict::backs;
  }

  /// Scraps, and what is open to the sky and small beside what is not.
  void sort_out_small() {
    std::size_t closed = 0;
    for (const Component& c : components_)
      if (c.verdict == Verdict::inside && c.open_share <= majority) closed = std::max(closed, c.nodes.size());
    for (Component& c : components_) {
      if (c.verdict != Verdict::inside) continue;
      if (c.nodes.size() < least_places) c.verdict = Verdict::smaller;
      const bool little = static_cast<double>(c.nodes.size()) < least_open_share * static_cast<double>(closed);
      if (c.open_share > majority && little) c.verdict = Verdict::on_top;
    }
  }

  void keep_the_largest() {
    bool found = false;
    for (Component& c : components_) {
      if (c.verdict == Verdict::on_top) continue;
      if (found) c.verdict = Verdict::smaller;
      found = true;
    }
  }

  const Survey& survey_;
  const Measure& measure_;
  const WidestTree& tree_;
  std::vector<Component>& components_;
  Columns columns_{column};
};

}  // namespace

double spacing_of(const WidestTree& tree, NodeId id) {
  double least = 0.0;
  for (const NodeId beside : tree.neighbours(id)) {
    const Vec3 to = tree.node(beside).place - tree.node(id).place;
    const double apart = std::hypot(to.x, to.y);
    if (apart > 0.0 && (least == 0.0 || apart < least)) least = apart;
  }
  return least;
}

bool windings_can_be_trusted(const Survey& survey) { return winding_share(survey) >= trusted_share; }

void judge(const Survey& survey, const Measure& measure, const WidestTree& tree, bool trusted,
           std::vector<Component>& components) {
  if (!components.empty()) Judge(survey, measure, tree, components).run(trusted);
}

}  // namespace roam::training
