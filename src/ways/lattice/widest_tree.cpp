#include <algorithm>
#include <limits>
#include <queue>

#include "math/threads.h"
#include "ways/lattice/graph.h"

namespace roam::ways {
namespace {

/// Places between two calls of `goes_on`.
constexpr std::size_t places_between_checks = 256;
/// The number of next steps that are computed ahead. Steps farther back in the heap are mostly reached from elsewhere.
constexpr std::size_t looked_ahead = 6;
/// A step out of the tree that may be taken.
struct Edge {
  float width = 0.0F;        ///< the smaller clearance of its two places
  std::uint64_t number = 0;  ///< order of discovery, among equals: ways stay short where everything is wide
  NodeId from = no_node, to = no_node;
};
struct Narrower {
  bool operator()(const Edge& a, const Edge& b) const {
    return a.width != b.width ? a.width < b.width : a.number > b.number;
  }
};

bool has_other_cores() { return available_threads() > 1; }

}  // namespace

struct WidestTree::State {
  std::unique_ptr<LatticeGraph> graph;
  std::vector<NodeId> root, parent;  ///< of each place; no_node
  std::vector<float> offered;  ///< for each place the widest of `edges` that lead to it; negative if there is none
  std::vector<NodeId> were_offered;  ///< places whose `offered` may be set
  std::vector<Edge> edges;           ///< a heap, the widest first
  bool looks_ahead = false;
  NodeId growing = no_node;  ///< the root of the tree that `edges` lead out of
  std::uint64_t pushed = 0;
  double spacing = 0.0;

