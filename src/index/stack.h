#pragma once
/// \file
/// The stack of a traversal, nearest entries first, in bounded memory.

#include <bit>
#include <cassert>
#include <cstdint>

#include "index/binary_tree.h"
#include "index/block.h"

namespace roam::index {

/// Blocks ordered by a key (a float >= 0, whose bits order like the float), the least on top. At equal keys leaves come
/// before nodes, and then lower numbers first.
///
/// The frontier of a best-first search has no useful bound: around a body in the middle of a dome every node is nearer
/// than every leaf. So beyond best_first entries the search becomes depth-first: children are put on top, ordered only
/// among themselves, until the stack has shrunk. Depth-first search needs node_width - 1 entries per level.
class Stack {
 public:
  struct Entry {
    float key;
    std::uint32_t number;
    bool leaf;
  };

  [[nodiscard]] bool empty() const { return count_ == 0; }

  void clear() { count_ = 0; }

  /// Starts a search at a root.
  void start() {
    clear();
    begin_children();
    push(0.0F, 0, false);
  }

  /// Must be called before the children of a node are pushed.
  void begin_children() { floor_ = ordered() ? 0 : count_; }

  void push(float key, std::uint32_t number, bool leaf) {
    assert(count_ < stack_capacity);
    const std::uint64_t e =
        std::uint64_t{std::bit_cast<std::uint32_t>(key)} << 32 | (leaf ? 0U : std::uint32_t{1} << 31) | number;
    int i = count_++;
    for (; i > floor_ && entries_[i - 1] < e; --i) entries_[i] = entries_[i - 1];
    entries_[i] = e;
  }

  [[nodiscard]] int size() const { return count_; }

  /// The entry that pop() returns after i other pops; i < size().
  [[nodiscard]] Entry next(int i) const {
    const std::uint64_t e = entries_[count_ - 1 - i];
    const auto low = static_cast<std::uint32_t>(e);
    return {std::bit_cast<float>(static_cast<std::uint32_t>(e >> 32)), low & 0x7fffffffU, (low >> 31) == 0};
  }
  Entry pop() {
    const Entry e = next(0);
    --count_;
    return e;
  }

  /// After pop(): true if no remaining entry has a smaller key than the popped one.
  [[nodiscard]] bool ordered() const { return count_ <= best_first; }

 private:
  static constexpr int best_first = 256;
  static constexpr int stack_capacity = best_first + node_width + max_depth * (node_width - 1) + 1;

  int count_ = 0;
  int floor_ = 0;  ///< entries below it are not moved
  std::uint64_t entries_[stack_capacity];
};

}  // namespace roam::index
