#pragma once
/// \file
/// The names of a scene's objects, as a tree, and which of them are hidden.

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace roam::app {

/// Grows while the scene arrives. A node of the tree is an object, a group of objects, or both. Thread-safe.
class SceneObjects {
 public:
  using Number = std::uint32_t;
  static constexpr std::size_t most_nodes = 100'000;  ///< further objects share one node
  enum class Hidden : std::uint8_t { none, some, all };

  /// Nodes that set_hidden() has hidden (true) or shown, by the names from the first ancestor on.
  using Decisions = std::vector<std::pair<std::vector<std::string>, bool>>;

  /// `patterns`: shell patterns. Objects whose name, or an ancestor's, matches one are hidden at first; `decisions` on
  /// the same scene, read before, go before them.
  explicit SceneObjects(std::vector<std::string> patterns = {}, const Decisions& decisions = {});

  /// The numbers of objects, by their names as in DisplayPart::objects. A new object below a node that was hidden or
  /// shown by set_hidden() is hidden or shown with it.
  [[nodiscard]] std::vector<Number> add(const std::vector<std::string>& names);
  /// Hides or shows a node with all below it. Unknown nodes are ignored.
  void set_hidden(Number node, bool hidden);
  void show_all();

  /// Which objects are hidden.
  struct Flags {
    std::uint64_t version = 0;  ///< another one after each set_hidden() and show_all()
    std::vector<bool> hidden;   ///< by number
    bool any = false;
    [[nodiscard]] bool hides(Number object) const { return object < hidden.size() && hidden[object]; }
  };
  [[nodiscard]] std::shared_ptr<const Flags> flags() const;
  [[nodiscard]] std::uint64_t version() const;
  /// The number of objects, and of the hidden ones.
  struct Count {
    std::size_t objects = 0, hidden = 0;
  };
  [[nodiscard]] Count count() const;

  /// A node for a list.
  struct Entry {
    Number node = 0;
    std::string name;  ///< as in the file
    int depth = 0;
    std::size_t objects = 0;  ///< in it, itself included
    bool is_group = false;    ///< there are others below
    bool is_open = false;
    Hidden hidden = Hidden::none;
  };
  /// The tree from its first branching on, where `open` nodes show those below. With a text to search for, all nodes
  /// with it in their names, whatever their case (ASCII).
  [[nodiscard]] std::vector<Entry> entries(const std::set<Number>& open, std::string_view search) const;
  /// Names of objects that are hidden wherever they occur: nothing that has such a name is to be seen.
  struct HiddenNames {
    std::map<std::string, std::size_t> names;  ///< and the number of objects of each
    std::size_t left_over = 0;                 ///< hidden objects with a name that something visible has, or may have
  };
  [[nodiscard]] HiddenNames hidden_names() const;
  [[nodiscard]] Decisions decisions() const;
  /// The patterns that no name has matched yet.
  [[nodiscard]] std::vector<std::string> unmatched() const;

 private:
  struct Node {
    std::string name;
    Number parent = 0;
    std::vector<Number> below;
    bool is_object = false, hidden = false;  ///< itself
    bool matches = false;                    ///< a pattern, or an ancestor does
    std::optional<bool> decided;             ///< by set_hidden
    Count count;                             ///< in it, itself included
  };
  using Key = std::pair<Number, std::string>;  ///< parent and name
  struct Before {
    using is_transparent = void;
    template <class A, class B>
    bool operator()(const A& a, const B& b) const {
      return a.first != b.first ? a.first < b.first : std::string_view(a.second) < std::string_view(b.second);
    }
  };
  Number add_one(const std::string& names);
  Number child(Number parent, std::string_view name);
  void become_object(Number node);
  void set_all(Number node, bool hidden);
  void recount(Number node, const Count& before);
  [[nodiscard]] Entry entry(Number node, int depth, const std::set<Number>& open) const;
  void list(Number node, int depth, const std::set<Number>& open, std::vector<Entry>& found) const;

  mutable std::mutex mutex_;
  std::vector<std::string> patterns_;
  std::vector<bool> matched_;
  std::vector<Node> nodes_{1};  ///< the first is the root, which has no name
  std::map<Key, Number, Before> numbers_;
  Number others_ = 0;  ///< the node that further objects share; 0: there are none
  std::uint64_t version_ = 1;
  mutable std::shared_ptr<const Flags> flags_;  ///< null: to be made
};

}  // namespace roam::app
