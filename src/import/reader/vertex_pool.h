#pragma once
/// \file
/// The vertices of a file whose objects share one list of vertices.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "roam/math.h"

namespace roam::reader {

/// All vertices of the file so far, and which of them the current object uses. At most 29 bytes a vertex. Grows by
/// blocks, so that growth neither copies nor doubles the memory.
class VertexPool {
 public:
  void add(const Vec3& vertex) {
    if (size_ % block_size == 0) {
      blocks_.push_back(std::make_unique_for_overwrite<Block>());
      blocks_.back()->index.fill(none);
    }
    blocks_.back()->vertex[size_ % block_size] = vertex;
    ++size_;
  }
  [[nodiscard]] const Vec3& operator[](std::uint64_t i) const {
    return blocks_[i / block_size]->vertex[i % block_size];
  }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Forgets the indices of the previous object.
  void begin_object() {
    if (forget_all_) {
      for (auto& block : blocks_) block->index.fill(none);
    } else {
      for (const std::uint64_t i : used_) blocks_[i / block_size]->index[i % block_size] = none;
    }
    forget_all_ = false;
    used_.clear();
  }
  /// The index of vertex i in the current object. If it has none yet, calls `add_to_object`, which returns one.
  template <class AddToObject>
  std::uint32_t index_in_object(std::uint64_t i, AddToObject&& add_to_object) {
    Block& block = *blocks_[i / block_size];
    std::uint32_t& index = block.index[i % block_size];
    if (index == none) {
      index = add_to_object(block.vertex[i % block_size]);
      // Beyond an eighth of all vertices, forgetting all is no slower than remembering which to forget.
      if (used_.size() < least_used + size_ / 8) {
        used_.push_back(i);
      } else {
        forget_all_ = true;
      }
    }
    return index;
  }

 private:
  static constexpr std::uint64_t block_size = 1u << 16;
  static constexpr std::uint64_t least_used = block_size;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct Block {
    std::array<Vec3, block_size> vertex;
    std::array<std::uint32_t, block_size> index;
  };

  std::vector<std::unique_ptr<Block>> blocks_;
  std::uint64_t size_ = 0;
  std::vector<std::uint64_t> used_;
  bool forget_all_ = false;
};

}  // namespace roam::reader
