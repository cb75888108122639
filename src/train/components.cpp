#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <unordered_map>

#include "train/inside.h"
#include "train/places.h"
#include "train/places_columns.h"
#include "train/places_samples.h"

namespace roam::training {

namespace {

/// m: a sample is not looked at where a place so near, in this column and level, has been reached.
constexpr double reached_column = 0.3;
/// The samples that are looked at together: few at first, for most lie in what the first ones reach.
constexpr std::size_t first_batch = 16, last_batch = 4096;
/// How many more places there may be of what is not open to the sky, and of all together.
constexpr std::uint64_t closed_factor = 10;

class Search {
 public:
  Search(const Survey& survey, const Measure& measure, WidestTree& tree, std::uint64_t most_places,
         const std::function<bool(double)>& goes_on)
      : survey_(survey), measure_(measure), tree_(tree), most_places_(most_places), goes_on_(goes_on) {}

  std::vector<Component> run(const std::vector<Vec3>& samples) {
    std::size_t batch = first_batch;
    for (done_ = 0; done_ < samples.size() && asked_to_go_on(); batch = std::min(2 * batch, last_batch)) {
      const std::size_t end = std::min(samples.size(), done_ + batch);
      const std::vector<Vec3> free = free_ones({samples.data() + done_, samples.data() + end});
      share_of_one_ = 1.0 / static_cast<double>(samples.size());
      for (const Vec3& place : free) {
        begin_at(place);
        if (ended_) break;
      }
      done_ = end;
    }
    return components();
  }

 private:
  bool asked_to_go_on() {
    if (!ended_ && goes_on_ && !goes_on_(static_cast<double>(done_) * share_of_one_)) ended_ = true;
    return !ended_;
  }

  [[nodiscard]] bool is_reached(const Vec3& place) const {
    return reached_.any(place, 0, [&](const auto& e) { return std::abs(e.z - place.z) <= reached_column; });
  }

  /// Of some samples the places where a body can be and that nothing has reached.
  [[nodiscard]] std::vector<Vec3> free_ones(std::span<const Vec3> samples) const {
    std::vector<Vec3> places(samples.begin(), samples.end());
    std::vector<char> free(samples.size(), 0);
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
      if (is_reached(samples[i])) return;
      if (measure_.mode == Mode::walk) {
        const auto foot = foot_at(survey_, measure_, samples[i]);
        if (!foot || is_reached(*foot)) return;
        places[i] = *foot;
      }
      free[i] = clearance_at(survey_, measure_, places[i]) > 0.0 ? 1 : 0;
    });
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (free[i] != 0) kept.push_back(places[i]);
    return kept;
  }

  void begin_at(const Vec3& place) {
    if (is_reached(place)) return;
    const auto seed = tree_.seed(place);
    if (!seed || tree_.root(*seed) != no_node) return;
    const bool open = look_around(survey_, eye_over(measure_, tree_.node(*seed))).open;
    // What is open to the sky and was not grown whole goes on under the other open samples.
    if (open && open_was_cut_) return;
    const std::size_t before = tree_.size();
    const std::uint64_t most_of_all = most_places_ * closed_factor;
    const std::uint64_t most = std::min(open ? before + most_places_ : most_of_all, most_of_all);
    const bool whole =
        tree_.grow(*seed, no_node, [&](std::uint64_t places) { return places < most && asked_to_go_on(); });
    if (!whole && open) open_was_cut_ = true;
    if (tree_.size() >= most_of_all) ended_ = true;
    grown_.push_back({*seed, whole, whole ? 0 : places_of(*seed)});
    for (std::size_t id = before; id < tree_.size(); ++id) {
      const auto node = static_cast<NodeId>(id);
      if (tree_.root(node) != no_node) reached_.add(tree_.node(node).place, 0);
    }
    reached_.add(place, 0);
  }

  [[nodiscard]] std::size_t places_of(NodeId root) const {
    std::size_t count = 0;
    for (std::size_t id = 0; id < tree_.size(); ++id)
      if (tree_.root(static_cast<NodeId>(id)) == root) ++count;
    return count;
  }

  [[nodiscard]] std::vector<Component> components() const {
    std::vector<Component> found;
    std::unordered_map<NodeId, std::size_t> number;
    for (const Grown& grown : grown_) {
      // A tree that was cut may have been reached by a later one, which then holds some of its places.
      if (!grown.whole && places_of(grown.root) != grown.places) continue;
      number.emplace(grown.root, found.size());
      Component c;
      c.root = grown.root;
      c.whole = grown.whole;
      found.push_back(std::move(c));
    }
    for (std::size_t id = 0; id < tree_.size(); ++id) {
      const auto component = number.find(tree_.root(static_cast<NodeId>(id)));
      if (component != number.end()) found[component->second].nodes.push_back(static_cast<NodeId>(id));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Component& a, const Component& b) { return a.nodes.size() > b.nodes.size(); });
    return found;
  }

  struct Grown {
    NodeId root = no_node;
    bool whole = true;
    std::size_t places = 0;  ///< of what was cut, then
  };

  const Survey& survey_;
  const Measure& measure_;
  WidestTree& tree_;
  std::uint64_t most_places_;
  const std::function<bool(double)>& goes_on_;
  Columns reached_{reached_column};
  std::vector<Grown> grown_;
  std::size_t done_ = 0;
  double share_of_one_ = 0.0;
  bool open_was_cut_ = false;
  bool ended_ = false;
};

}  // namespace

std::vector<Component> find_components(const Survey& survey, const Measure& measure, WidestTree& tree,
                                       std::uint64_t seed, const std::function<bool(double)>& goes_on,
                                       std::uint64_t most_places) {
  std::vector<Component> found =
      Search(survey, measure, tree, most_places, goes_on).run(sample_places(survey, measure.mode, seed));
  judge(survey, measure, tree, found);
  return found;
}

}  // namespace roam::training
