#include "import/reader/paged_vertices.h"

#include <algorithm>
#include <span>

#include "import/reader/machine_failure.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

/// The corners of a triangle lie in up to three blocks, and the last block always stays in memory.
constexpr std::uint64_t least_slots = 16;

}  // namespace

PagedVertices::PagedVertices(std::uint64_t memory)
    : slot_limit_(static_cast<std::size_t>(std::clamp<std::uint64_t>(memory / sizeof(Block), least_slots, none))),
      file_("the vertices of a large scene") {}

void PagedVertices::clear() {
  size_ = 0;
  slot_of_.clear();
  written_.clear();
  filled_slots_ = 0;
  last_ = nullptr;
}

void PagedVertices::begin_block() {
  const std::uint32_t slot = free_slot();
  slots_[slot].block = slot_of_.size();
  slots_[slot].used = true;
  last_ = slots_[slot].vertices.get();
  slot_of_.push_back(slot);
  written_.push_back(false);
}

std::uint32_t PagedVertices::free_slot() {
  if (filled_slots_ < slot_limit_) {
    if (filled_slots_ == slots_.size()) slots_.push_back({std::make_unique_for_overwrite<Block>()});
    return static_cast<std::uint32_t>(filled_slots_++);
  }
  // The clock algorithm (Corbato 1968): a block used since the hand passed it stays for one more round. The last block
  // is still being filled. There are always other blocks.
  const std::uint64_t last = slot_of_.size() - 1;
  while (slots_[hand_].used || (slots_[hand_].block == last && size_ % block_size != 0)) {
    slots_[hand_].used = false;
    hand_ = (hand_ + 1) % slot_limit_;
  }
  const auto slot = static_cast<std::uint32_t>(hand_);
  hand_ = (hand_ + 1) % slot_limit_;
  const std::uint64_t block = slots_[slot].block;
  if (!written_[block]) write(block, *slots_[slot].vertices);
  slot_of_[block] = none;
  return slot;
}

void PagedVertices::write(std::uint64_t block, const Block& vertices) {
  try {
    file_.write_at(block * sizeof(Block), std::as_bytes(std::span(vertices)));
  } catch (const Error& error) {
    throw MachineFailure(error);
  }
  written_[block] = true;
}

std::uint32_t PagedVertices::load(std::uint64_t block) {
  const std::uint32_t slot = free_slot();
  try {
    file_.read_at(block * sizeof(Block), std::as_writable_bytes(std::span(*slots_[slot].vertices)));
  } catch (const Error& error) {
    throw MachineFailure(error);
  }
  slots_[slot].block = block;
  slot_of_[block] = slot;
  return slot;
}

}  // namespace roam::reader
