#include "training/places/inside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "training/places/columns.h"

namespace roam::training {

namespace {

/// Places of a component that are examined, at most.
constexpr std::size_t most_examined = 64;
/// More than this share of a component's places, or of the directions out of it, decides.
constexpr double majority = 0.5;
/// Windings are trusted if at least this share of the shared edges runs both ways.
constexpr double trusted_share = 0.9;
/// A component with fewer places is too small for a path: no part of the scene to walk in.
constexpr std::size_t least_places = 8;
/// m: a component no wider is a ledge if a body falls from one side of it, even if nothing at all lies on the other
/// side.
constexpr double ledge_width = 2.5;
/// A component open to the sky needs this share of a closed one's places beside it. Otherwise it is a roof, or a niche
/// outside.
constexpr double least_open_share = 0.1;
/// Flying: closed components must see this share of the triangles that an open one sees, or they are not the scene.
constexpr double least_seen_share = 0.1;
/// Without trusted windings, a closed component is a room if it has at least this share of the largest one's places.
constexpr double least_closed_share = 0.25;
/// m: side of the columns for looking up places.
constexpr double column = 0.5;
/// m: the least height of a room, with windings that distinguish rooms from solids, and without.
constexpr double low_room = 1.0;
constexpr double sure_room = 1.5;
/// m: step beyond a component's last place to test for a fall.
constexpr double stride = 0.4;

class Judge {
 public:
  Judge(const Survey& survey, const ways::Measure& measure, const ways::WidestTree& tree,
        std::vector<Component>& components)
      : survey_(survey), measure_(measure), tree_(tree), components_(components) {}

  void run(bool trusted) {
    trusted_ = trusted;
    for (Component& c : components_) look(c);
    if (measure_.mode == Mode::walk) {
      for (std::uint32_t i = 0; i < components_.size(); ++i)
        for (const ways::NodeId id : components_[i].nodes) columns_.add(tree_.node(id).place, i);
    }
    if (measure_.mode == Mode::fly) see_surfaces();
    for (std::uint32_t i = 0; i < components_.size(); ++i)
      if (is_on_top(i))
        components_[i].verdict = Verdict::on_top;
      else if (is_over_low_rooms(components_[i]))
        components_[i].verdict = Verdict::over_low_rooms;
    if (trusted)
      sort_out_backs();
    else
      keep_what_may_be_rooms();
    sort_out_small();
    if (measure_.mode == Mode::fly) sort_out_hollows();
    // Some part of a scene is its inside: if none is left, the component with most places. Exception: a body that fits
    // only on top of low rooms is nowhere inside.
    const auto has = [&](Verdict verdict) {
      return std::any_of(components_.begin(), components_.end(),
                         [&](const Component& c) { return c.verdict == verdict; });
    };
    if (!has(Verdict::inside) && !has(Verdict::over_low_rooms)) components_.front().verdict = Verdict::inside;
    for (Component& c : components_) c.inside = c.verdict == Verdict::inside;
  }

 private:
  /// Some of the nodes of a component, spread over it.
  [[nodiscard]] std::vector<ways::NodeId> some(const Component& c) const {
    const std::size_t count = std::min(most_examined, c.nodes.size());
    std::vector<ways::NodeId> chosen;
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(c.nodes[i * c.nodes.size() / count]);
    return chosen;
  }

  void look(Component& c) const {
    const std::vector<ways::NodeId> chosen = some(c);
    std::size_t backs = 0, open = 0;
    for (const ways::NodeId id : chosen) {
      const Surroundings s = look_around(survey_, eye_over(measure_, tree_.node(id)));
      if (s.backs) ++backs;
      if (s.open) ++open;
    }
    c.back_share = static_cast<double>(backs) / static_cast<double>(chosen.size());
    c.open_share = static_cast<double>(open) / static_cast<double>(chosen.size());
  }

  [[nodiscard]] bool is_on_top(std::uint32_t i) {
    const bool open = components_[i].open_share > majority;
    if (measure_.mode != Mode::walk) {
      // Outside, a flying body is over everything. So closed components are the scene if they see a good part of it.
      return open && closed_sees_ >= least_seen_share * static_cast<double>(seen_[i]);
    }
    return (open && (is_lid(i) || is_over_more(i))) || is_ledge(i);
  }

  void see_surfaces() {
    seen_ = surfaces_seen(survey_, tree_, components_);
    for (std::size_t i = 0; i < components_.size(); ++i)
      if (components_[i].open_share <= majority) closed_sees_ = std::max(closed_sees_, static_cast<double>(seen_[i]));
  }

