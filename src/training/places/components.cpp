#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <iterator>
#include <span>
#include <unordered_map>

#include "training/places/columns.h"
#include "training/places/inside.h"
#include "training/places/places.h"
#include "training/places/samples.h"

namespace roam::training {

namespace {

/// m: a sample is skipped if a place this near, in its column and in height, has been reached.
constexpr double reached_column = 0.3;
/// Samples per batch: few at first, because the first ones reach most of the others.
constexpr std::size_t first_batch = 16, last_batch = 4096;
/// Share of the progress for examining samples. Large components found that way are grown afterwards.
constexpr double samples_share = 0.5;
/// Limit of the places of all components, as a multiple of the limit for one.
constexpr std::uint64_t all_factor = 2;
/// Places in the first look at a closed component, so that a huge one does not use up the budget.
constexpr std::uint64_t first_look = 30'000;
/// Open ground may always have this many places.
constexpr std::uint64_t least_open = 200'000;
/// Closed components with fewer places in total do not limit open ground: in an open scene they only lie under
/// something.
constexpr std::uint64_t least_closed = 1'000;
/// A component that began closed is open ground if most of its newest places see the sky in two checks running. The
/// first check is after `first_check` places, the next ones each time it has grown by `check_growth`.
constexpr std::size_t newest = 16;
constexpr std::uint64_t first_check = 512;
constexpr double check_growth = 1.25;
/// A look at a closed component ends after this many calls of its callback without a new place, plus one call for each
/// `places_a_turn` new places. Usually a call brings four times as many. The look has then met a tree of an earlier
/// look. If a look was cut, the first number is 0, because the large component is grown later anyway.
constexpr std::uint64_t most_turns = 16, places_a_turn = 64;

/// Surroundings of a sample, in the order in which components are grown. Closed ones come first: they are soon
/// complete, while open ones may extend for kilometres. Samples that see backs come last, and often need not be grown.
enum class Sight : std::uint8_t { closed, open, backs };

class Search {
 public:
  Search(const Survey& survey, const ways::Measure& measure, ways::WidestTree& tree, bool trusted,
         std::uint64_t most_places, const std::function<bool(double)>& goes_on)
      : survey_(survey),
        measure_(measure),
        tree_(tree),
        trusted_(trusted),
        most_places_(most_places),
        goes_on_(goes_on) {}

  std::vector<Component> run(const std::vector<Vec3>& samples) {
    if (measure_.mode == Mode::walk)
      most_expected_ = std::min(cells_of_floors(), static_cast<double>(most_places_ * all_factor));
    std::size_t batch = first_batch;
    // Without the limit on places, huge closed components would be begun again and again until nothing is left for the
    // rest.
    while (done_ < samples.size() && tree_.size() < most_places_ && may_go_on()) {
      const std::size_t end = std::min(samples.size(), done_ + batch);
      for (const Start& start : starts({samples.data() + done_, samples.data() + end})) {
        if (start.sight == Sight::closed)
          grow_from(start);
        else
          (start.sight == Sight::open ? open_ : backs_).push_back(start);
        if (ended_ || tree_.size() >= most_places_) break;
      }
      done_ = end;
      share_done_ = samples_share * static_cast<double>(done_) / static_cast<double>(samples.size());
      batch = std::min(2 * batch, last_batch);
    }
    // Grow large components on in the order of discovery, which puts detailed parts of the scene first. Then those that
    // came out into the open. They take over all trees that they meet; components() joins the remains.
    std::size_t grown = 0;
    const auto one_more = [&] {
      const std::size_t all = large_.size() + came_out_.size() + open_.size() + backs_.size();
      const double share = static_cast<double>(++grown) / static_cast<double>(all);
      share_done_ = std::max(share_done_, samples_share + (1.0 - samples_share) * share);
    };
    for (const ways::NodeId root : large_) {
      if (!ended_ && tree_.root(root) == root) grow(root, Sight::closed, most_places_);
      one_more();
    }
    for (const ways::NodeId root : came_out_) {
      if (!ended_ && !open_was_cut_ && tree_.root(root) == root) grow(root, Sight::open, most_open());
      one_more();
    }
    const auto grow_all_from = [&](const std::vector<Start>& waiting) {
      for (const Start& start : waiting) {
        if (!ended_) grow_from(start);
        one_more();
      }
    };
    grow_all_from(open_);
    if (backs_may_be_the_scene()) grow_all_from(backs_);
    return components();
  }

