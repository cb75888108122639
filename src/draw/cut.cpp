#include "draw/cut.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <mutex>
#include <utility>

#include "draw/lines.h"

namespace roam::draw {
namespace {

/// Triangles that one task cuts.
constexpr std::size_t task_triangles = 1 << 13;

bool before(const Vec3& a, const Vec3& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

/// The points where `side` changes its sign along the triangle's border: two, or none.
bool crossings(const TurnedTriangle& t, const std::array<double, 3>& side, std::array<Vec3, 2>& points) {
  std::size_t found = 0;
  for (std::size_t k = 0; k < 3 && found < 2; ++k) {
    std::size_t i = k, j = (k + 1) % 3;
    if ((side[i] < 0.0) == (side[j] < 0.0)) continue;
    if (before(t[j], t[i])) std::swap(i, j);  // same order as in the triangle on the edge's other side
    points[found++] = t[i] + side[i] / (side[i] - side[j]) * (t[j] - t[i]);
  }
  return found == 2;
}

/// Boxes that only touch count too: the box of a stretch along an axis is flat.
bool meet(const Rect& a, const Rect& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y;
}

/// The stretches in a tree of boxes over their indices: most triangles are far from all of them.
class StretchTree {
 public:
  explicit StretchTree(std::span<const Stretch> stretches) : stretches_(stretches) {
    if (!stretches.empty()) build(0, stretches.size());
  }

  template <class Visit>
  void near(const Rect& box, const Visit& visit) const {
    if (!nodes_.empty()) descend(0, 0, stretches_.size(), box, visit);
  }

 private:
  struct Node {
    Rect box;
    std::size_t second = 0;  ///< its second child; the first follows it
  };
  static constexpr std::size_t leaf = 4;

  void build(std::size_t from, std::size_t to) {
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    for (std::size_t i = from; i < to; ++i) {
      nodes_[self].box.include(stretches_[i].from);
      nodes_[self].box.include(stretches_[i].to);
    }
    nodes_[self].box = nodes_[self].box.with_border();
    if (to - from <= leaf) return;
    const std::size_t middle = (from + to) / 2;
    build(from, middle);
    nodes_[self].second = nodes_.size();
    build(middle, to);
  }

  template <class Visit>
  void descend(std::size_t node, std::size_t from, std::size_t to, const Rect& box, const Visit& visit) const {
    if (!meet(nodes_[node].box, box)) return;
    if (to - from <= leaf) {
      for (std::size_t i = from; i < to; ++i) visit(stretches_[i]);
      return;
    }
    const std::size_t middle = (from + to) / 2;
    descend(node + 1, from, middle, box, visit);
    descend(nodes_[node].second, middle, to, box, visit);
  }

  std::span<const Stretch> stretches_;
  std::vector<Node> nodes_;
};

/// The absolute z of the unit normal: 1 for level ground, 0 for a wall and for a degenerate triangle.
double levelness(const TurnedTriangle& t) {
  const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double length = glm::length(normal);
  return length > 0.0 ? std::abs(normal.z) / length : 0.0;
}

void cut_plan(const TurnedTriangle& t, double lowest, double highest, const PlanView& view, PlanCut& out) {
  const auto levels_in = [&](double shift, const auto& take) {
    auto level = std::lower_bound(view.cuts.begin(), view.cuts.end(), lowest + shift);
    for (; level != view.cuts.end() && *level <= highest + shift; ++level) {
      const auto segment = cut_level(t, *level - shift);
      if (segment) take(*segment, static_cast<std::uint16_t>(level - view.cuts.begin()));
    }
  };
  const bool is_ground = levelness(t) > view.ground;
  levels_in(0.0, [&](const Segment& segment, std::uint16_t level) {
    view.map.pieces(segment, [&](const Segment& piece, const LevelMap::Cell& cell) {
      if (cell.upper == level) (is_ground ? out.below : out.walls).push_back(piece);
      if (cell.lower == level) out.below.push_back(piece);
    });
  });
  if (is_ground) return;
  for (const double depth : view.below) {
    levels_in(depth, [&](const Segment& segment, std::uint16_t level) {
      view.map.pieces(segment, [&](const Segment& piece, const LevelMap::Cell& cell) {
        if (cell.upper == level) out.below.push_back(piece);
      });
    });
  }
}

void cut_section(const TurnedTriangle& t, const Stretch& stretch, std::vector<Segment>& out) {
  const Point way = stretch.to - stretch.from;
  const double length = glm::length(way);
  const Point direction = way / length;
  std::array<double, 3> side{};
  for (std::size_t k = 0; k < 3; ++k) {
    side[k] = direction.x * (t[k].y - stretch.from.y) - direction.y * (t[k].x - stretch.from.x);
  }
  std::array<Vec3, 2> p;
  if (!crossings(t, side, p)) return;
  const auto unrolled = [&](const Vec3& q) {
    return Point(stretch.along + direction.x * (q.x - stretch.from.x) + direction.y * (q.y - stretch.from.y), q.z);
  };
  Segment segment{unrolled(p[0]), unrolled(p[1])};
  const Rect part{{stretch.along, stretch.lowest}, {stretch.along + length, stretch.highest}};
  if (clip(segment, part)) out.push_back(segment);
}

}  // namespace

std::optional<Segment> cut_level(const TurnedTriangle& triangle, double height) {
  std::array<Vec3, 2> p;
  if (!crossings(triangle, {triangle[0].z - height, triangle[1].z - height, triangle[2].z - height}, p)) {
    return std::nullopt;
  }
  return Segment{{p[0].x, p[0].y}, {p[1].x, p[1].y}};
}

std::vector<Stretch> stretches(const Way& way, const Turn& turn, double beyond, double lowest, double highest) {
  std::vector<Stretch> result;
  for (std::size_t i = 0; i + 1 < way.points.size(); ++i) {
    const WayPoint &a = way.points[i], &b = way.points[i + 1];
    if (!b.jump && b.along > a.along) {
      result.push_back({turn.plan(a.position), turn.plan(b.position), a.along, lowest, highest});
    }
  }
  if (result.empty()) {
    // The body never left its place: cut across the plan, from left to right.
    const Point at = turn.plan(way.points.front().position);
    return {{at - Point(beyond, 0.0), at + Point(beyond, 0.0), -beyond, lowest, highest}};
  }
  const auto direction = [](const Stretch& s) { return (s.to - s.from) / glm::distance(s.to, s.from); };
  const Stretch first = result.front(), last = result.back();
  const Point back = first.from - beyond * direction(first), ahead = last.to + beyond * direction(last);
  result.insert(result.begin(), {back, first.from, first.along - beyond, lowest, highest});
  result.push_back({last.to, ahead, last.along + glm::distance(last.from, last.to), lowest, highest});
  return result;
}

struct Cutter::State {
  Turn turn;
  std::span<const PlanView> views;
  std::span<const Stretch> section;
  std::span<const Frame> frames;
  StretchTree tree;
  std::uint64_t done = 0;
  std::vector<Rect> areas;                 ///< of each view, with border
  std::vector<ThinSegments> walls, below;  ///< of each view
  std::vector<ThinSegments> sections;      ///< of each frame
};

Cutter::Cutter(const Turn& turn, std::span<const PlanView> views, std::span<const Stretch> section,
               std::span<const Frame> frames, std::size_t most) {
  state_ = std::make_unique<State>(State{turn, views, section, frames, StretchTree(section), 0, {}, {}, {}, {}});
  for (const PlanView& view : views) {
    state_->areas.push_back(view.map.area().with_border());
    state_->walls.emplace_back(Frame{view.map.area()}, most);
    state_->below.emplace_back(Frame{view.map.area()}, most);
  }
  for (const Frame& frame : frames) state_->sections.emplace_back(frame, most);
}

Cutter::~Cutter() = default;

Box Cutter::box() const {
  const State& s = *state_;
  Box box;
  const auto include = [&](const Rect& area, double lowest, double highest) {
    for (const Point& p : area.outline()) {
      const double x = s.turn.origin.x + s.turn.cosine * p.x - s.turn.sine * p.y;
      const double y = s.turn.origin.y + s.turn.sine * p.x + s.turn.cosine * p.y;
      box.include({x, y, lowest});
      box.include({x, y, highest});
    }
  };
  for (const PlanView& view : s.views) {
    if (view.cuts.empty()) continue;
    double deepest = 0.0;
    for (const double depth : view.below) deepest = std::max(deepest, depth);
    include(view.map.area(), view.cuts.front() - deepest, view.cuts.back());
  }
  for (const Stretch& stretch : s.section) {
    include({glm::min(stretch.from, stretch.to), glm::max(stretch.from, stretch.to)}, stretch.lowest, stretch.highest);
  }
  // Covers the rounding of turning back.
  constexpr double rounding = 1e-6;
  return box.empty() ? box : box.grown(rounding);
}

void Cutter::add(std::span<const Mesh> meshes, const std::function<void(std::uint64_t)>& goes_on) {
  State& s = *state_;
  struct Task {
    const Mesh* mesh;
    std::size_t from, to;
    std::vector<PlanCut> plans;
    std::vector<Segment> section;
  };
  std::vector<Task> tasks;
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); i += task_triangles) {
      tasks.push_back({&mesh, i, std::min(i + task_triangles, mesh.triangles.size()), {}, {}});
    }
  }
  std::mutex told;
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t number) {
    Task& task = tasks[number];
    task.plans.resize(s.views.size());
    for (std::size_t i = task.from; i < task.to; ++i) {
      TurnedTriangle t = task.mesh->triangle(i);
      Rect box;
      for (Vec3& corner : t) {
        corner = s.turn(corner);
        box.include({corner.x, corner.y});
      }
      const double lowest = std::min({t[0].z, t[1].z, t[2].z}), highest = std::max({t[0].z, t[1].z, t[2].z});
      for (std::size_t k = 0; k < s.views.size(); ++k) {
        if (meet(box, s.areas[k])) cut_plan(t, lowest, highest, s.views[k], task.plans[k]);
      }
      s.tree.near(box, [&](const Stretch& stretch) {
        if (lowest <= stretch.highest && highest >= stretch.lowest) cut_section(t, stretch, task.section);
      });
    }
    const std::lock_guard lock(told);
    s.done += task.to - task.from;
    goes_on(s.done);
  });
  for (Task& task : tasks) {
    for (std::size_t k = 0; k < s.views.size(); ++k) {
      s.walls[k].add(std::exchange(task.plans[k].walls, {}));
      s.below[k].add(std::exchange(task.plans[k].below, {}));
    }
    for (std::size_t k = 0; k < s.frames.size(); ++k) {
      std::vector<Segment> seen;
      std::copy_if(task.section.begin(), task.section.end(), std::back_inserter(seen),
                   [&](Segment segment) { return clip(segment, s.frames[k].view); });
      s.sections[k].add(std::move(seen));
    }
    task.section = {};
  }
}

Cuts Cutter::take() {
  Cuts all;
  for (std::size_t k = 0; k < state_->views.size(); ++k) {
    ThinSegments &walls = state_->walls[k], &below = state_->below[k];
    all.plans.push_back({walls.take(), below.take(), std::max(walls.coarsened(), below.coarsened())});
  }
  for (ThinSegments& section : state_->sections) {
    all.sections.push_back(section.take());
    all.grids.push_back(section.coarsened());
  }
  return all;
}

Cuts cut(std::span<const Mesh> meshes, const Turn& turn, std::span<const PlanView> views,
         std::span<const Stretch> section, const std::function<void(std::uint64_t)>& goes_on) {
  Frame all;
  for (const Stretch& s : section) {
    all.view.include({s.along, s.lowest});
    all.view.include({s.along + glm::distance(s.from, s.to), s.highest});
  }
  Cutter cutter(turn, views, section, {&all, 1});
  cutter.add(meshes, goes_on);
  return cutter.take();
}

}  // namespace roam::draw