  /// In an open scene, a closed component that sees little lies within or under something solid.
  void sort_out_hollows() {
    double most = 0.0;
    for (std::size_t i = 0; i < components_.size(); ++i)
      if (components_[i].verdict == Verdict::inside && components_[i].open_share > majority)
        most = std::max(most, static_cast<double>(seen_[i]));
    for (std::size_t i = 0; i < components_.size(); ++i)
      if (components_[i].verdict == Verdict::inside && static_cast<double>(seen_[i]) < least_seen_share * most)
        components_[i].verdict = Verdict::smaller;
  }

  /// Whether most places lie straight above another component: a roof, or the ground over a shallow tunnel.
  [[nodiscard]] bool is_lid(std::uint32_t i) const {
    const std::vector<ways::NodeId> chosen = some(components_[i]);
    std::size_t over = 0;
    for (const ways::NodeId id : chosen) {
      const Vec3 place = tree_.node(id).place;
      if (columns_.any(place, 0, [&](const auto& e) { return e.owner != i && e.z < place.z - measure_.step; })) ++over;
    }
    return static_cast<double>(over) > majority * static_cast<double>(chosen.size());
  }

  /// Whether the closed components straight below its places have more of the floors' triangles, as under a roof that
  /// is larger than the rooms of its house.
  [[nodiscard]] bool is_over_more(std::uint32_t i) {
    std::vector<bool> below(components_.size(), false);
    for (const ways::NodeId id : some(components_[i])) {
      const Vec3 place = tree_.node(id).place;
      (void)columns_.any(place, 0, [&](const auto& e) {
        if (e.z < place.z - measure_.step && components_[e.owner].open_share <= majority) below[e.owner] = true;
        return false;
      });
    }
    if (std::find(below.begin(), below.end(), true) == below.end()) return false;
    if (details_.empty()) details_ = floor_details(survey_, tree_, components_);
    std::size_t details = 0;
    for (std::size_t j = 0; j < below.size(); ++j)
      if (below[j]) details += details_[j];
    return details > details_[i];
  }

  /// Whether most places are open to the sky and lie straight above a room that a lower body fits into.
  [[nodiscard]] bool is_over_low_rooms(const Component& c) const {
    if (measure_.mode != Mode::walk || c.open_share <= majority) return false;
    const std::vector<ways::NodeId> chosen = some(c);
    const auto over = std::count_if(chosen.begin(), chosen.end(),
                                    [&](ways::NodeId id) { return has_low_room_below(tree_.node(id).place); });
    return static_cast<double>(over) > majority * static_cast<double>(chosen.size());
  }

  [[nodiscard]] bool has_low_room_below(const Vec3& place) const {
    constexpr int storeys = 8;
    constexpr double above = 0.05, thin = 1e-3;  // m
    const World& world = survey_.world();
    const double deep = std::clamp(place.z - world.bounds().lower.z + 1.0, 1.0, 1e5);
    Vec3 from = place + Vec3(0.0, 0.0, above);
    std::optional<double> ceiling;
    bool top_is_front = false;
    for (int i = 0; i < storeys; ++i) {
      const Impact down = world.ray(from, Vec3(0.0, 0.0, -deep));
      if (!down.hit) return false;
      const Triangle t = survey_.triangle(down.triangle);
      const bool is_front = glm::cross(t[1] - t[0], t[2] - t[0]).z > 0.0;
      if (!ceiling) {
        top_is_front = is_front;
      } else {
        const double high = *ceiling - down.point.z;
        // The bottom of solid ground is seen from its back there. So is a floor in a scene with reversed windings.
        const bool is_floor = !trusted_ || is_front || !top_is_front;
        if (is_floor && high >= (trusted_ ? low_room : sure_room) && high < measure_.height) return true;
      }
      ceiling = down.point.z;
      from = down.point - Vec3(0.0, 0.0, thin);
    }
    return false;
  }

  /// Whether most ways out fall into a larger component: the top of a wall, a wardrobe, a roof.
  [[nodiscard]] bool is_ledge(std::uint32_t i) const {
    if (i == 0) return false;  // nothing is larger
    std::size_t ways_out = 0, falls = 0, voids = 0, looked_at = 0;
    // Few places of a wide component lie at its rim. So all places of a small component are examined, and a sample of a
    // large one.
    const std::vector<ways::NodeId>& nodes = components_[i].nodes;
    const std::size_t stride_of_nodes = 1 + nodes.size() / (most_examined * most_examined);
    for (std::size_t n = 0; n < nodes.size(); n += stride_of_nodes) {
      const ways::Node& node = tree_.node(nodes[n]);
      ++looked_at;
      for (const Vec3& direction : ways_out_of(nodes[n])) {
        ++ways_out;
        const Beyond beyond = beyond_rim(node, direction, i);
        if (beyond == Beyond::larger) ++falls;
        if (beyond == Beyond::nothing) ++voids;
      }
    }
    // A strip of width w has two rims: 2 ways out for every w / spacing places.
    const double cell = tree_.spacing();
    const bool narrow = 2.0 * cell * static_cast<double>(looked_at) <= ledge_width * static_cast<double>(ways_out);
    if (narrow) ways_out -= voids;
    return static_cast<double>(falls) > majority * static_cast<double>(ways_out);
  }