 private:
  /// A place with room for the body that no tree has reached.
  struct Start {
    Vec3 place{0.0};
    Sight sight = Sight::closed;
    bool open = false;
    bool free = false;
  };

  bool may_go_on() {
    if (!ended_ && goes_on_ && !goes_on_(std::max(share_done_, share_reached()))) ended_ = true;
    return !ended_;
  }

  /// Progress as estimated from the places so far. At most one place is expected for each cell of the floors.
  [[nodiscard]] double share_reached() const {
    if (!(most_expected_ > 0.0)) return 0.0;
    return samples_share * std::min(1.0, static_cast<double>(tree_.size()) / most_expected_);
  }

  [[nodiscard]] bool is_reached(const Vec3& place) const {
    return reached_.any(place, 0, [&](const auto& e) { return std::abs(e.z - place.z) <= reached_column; });
  }

  [[nodiscard]] Start start_at(const Vec3& sample) const {
    Start start{.place = sample};
    if (is_reached(sample)) return start;
    if (measure_.mode == Mode::walk) {
      const auto foot = foot_at(survey_, measure_, sample);
      if (!foot || is_reached(*foot)) return start;
      start.place = *foot;
    }
    const double clearance = clearance_at(survey_, measure_, start.place);
    if (!(clearance > 0.0)) return start;
    start.free = true;
    const Surroundings seen = look_around(survey_, eye_over(measure_, {start.place, static_cast<float>(clearance)}));
    start.open = seen.open;
    start.sight = trusted_ && seen.backs ? Sight::backs : seen.open ? Sight::open : Sight::closed;
    return start;
  }

  [[nodiscard]] std::vector<Start> starts(std::span<const Vec3> samples) const {
    std::vector<Start> all(samples.size());
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) { all[i] = start_at(samples[i]); });
    all.erase(std::remove_if(all.begin(), all.end(), [](const Start& start) { return !start.free; }), all.end());
    return all;
  }

  void grow_from(const Start& start) {
    if (is_reached(start.place)) return;
    // If open ground was cut short, the other open samples lie on its rest.
    if (start.open && open_was_cut_) return;
    const auto seed = tree_.seed(start.place);
    if (!seed || tree_.root(*seed) != ways::no_node) return;
    const Sight sight = start.open ? Sight::open : start.sight;
    grow(*seed, sight, sight == Sight::open ? most_open() : sight == Sight::closed ? first_look : most_places_);
  }

  /// Adds at most `most_new` places.
  void grow(ways::NodeId root, Sight sight, std::uint64_t most_new) {
    const std::size_t before = tree_.size();
    const std::uint64_t most_of_all = most_places_ * all_factor;
    const std::uint64_t most = std::min(before + std::min(most_new, most_places_), most_of_all);
    const bool is_look = sight == Sight::closed && most_new == first_look;
    const std::uint64_t idle_turns = look_was_cut_ ? 0 : most_turns;
    std::uint64_t mark = before + first_check, turns = 0;
    int open_running = 0;
    bool out = false;
    const bool whole = tree_.grow(root, ways::no_node, [&](std::uint64_t places) {
      if (sight == Sight::closed && places >= mark) {
        mark = before + static_cast<std::uint64_t>(check_growth * static_cast<double>(places - before));
        open_running = newest_are_open(root) ? open_running + 1 : 0;
      }
      out = open_running == 2;
      // A look that adds no places has met a tree that was examined before.
      const bool is_idle = is_look && turns++ > idle_turns + (places - before) / places_a_turn;
      return !out && !is_idle && places < most && may_go_on();
    });
    if (tree_.size() >= most_of_all) ended_ = true;
    if (out) came_out_.push_back(root);
    if (!whole && sight == Sight::open) open_was_cut_ = true;
    if (!whole && !out && is_look && !ended_) large_.push_back(root);
    if (is_look && tree_.size() >= most) look_was_cut_ = true;
    if (whole) whole_.push_back(root);
    note_reached();
    if (whole && sight == Sight::closed) closed_places_ += places_of(root);
  }

