#include "world/box_tree.h"

namespace roam {

void BoxTree::build(std::vector<Item> items) {
  nodes_.clear();
  if (items.empty()) return;
  nodes_.reserve(2 * items.size() - 1);
  split(items, 0, items.size());
}

void BoxTree::split(std::vector<Item>& items, std::size_t begin, std::size_t end) {
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  Box box, middles;
  for (std::size_t i = begin; i < end; ++i) {
    box.include(items[i].box);
    middles.include(items[i].box.center());
  }
  nodes_[self].box = box;
  if (end - begin == 1) {
    nodes_[self].number = items[begin].number;
    return;
  }
  const Vec3 size = middles.size();
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const auto place = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(place(begin), place(middle), place(end), [axis](const Item& a, const Item& b) {
    const double x = a.box.lower[axis] + a.box.upper[axis], y = b.box.lower[axis] + b.box.upper[axis];
    return x != y ? x < y : a.number < b.number;
  });
  split(items, begin, middle);
  nodes_[self].right = static_cast<std::uint32_t>(nodes_.size());
  split(items, middle, end);
}

}  // namespace roam
