#include "training/detour.h"

#include <deque>
#include <unordered_set>

#include "training/crossings.h"

namespace roam::training {

namespace {

/// Places examined for a way around, at most: at a spacing of 0.2 m, 800 m^2. Longer ways around do not count.
constexpr std::size_t most_places = 20'000;
/// m beside the rim: the standing place before a crossing.
constexpr double before_rim = 0.3;

}  // namespace

std::optional<Ends> must_be_crossed(const Survey& survey, const Layout& layout, const ReachedFloor& reached,
                                    const Crack& crack) {
  const Vec3 aside = (crack.radius + before_rim) * crack.direction;
  const Ends ends{reached.near(crack.point - aside), reached.near(crack.point + aside)};
  if (ends.from == ways::no_node || ends.to == ways::no_node || ends.from == ends.to) return std::nullopt;
  if (layout.tree.root(ends.from) != layout.tree.root(ends.to)) return std::nullopt;
  const auto stands = [&](ways::NodeId id) { return stands_on_floor(survey, layout.tree.node(id).place); };
  if (!stands(ends.from) || !stands(ends.to)) return std::nullopt;
  std::deque<ways::NodeId> next{ends.from};
  std::unordered_set<ways::NodeId> seen{ends.from};
  while (!next.empty() && seen.size() < most_places) {
    const ways::NodeId id = next.front();
    next.pop_front();
    for (const ways::NodeId other : layout.tree.neighbours(id)) {
      if (other == ends.to) return std::nullopt;
      if (seen.insert(other).second && stands(other)) next.push_back(other);
    }
  }
  return ends;
}

}  // namespace roam::training
