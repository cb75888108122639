#include "view/scene_objects.h"

#include <fnmatch.h>

#include <algorithm>
#include <utility>

#include "import/display_part.h"

namespace roam::app {
namespace {

constexpr const char* others_name = "further objects";

char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool contains(std::string_view text, std::string_view part) {
  return std::search(text.begin(), text.end(), part.begin(), part.end(),
                     [](char a, char b) { return lower_case(a) == lower_case(b); }) != text.end();
}

}  // namespace

SceneObjects::SceneObjects(std::vector<std::string> patterns, const Decisions& decisions)
    : patterns_(std::move(patterns)), matched_(patterns_.size(), false) {
  for (const auto& [names, hidden] : decisions) {
    Number at = 0;
    for (const std::string& name : names) at = child(at, name);
    nodes_[at].decided = hidden;
  }
}

std::vector<SceneObjects::Number> SceneObjects::add(const std::vector<std::string>& names) {
  const std::lock_guard lock(mutex_);
  std::vector<Number> numbers;
  numbers.reserve(names.size());
  for (const std::string& name : names) numbers.push_back(add_one(name));
  return numbers;
}

SceneObjects::Number SceneObjects::add_one(const std::string& names) {
  std::string_view rest = names;
  Number at = 0;
  while (true) {
    const std::size_t end = std::min(rest.find(DisplayPart::name_separator), rest.size());
    const Number next = child(at, rest.substr(0, end));
    if (next == 0) {
      at = others_ = child(0, others_name);
      break;
    }
    at = next;
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
  }
  if (!nodes_[at].is_object) become_object(at);
  return at;
}

/// The node of that name below `parent`; 0 if there are too many.
SceneObjects::Number SceneObjects::child(Number parent, std::string_view name) {
  const auto at = numbers_.find(std::pair<Number, std::string_view>(parent, name));
  if (at != numbers_.end()) return at->second;
  if (nodes_.size() >= most_nodes && name != others_name) return 0;
  const auto number = static_cast<Number>(nodes_.size());
  Node node;
  node.name = name;
  node.parent = parent;
  node.matches = nodes_[parent].matches;
  for (std::size_t i = 0; i < patterns_.size(); ++i) {
    if (fnmatch(patterns_[i].c_str(), node.name.c_str(), 0) != 0) continue;
    node.matches = true;
    matched_[i] = true;
  }
  nodes_.push_back(std::move(node));
  nodes_[parent].below.push_back(number);
  numbers_.emplace(std::pair(parent, std::string(name)), number);
  return number;
}

void SceneObjects::become_object(Number number) {
  Node& node = nodes_[number];
  node.is_object = true;
  Number deciding = number;
  while (deciding != 0 && !nodes_[deciding].decided) deciding = nodes_[deciding].parent;
  node.hidden = nodes_[deciding].decided.value_or(node.matches);
  for (Number at = number;; at = nodes_[at].parent) {
    ++nodes_[at].count.objects;
    if (node.hidden) ++nodes_[at].count.hidden;
    if (at == 0) break;
  }
  flags_.reset();
}

void SceneObjects::set_hidden(Number node, bool hidden) {
  const std::lock_guard lock(mutex_);
  if (node >= nodes_.size()) return;
  const Count before = nodes_[node].count;
  set_all(node, hidden);
  nodes_[node].decided = hidden;
  recount(node, before);
  ++version_;
  flags_.reset();
}

void SceneObjects::show_all() { set_hidden(0, false); }

/// Sets a node and all below it.
void SceneObjects::set_all(Number number, bool hidden) {
  // Trees from files may be too deep for recursion.
  std::vector<Number> waiting{number};
  while (!waiting.empty()) {
    Node& node = nodes_[waiting.back()];
    waiting.pop_back();
    node.decided.reset();
    if (node.is_object) node.hidden = hidden;
    node.count.hidden = hidden ? node.count.objects : 0;
    waiting.insert(waiting.end(), node.below.begin(), node.below.end());
  }
}

/// Corrects the counts above a node.
void SceneObjects::recount(Number number, const Count& before) {
  const std::size_t now = nodes_[number].count.hidden;
  while (number != 0) {
    number = nodes_[number].parent;
    nodes_[number].count.hidden = nodes_[number].count.hidden + now - before.hidden;
  }
}

std::shared_ptr<const SceneObjects::Flags> SceneObjects::flags() const {
  const std::lock_guard lock(mutex_);
  if (flags_) return flags_;
  auto made = std::make_shared<Flags>();
  made->version = version_;
  made->any = nodes_[0].count.hidden > 0;
  made->hidden.reserve(nodes_.size());
  for (const Node& node : nodes_) made->hidden.push_back(node.is_object && node.hidden);
  flags_ = made;
  return made;
}

std::uint64_t SceneObjects::version() const {
  const std::lock_guard lock(mutex_);
  return version_;
}

SceneObjects::Count SceneObjects::count() const {
  const std::lock_guard lock(mutex_);
  return nodes_[0].count;
}

SceneObjects::Entry SceneObjects::entry(Number number, int depth, const std::set<Number>& open) const {
  const Node& node = nodes_[number];
  const auto& [objects, hidden] = node.count;
  return {number,
          node.name,
          depth,
          objects,
          !node.below.empty(),
          open.contains(number),
          hidden == 0         ? Hidden::none
          : hidden == objects ? Hidden::all
                              : Hidden::some};
}

void SceneObjects::list(Number number, int depth, const std::set<Number>& open, std::vector<Entry>& found) const {
  constexpr int deepest = 200;
  for (const Number below : nodes_[number].below) {
    if (nodes_[below].count.objects == 0) continue;  // decided before, and not in this scene
    found.push_back(entry(below, depth, open));
    if (found.back().is_open && depth < deepest) list(below, depth + 1, open, found);
  }
}

std::vector<SceneObjects::Entry> SceneObjects::entries(const std::set<Number>& open, std::string_view search) const {
  const std::lock_guard lock(mutex_);
  std::vector<Entry> found;
  if (!search.empty()) {
    for (Number i = 1; i < nodes_.size(); ++i) {
      if (nodes_[i].count.objects == 0 || !contains(nodes_[i].name, search)) continue;
      found.push_back(entry(i, 0, {}));
      found.back().is_group = false;
    }
    return found;
  }
  Number first = 0;
  while (nodes_[first].below.size() == 1 && !nodes_[nodes_[first].below[0]].is_object) first = nodes_[first].below[0];
  list(first, 0, open, found);
  return found;
}

SceneObjects::HiddenNames SceneObjects::hidden_names() const {
  const std::lock_guard lock(mutex_);
  if (nodes_[0].count.hidden == 0) return {};
  HiddenNames hidden;
  // Objects without a node of their own may have any name.
  if (others_ != 0 && nodes_[others_].count.hidden < nodes_[others_].count.objects) {
    hidden.left_over = nodes_[0].count.hidden;
    return hidden;
  }
  std::set<std::string> shown;
  for (const Node& node : nodes_) {
    const bool all = node.count.objects > 0 && node.count.hidden == node.count.objects;
    if (!all) {
      shown.insert(node.name);
    } else if (node.is_object) {
      ++hidden.names[node.name];
    }
  }
  std::erase_if(hidden.names, [&](const auto& one) { return shown.contains(one.first); });
  hidden.left_over = static_cast<std::size_t>(std::count_if(nodes_.begin(), nodes_.end(), [&](const Node& node) {
    return node.is_object && node.hidden && !hidden.names.contains(node.name);
  }));
  return hidden;
}

SceneObjects::Decisions SceneObjects::decisions() const {
  const std::lock_guard lock(mutex_);
  Decisions all;
  for (const Node& node : nodes_) {
    if (!node.decided) continue;
    std::vector<std::string> names;
    for (const Node* at = &node; at != &nodes_.front(); at = &nodes_[at->parent]) names.push_back(at->name);
    std::reverse(names.begin(), names.end());
    all.emplace_back(std::move(names), *node.decided);
  }
  return all;
}

std::vector<std::string> SceneObjects::unmatched() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> vain;
  for (std::size_t i = 0; i < patterns_.size(); ++i) {
    if (!matched_[i]) vain.push_back(patterns_[i]);
  }
  return vain;
}

}  // namespace roam::app