  void cover() {
    root.resize(graph->size(), no_node);
    parent.resize(graph->size(), no_node);
    offered.resize(graph->size(), -1.0F);
  }
  void offer(NodeId from, NodeId to) {
    if (root[to] == growing) return;
    // Each place keeps the widest edge that leads to it, the first one among equals. The others would only wait.
    const float width = std::min(graph->node(from).clearance, graph->node(to).clearance);
    if (width <= offered[to]) return;
    if (offered[to] < 0.0F) were_offered.push_back(to);
    offered[to] = width;
    edges.push_back({width, pushed++, from, to});
    std::push_heap(edges.begin(), edges.end(), Narrower{});
  }
  Edge pop_widest() {
    std::pop_heap(edges.begin(), edges.end(), Narrower{});
    const Edge edge = edges.back();
    edges.pop_back();
    return edge;
  }
  /// The first elements of the heap come next or soon.
  void look_ahead() {
    for (std::size_t i = 0; i < std::min(looked_ahead, edges.size()); ++i)
      if (root[edges[i].to] != growing) graph->look_ahead(edges[i].to);
  }
  /// After a failed step to a place: offers all other steps to it.
  void offer_again(NodeId to) {
    offered[to] = -1.0F;
    for (const NodeId from : graph->neighbours(to))
      if (root[from] == growing) offer(from, to);
  }
  void push(NodeId from, const Neighbours& neighbours) {
    cover();
    for (const NodeId to : neighbours) offer(from, to);
  }
  void take(NodeId id, NodeId from) {
    root[id] = growing;
    parent[id] = from;
    push(id, graph->expand(id));
  }
  void forget_edges() {
    edges.clear();
    for (const NodeId id : were_offered) offered[id] = -1.0F;
    were_offered.clear();
  }
  /// Makes `edges` the outward edges of the tree of `id`, or starts a new tree there. Returning to a tree grows it
  /// again from its root over known places: another tree may have taken places out of its middle. When those are taken
  /// back, places below them would otherwise become their own ancestors.
  void turn_to(NodeId id) {
    cover();
    if (root[id] != no_node && root[id] == growing) return;
    forget_edges();
    const bool is_new = root[id] == no_node;
    growing = is_new ? id : root[id];
    if (!is_new) {
      for (NodeId n = 0; n < static_cast<NodeId>(root.size()); ++n)
        if (root[n] == growing) root[n] = parent[n] = no_node;
    }
    take(growing, no_node);
  }
};

WidestTree::WidestTree(const Survey& survey, const Measure& measure, double spacing, const Box& within,
                       const AheadLimits& ahead)
    : state_(std::make_shared<State>()) {
  state_->spacing = spacing;
  state_->graph = measure.mode == Mode::fly ? fly_lattice(survey, measure, spacing, within)
                                            : walk_lattice(survey, measure, spacing, within, ahead);
}

std::optional<NodeId> WidestTree::seed(const Vec3& place) {
  const auto id = state_->graph->seed(place);
  state_->cover();
  return id;
}

bool WidestTree::grow(NodeId root, NodeId until, const std::function<bool(std::uint64_t)>& goes_on) {
  State& s = *state_;
  // If everything in reach is taken, every offered step will be used.
  s.looks_ahead = until == no_node && has_other_cores();
  s.graph->let_look_ahead(s.looks_ahead);
  s.turn_to(root);
  for (std::size_t taken = 0; !s.edges.empty(); ++taken) {
    if (until != no_node && s.root[until] == s.growing) return true;
    if (goes_on && taken % places_between_checks == 0 && !goes_on(s.graph->size())) return false;
    const Edge edge = s.pop_widest();
    if (s.root[edge.to] == s.growing) continue;
    if (s.looks_ahead) s.look_ahead();
    if (s.graph->confirm_step(edge.from, edge.to)) {
      s.take(edge.to, edge.from);
    } else {
      s.offer_again(edge.to);
    }
  }
  return true;
}

void WidestTree::join(NodeId root, const std::vector<bool>& among) {
  State& s = *state_;
  s.forget_edges();
  s.growing = no_node;
  std::priority_queue<Edge, std::vector<Edge>, Narrower> edges;
  std::vector<bool> joined(s.root.size(), false);
  std::uint64_t pushed = 0;
  const auto take = [&](NodeId id, NodeId from) {
    joined[id] = true;
    s.root[id] = root;
    s.parent[id] = from;
    for (const NodeId to : s.graph->neighbours(id)) {
      if (among[to] && !joined[to])
        edges.push({std::min(s.graph->node(id).clearance, s.graph->node(to).clearance), pushed++, id, to});
    }
  };
  take(root, no_node);
  while (!edges.empty()) {
    const Edge edge = edges.top();
    edges.pop();
    if (!joined[edge.to] && s.graph->confirm_step(edge.from, edge.to)) take(edge.to, edge.from);
  }
}

std::vector<NodeId> WidestTree::over_steps_down(const std::vector<bool>& among) const {
  const State& s = *state_;
  std::vector<NodeId> found;
  for (NodeId id = 0; id < static_cast<NodeId>(s.root.size()); ++id) {
    if (s.root[id] == no_node || !among[id]) continue;
    const NodeId below = s.graph->floor_under_gap(id);
    if (below != no_node && s.root[below] == s.root[id]) found.push_back(id);
  }
  return found;
}

void WidestTree::close(std::span<const NodeId> places) {
  State& s = *state_;
  s.forget_edges();
  s.growing = no_node;
  std::vector<bool> cut(s.root.size(), false);
  for (const NodeId id : places) {
    if (s.root[id] != no_node) cut[s.root[id]] = true;
    s.graph->close(id);
  }
  for (NodeId id = 0; id < static_cast<NodeId>(s.root.size()); ++id)
    if (s.root[id] != no_node && cut[s.root[id]]) s.root[id] = s.parent[id] = no_node;
}

double WidestTree::spacing() const { return state_->spacing; }
std::size_t WidestTree::size() const { return state_->graph->size(); }
bool WidestTree::is_cut() const { return state_->graph->is_cut(); }

std::uint64_t WidestTree::computed_ahead() const { return state_->graph->computed_ahead(); }
const Node& WidestTree::node(NodeId id) const { return state_->graph->node(id); }
NodeId WidestTree::root(NodeId id) const { return state_->root[id]; }
NodeId WidestTree::parent(NodeId id) const { return state_->parent[id]; }
Neighbours WidestTree::neighbours(NodeId id) const { return state_->graph->neighbours(id); }

std::vector<NodeId> WidestTree::way_round(NodeId from, NodeId to, const std::function<bool(const Node&)>& blocked,
                                          double least, const std::function<bool(std::uint64_t)>& goes_on) {
  LatticeGraph& graph = *state_->graph;
  graph.let_look_ahead(false);
  std::priority_queue<Edge, std::vector<Edge>, Narrower> edges;
  std::vector<NodeId> before(graph.size(), no_node);
  std::vector<float> offered(graph.size(), -1.0F);  // as State::offered; infinite for blocked places
  std::uint64_t pushed = 0, taken = 0;
  const auto offer = [&](NodeId at, NodeId next) {
    const float width = std::min(graph.node(at).clearance, graph.node(next).clearance);
    if (before[next] != no_node || width <= least || width <= offered[next]) return;
    const bool is_blocked = offered[next] < 0.0F && blocked(graph.node(next));
    offered[next] = is_blocked ? std::numeric_limits<float>::infinity() : width;
    if (!is_blocked) edges.push({width, pushed++, at, next});
  };
  const auto may_be_taken = [&](const Edge& edge) {
    if (before[edge.to] != no_node) return false;
    if (graph.confirm_step(edge.from, edge.to)) return true;
    offered[edge.to] = -1.0F;
    for (const NodeId other : graph.neighbours(edge.to))
      if (before[other] != no_node) offer(other, edge.to);
    return false;
  };
  before[from] = from;
  for (NodeId at = from; at != to;) {
    const Neighbours neighbours = graph.expand(at);
    before.resize(graph.size(), no_node);
    offered.resize(graph.size(), -1.0F);
    for (const NodeId next : neighbours) offer(at, next);
    Edge edge;
    do {
      if (edges.empty()) return {};
      edge = edges.top();
      edges.pop();
    } while (!may_be_taken(edge));
    if (goes_on && taken++ % places_between_checks == 0 && !goes_on(graph.size())) return {};
    before[edge.to] = edge.from;
    at = edge.to;
  }
  state_->cover();
  std::vector<NodeId> way{to};
  while (way.back() != from) way.push_back(before[way.back()]);
  std::reverse(way.begin(), way.end());
  return way;
}

std::vector<NodeId> WidestTree::way(NodeId from, NodeId to) const {
  const State& s = *state_;
  if (s.root[from] == no_node || s.root[from] != s.root[to]) return {};
  const auto upwards = [&](NodeId id) {
    std::vector<NodeId> line;
    for (; id != no_node; id = s.parent[id]) line.push_back(id);
    return line;
  };
  std::vector<NodeId> out = upwards(from), back = upwards(to);
  NodeId meeting = no_node;
  while (!out.empty() && !back.empty() && out.back() == back.back()) {
    meeting = out.back();
    out.pop_back();
    back.pop_back();
  }
  if (meeting == no_node) return {};
  out.push_back(meeting);
  out.insert(out.end(), back.rbegin(), back.rend());
  return out;
}

}  // namespace roam::ways