  /// The directions along the lattice in which a place has no neighbour.
  [[nodiscard]] std::vector<Vec3> ways_out_of(ways::NodeId id) const {
    static constexpr std::array<Vec3, 4> compass{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)};
    constexpr double about_that_way = 0.9;  // cosine
    const Vec3 place = tree_.node(id).place;
    const ways::Neighbours neighbours = tree_.neighbours(id);
    std::vector<Vec3> out;
    for (const Vec3& direction : compass) {
      const bool taken = std::any_of(neighbours.begin(), neighbours.end(), [&](ways::NodeId n) {
        Vec3 to = tree_.node(n).place - place;
        to.z = 0.0;
        return glm::dot(to, direction) > about_that_way * glm::length(to);
      });
      if (!taken) out.push_back(direction);
    }
    return out;
  }

  /// The ground beyond a component's rim.
  enum class Beyond : std::uint8_t { other, larger, nothing };
  [[nodiscard]] Beyond beyond_rim(const ways::Node& node, const Vec3& direction, std::uint32_t i) const {
    const Vec3 eye = eye_over(measure_, node);
    const World& world = survey_.world();
    if (world.first_impact({0.0, 0.0}, eye, stride * direction).hit) return Beyond::other;
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

  [[nodiscard]] static bool is_over_something(const Component& c) {
    return c.verdict == Verdict::on_top || c.verdict == Verdict::over_low_rooms;
  }

  /// Marks components that see backs. If far more places see backs than fronts, the windings are reversed.
  void sort_out_backs() {
    double fronts = 0.0, backs = 0.0;
    for (const Component& c : components_) {
      if (c.verdict == Verdict::on_top) continue;
      (c.back_share > majority ? backs : fronts) += static_cast<double>(c.nodes.size());
    }
    const bool reversed = fronts * reversed_ratio < backs;
    for (Component& c : components_)
      if (!is_over_something(c) && (c.back_share > majority) != reversed) c.verdict = Verdict::backs;
  }

  /// Marks scraps, and small components open to the sky beside larger closed ones.
  void sort_out_small() {
    std::size_t closed = 0;
    for (const Component& c : components_)
      if (c.verdict == Verdict::inside && c.open_share <= majority) closed = std::max(closed, c.nodes.size());
    for (Component& c : components_) {
      if (c.verdict != Verdict::inside) continue;
      if (is_scrap(c)) c.verdict = Verdict::smaller;
      const bool little = static_cast<double>(c.nodes.size()) < least_open_share * static_cast<double>(closed);
      if (c.open_share > majority && little) c.verdict = Verdict::on_top;
    }
  }

  /// Without trusted windings, a closed component not much smaller than the rest is a room, unlike the inside of a
  /// wardrobe. Only the largest component open to the sky is part of the scene.
  void keep_what_may_be_rooms() {
    std::size_t most = 0;
    for (Component& c : components_) {
      if (is_over_something(c)) continue;
      const bool is_room = c.open_share <= majority &&
                           static_cast<double>(c.nodes.size()) >= least_closed_share * static_cast<double>(most);
      if (most > 0 && !is_room) c.verdict = Verdict::smaller;
      most = std::max(most, c.nodes.size());
    }
  }

  const Survey& survey_;
  const ways::Measure& measure_;
  const ways::WidestTree& tree_;
  std::vector<Component>& components_;
  bool trusted_ = false;
  std::vector<std::size_t> seen_;     ///< flying: triangles seen, of each component
  std::vector<std::size_t> details_;  ///< of each component; empty until needed
  double closed_sees_ = 0.0;          ///< the most that a closed component sees
  Columns columns_{column};
};

}  // namespace

bool is_scrap(const Component& component) { return component.nodes.size() < least_places; }

bool windings_can_be_trusted(const Survey& survey) { return winding_share(survey) >= trusted_share; }

void judge(const Survey& survey, const ways::Measure& measure, const ways::WidestTree& tree, bool trusted,
           std::vector<Component>& components) {
  if (!components.empty()) Judge(survey, measure, tree, components).run(trusted);
}

}  // namespace roam::training
