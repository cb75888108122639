#include "world/box_tree.h"

namespace roam {
namespace {

double surface(const Box& box) {
  const Vec3 s = box.size();
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

Box united(const Box& a, const Box& b) {
  Box both = a;
  both.include(b);
  return both;
}

}  // namespace

void BoxTree::change(const std::vector<Item>& put, const std::vector<std::uint32_t>& erased) {
  if (put.empty() && erased.empty()) return;
  const bool many = (put.size() + erased.size()) * many_part > size_;
  const auto is_new = [&](const Item& item) { return leaf_of(item.number) == none; };
  const auto added = static_cast<std::size_t>(std::count_if(put.begin(), put.end(), is_new));
  std::vector<Item> all;
  if (many || nodes_[root_].height + put.size() >= deepest_tree) all.reserve(size_ + added);
  make_room(put, many ? 2 * (size_ + added) : nodes_.size() + 2 * added);
  // Nothing from here on allocates, so nothing fails halfway.
  for (const std::uint32_t number : erased) erase(number);
  if (many) {
    for (const Item& item : put) erase(item.number);
    add_items(all);
    all.insert(all.end(), put.begin(), put.end());
    return build(all);
  }
  for (const Item& item : put) {
    erase(item.number);
    insert(item);
    if (nodes_[root_].height < deepest_tree) continue;
    all.clear();
    add_items(all);
    build(all);
  }
}

void BoxTree::make_room(const std::vector<Item>& put, std::size_t nodes) {
  // More than needed, as push_back does: many changes of one item each take constant time on average.
  const auto grow = [](auto& list, std::size_t size) {
    if (list.capacity() < size) list.reserve(std::max(size, 2 * list.capacity()));
  };
  grow(nodes_, nodes);
  grow(unused_, std::max(nodes, nodes_.size()));
  for (const Item& item : put) {
    if (item.number >= leaves_.size()) leaves_.resize(item.number + 1, none);
  }
}

std::uint32_t BoxTree::leaf_of(std::uint32_t number) const { return number < leaves_.size() ? leaves_[number] : none; }

void BoxTree::add_items(std::vector<Item>& to) const {
  for (std::uint32_t number = 0; number < leaves_.size(); ++number) {
    if (leaves_[number] != none) to.push_back({nodes_[leaves_[number]].box, number});
  }
}

// Halves the items recursively at the median along their longest extent.
void BoxTree::build(std::vector<Item>& items) {
  nodes_.clear();
  unused_.clear();
  root_ = none;
  size_ = items.size();
  if (!items.empty()) root_ = split(items, 0, items.size());
}

std::uint32_t BoxTree::split(std::vector<Item>& items, std::size_t begin, std::size_t end) {
  if (end - begin == 1) return make({items[begin].box, none, none, none, items[begin].number, 0});
  Box middles;
  for (std::size_t i = begin; i < end; ++i) middles.include(items[i].box.center());
  const Vec3 size = middles.size();
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const auto place = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(place(begin), place(middle), place(end), [axis](const Item& a, const Item& b) {
    const double x = a.box.lower[axis] + a.box.upper[axis], y = b.box.lower[axis] + b.box.upper[axis];
    return x != y ? x < y : a.number < b.number;
  });
  const std::uint32_t left = split(items, begin, middle), right = split(items, middle, end);
  const std::uint32_t self = make({{}, none, left, right, none, 0});
  nodes_[left].parent = nodes_[right].parent = self;
  fit(self);
  return self;
}

std::uint32_t BoxTree::make(const Node& node) {
  std::uint32_t index = static_cast<std::uint32_t>(nodes_.size());
  if (unused_.empty()) {
    nodes_.push_back(node);
  } else {
    index = unused_.back();
    unused_.pop_back();
    nodes_[index] = node;
  }
  if (node.leaf()) leaves_[node.number] = index;
  return index;
}

// Puts the new leaf beside the one to which the path adds least surface (Goldsmith and Salmon, "Automatic creation of
// object hierarchies for ray tracing", 1987).
void BoxTree::insert(const Item& item) {
  ++size_;
  const std::uint32_t leaf = make({item.box, none, none, none, item.number, 0});
  if (root_ == none) {
    root_ = leaf;
    return;
  }
  std::uint32_t beside = root_;
  while (!nodes_[beside].leaf()) {
    const auto growth = [&](std::uint32_t child) {
      const Box& box = nodes_[child].box;
      return surface(united(box, item.box)) - surface(box);
    };
    const Node& node = nodes_[beside];
    beside = growth(node.left) <= growth(node.right) ? node.left : node.right;
  }
  const std::uint32_t above = nodes_[beside].parent;
  const std::uint32_t both = make({{}, above, beside, leaf, none, 0});
  link(above, beside, both);
  nodes_[beside].parent = nodes_[leaf].parent = both;
  fit_upward(both);
}

void BoxTree::erase(std::uint32_t number) {
  const std::uint32_t leaf = leaf_of(number);
  if (leaf == none) return;
  leaves_[number] = none;
  --size_;
  const std::uint32_t above = nodes_[leaf].parent;
  unused_.push_back(leaf);
  if (above == none) {
    root_ = none;
    return;
  }
  const std::uint32_t other = nodes_[above].left == leaf ? nodes_[above].right : nodes_[above].left;
  const std::uint32_t top = nodes_[above].parent;
  unused_.push_back(above);
  nodes_[other].parent = top;
  link(top, above, other);
  fit_upward(top);
}

void BoxTree::link(std::uint32_t parent, std::uint32_t old_child, std::uint32_t child) {
  if (parent == none) {
    root_ = child;
  } else {
    (nodes_[parent].left == old_child ? nodes_[parent].left : nodes_[parent].right) = child;
  }
}

void BoxTree::fit(std::uint32_t index) {
  Node& node = nodes_[index];
  const Node& left = nodes_[node.left];
  const Node& right = nodes_[node.right];
  node.box = united(left.box, right.box);
  node.height = 1 + std::max(left.height, right.height);
}

void BoxTree::fit_upward(std::uint32_t node) {
  for (; node != none; node = nodes_[node].parent) fit(node);
}

}  // namespace roam
