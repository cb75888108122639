#pragma once
/// \file
/// A list of vertices in bounded memory.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "files/unnamed_file.h"
#include "roam/math.h"

namespace roam::reader {

/// Keeps some blocks of vertices in memory and the others in an unnamed file in the folder for temporary files (TMPDIR,
/// else /tmp). The constructor makes the file, because the sandbox prevents it later.
class PagedVertices {
 public:
  /// `memory`: most bytes of vertices in memory. A few blocks always stay.
  explicit PagedVertices(std::uint64_t memory);
  PagedVertices(const PagedVertices&) = delete;
  PagedVertices& operator=(const PagedVertices&) = delete;

  /// Throws MachineFailure if the temporary file cannot be written.
  void add(const Vec3& vertex) {
    if (size_ % block_size == 0) begin_block();
    (*last_)[size_ % block_size] = vertex;
    ++size_;
  }
  /// Vertex i; i < size(). Throws MachineFailure if the temporary file cannot be read.
  [[nodiscard]] Vec3 operator[](std::uint64_t i) {
    const std::uint64_t block = i / block_size;
    std::uint32_t slot = slot_of_[block];
    if (slot == none) slot = load(block);
    slots_[slot].used = true;
    return (*slots_[slot].vertices)[i % block_size];
  }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Removes all vertices and keeps the memory.
  void clear();

  /// Vertices of a block. Small, so that scattered reads fetch few unused vertices.
  static constexpr std::uint64_t block_size = 1024;

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  using Block = std::array<Vec3, block_size>;
  /// Memory for one block.
  struct Slot {
    std::unique_ptr<Block> vertices;
    std::uint64_t block = 0;
    bool used = false;  ///< since the hand passed it
  };

  void begin_block();
  std::uint32_t load(std::uint64_t block);
  std::uint32_t free_slot();
  void write(std::uint64_t block, const Block& vertices);

  std::size_t slot_limit_;
  std::uint64_t size_ = 0;
  std::vector<std::uint32_t> slot_of_;  ///< for each block: its slot, or none if it is in the file
  std::vector<bool> written_;           ///< for each block: whether the file has it
  std::vector<Slot> slots_;
  std::size_t filled_slots_ = 0;
  std::size_t hand_ = 0;  ///< of the clock that finds the slot to reuse
  Block* last_ = nullptr;
  files::UnnamedFile file_;
};

}  // namespace roam::reader