  /// Notes the places reached since the last call, whether new or seen earlier.
  void note_reached() {
    for (std::size_t id = was_reached_.size(); id < tree_.size(); ++id) seen_.push_back(static_cast<ways::NodeId>(id));
    was_reached_.resize(tree_.size(), false);
    std::erase_if(seen_, [&](ways::NodeId id) {
      if (tree_.root(id) == ways::no_node) return false;
      was_reached_[id] = true;
      reached_.add(tree_.node(id).place, 0);
      return true;
    });
  }

  [[nodiscard]] std::uint64_t places_of(ways::NodeId root) const {
    std::uint64_t places = 0;
    for (std::size_t id = 0; id < tree_.size(); ++id)
      if (tree_.root(static_cast<ways::NodeId>(id)) == root) ++places;
    return places;
  }

  [[nodiscard]] bool newest_are_open(ways::NodeId root) const {
    std::vector<ways::NodeId> examined;
    for (std::size_t id = tree_.size(); id > 0 && examined.size() < newest; --id)
      if (const auto node = static_cast<ways::NodeId>(id - 1); tree_.root(node) == root) examined.push_back(node);
    std::atomic<std::size_t> open{0};
    tbb::parallel_for(std::size_t{0}, examined.size(), [&](std::size_t i) {
      if (look_around(survey_, eye_over(measure_, tree_.node(examined[i]))).open) ++open;
    });
    return 2 * open > examined.size();
  }

  /// The limit for open ground: not more places than the closed components have.
  [[nodiscard]] std::uint64_t most_open() const {
    if (closed_places_ < least_closed || most_places_ <= least_open) return most_places_;
    return std::clamp(closed_places_, least_open, most_places_);
  }

  /// Windings may be reversed; then the samples that see backs are the scene. Not if closed components that see fronts
  /// cover a good part of all floors: see judge().
  [[nodiscard]] bool backs_may_be_the_scene() const {
    if (closed_places_ == 0) return true;
    const auto closed = static_cast<double>(closed_places_);
    return closed * reversed_ratio < cells_of_floors() - closed;
  }

  /// The number of lattice cells that all floors cover, seen from above.
  [[nodiscard]] double cells_of_floors() const {
    double area = 0.0;
    for (const TriangleId id : survey_.floor_triangles()) {
      const Triangle t = survey_.triangle(id);
      area += 0.5 * std::abs(glm::cross(t[1] - t[0], t[2] - t[0]).z);
    }
    return area / (tree_.spacing() * tree_.spacing());
  }

  /// Closes places over gaps whose bottom is reached on foot: no body is carried over those, so parts connected only by
  /// them separate. Returns, by id, which places belonged to a whole tree before, if their tree was taken apart.
  [[nodiscard]] std::vector<bool> close_steps_down() {
    std::vector<bool> was_whole(tree_.size(), false);
    const std::vector<ways::NodeId> closed = tree_.over_steps_down(was_reached_);
    if (closed.empty()) return was_whole;
    for (std::size_t id = 0; id < tree_.size(); ++id) {
      const ways::NodeId root = tree_.root(static_cast<ways::NodeId>(id));
      was_whole[id] = std::find(whole_.begin(), whole_.end(), root) != whole_.end();
    }
    tree_.close(closed);
    for (const ways::NodeId id : closed) was_reached_[id] = false;
    return was_whole;
  }

  /// The components of all reached places.
  [[nodiscard]] std::vector<Component> components() {
    std::vector<Component> found;
    std::unordered_map<ways::NodeId, std::size_t> number;
    const auto add = [&](ways::NodeId root, bool whole) {
      number.emplace(root, found.size());
      Component c;
      c.root = root;
      c.whole = whole;
      found.push_back(std::move(c));
    };
    note_reached();
    const std::vector<bool> was_whole = close_steps_down();
    for (const ways::NodeId root : whole_)
      if (tree_.root(root) == root) add(root, true);
    // A tree that was cut may have lost places from its middle to another one.
    for (std::size_t id = 0; id < tree_.size(); ++id) {
      const auto node = static_cast<ways::NodeId>(id);
      if (!was_reached_[id] || number.contains(tree_.root(node))) continue;
      tree_.join(node, was_reached_);
      add(node, was_whole[id]);
    }
    for (std::size_t id = 0; id < tree_.size(); ++id) {
      if (was_reached_[id])
        found[number.at(tree_.root(static_cast<ways::NodeId>(id)))].nodes.push_back(static_cast<ways::NodeId>(id));
    }
    mark_unfinished(found);
    std::stable_sort(found.begin(), found.end(),
                     [](const Component& a, const Component& b) { return a.nodes.size() > b.nodes.size(); });
    return found;
  }

  /// Marks components that were not grown whole as unfinished if a whole one has more of the floors' triangles.
  /// Example: the ground under a dam, beside its gallery.
  void mark_unfinished(std::vector<Component>& found) const {
    const auto is_whole = [](const Component& c) { return c.whole; };
    if (std::all_of(found.begin(), found.end(), is_whole) || std::none_of(found.begin(), found.end(), is_whole)) return;
    const std::vector<std::size_t> details = floor_details(survey_, tree_, found);
    std::size_t most = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i].whole) most = std::max(most, details[i]);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (!found[i].whole && details[i] < most) found[i].verdict = Verdict::unfinished;
  }

  const Survey& survey_;
  const ways::Measure& measure_;
  ways::WidestTree& tree_;
  bool trusted_;
  std::uint64_t most_places_;
  const std::function<bool(double)>& goes_on_;
  Columns reached_{reached_column};
  std::vector<bool> was_reached_;       ///< by id: in any tree
  std::vector<ways::NodeId> seen_;      ///< not reached yet, ascending
  std::vector<ways::NodeId> whole_;     ///< roots of trees that cannot grow further
  std::vector<Start> open_, backs_;     ///< samples that are grown later
  std::vector<ways::NodeId> large_;     ///< roots of closed components that were begun, not grown whole
  std::vector<ways::NodeId> came_out_;  ///< roots of components that began closed and continue in the open
  std::uint64_t closed_places_ = 0;     ///< reached from closed samples
  std::size_t done_ = 0;
  double share_done_ = 0.0;     ///< of all the work
  double most_expected_ = 0.0;  ///< places; 0: not known
  bool open_was_cut_ = false;
  bool look_was_cut_ = false;  ///< a closed component is larger than a first look
  bool ended_ = false;
};

}  // namespace

std::vector<Component> find_components(const Survey& survey, const ways::Measure& measure, ways::WidestTree& tree,
                                       std::uint64_t seed, const std::function<bool(double)>& goes_on,
                                       std::uint64_t most_places) {
  bool trusted = false;
  std::vector<Vec3> samples;
  tbb::parallel_invoke([&] { trusted = windings_can_be_trusted(survey); },
                       [&] { samples = sample_places(survey, measure.mode, seed); });
  std::vector<Component> found = Search(survey, measure, tree, trusted, most_places, goes_on).run(samples);
  // Unfinished components take no part in the judgement: they may be larger than all the rest.
  const auto unfinished = std::stable_partition(found.begin(), found.end(),
                                                [](const Component& c) { return c.verdict != Verdict::unfinished; });
  std::vector<Component> rest(std::make_move_iterator(unfinished), std::make_move_iterator(found.end()));
  found.erase(unfinished, found.end());
  judge(survey, measure, tree, trusted, found);
  for (Component& c : rest) {
    c.inside = false;
    found.push_back(std::move(c));
  }
  return found;
}

}  // namespace roam::training
