#pragma once
/// \file
/// Which patches are in use: a cut through the trees of patches and what refines them. Belongs to one thread.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "roam/patchwork.h"

namespace roam {

/// One patch. It is *finer* than what is shown in its place, *shown* (known, or unknown and solid), or *replaced* by
/// finer ones. Above and below every shown patch of a tree there is no other.
struct Patch {
  enum class Role : std::uint8_t { finer, shown, replaced };

  Box where;
  std::uint32_t parent = 0;  ///< its index; no_parent where it refines nothing
  Role role = Role::shown;
  bool failed = false;
  std::vector<std::uint32_t> finer;  ///< what refines it
  std::optional<World> world;        ///< what was delivered, until it is replaced
  std::string reason;                ///< why it failed
};

/// All patches by index, in blocks: those of which every patch has been replaced take no memory.
class PatchList {
 public:
  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] const Patch& operator[](std::uint32_t index) const { return blocks_[index / width]->at(index); }
  [[nodiscard]] Patch& operator[](std::uint32_t index) { return blocks_[index / width]->at(index); }
  /// Whether it has been replaced, and is perhaps not there any more.
  [[nodiscard]] bool is_replaced(std::uint32_t index) const {
    return blocks_[index / width] == nullptr || (*this)[index].role == Patch::Role::replaced;
  }

  void push_back(Patch patch);
  /// To be called once for each that has been replaced.
  void count_replaced(std::uint32_t index);
  /// Frees the blocks of which all have been replaced.
  void release();

 private:
  static constexpr std::uint32_t width = 64;
  struct Block {
    std::array<Patch, width> patches;
    std::uint32_t replaced = 0;

    [[nodiscard]] Patch& at(std::uint32_t index) { return patches[index % width]; }
  };

  std::vector<std::unique_ptr<Block>> blocks_;
  std::vector<std::uint32_t> done_;  ///< blocks of which all have been replaced
  std::uint32_t size_ = 0;
};

class Patches {
 public:
  /// Whether the body has room in a world.
  using Fits = std::function<bool(const World&)>;

  void expect(const Box& where, PatchId refines);
  void deliver(PatchId patch, World world);
  void fail(PatchId patch, std::string reason);
  /// What was delivered is unknown again; nothing where it has been replaced.
  void forget(std::uint32_t index);

  /// Replaces what can be replaced, by the finest for which `fits` holds, or for everything where it is empty. What was
  /// unknown is replaced at once. Returns those that came to be shown or known, or ceased to be shown, since the last
  /// call; some perhaps more than once.
  [[nodiscard]] std::vector<std::uint32_t> settle(const Fits& fits);
  /// Whether some wait until the body is free in them.
  [[nodiscard]] bool unsettled() const { return !touched_.empty(); }

  /// One that was not is_replaced() when take_replaced() was called last.
  [[nodiscard]] const Patch& operator[](std::uint32_t index) const { return patches_[index]; }
  [[nodiscard]] bool is_replaced(std::uint32_t index) const { return patches_.is_replaced(index); }
  [[nodiscard]] std::uint32_t size() const { return patches_.size(); }
  /// The worlds that are of no more use since this was called last. What has been replaced is forgotten with them.
  [[nodiscard]] std::vector<World> take_replaced();

  /// Bytes are those of all worlds that are held.
  [[nodiscard]] PatchworkStats stats() const;

 private:
  static constexpr std::uint32_t no_parent = UINT32_MAX;
  using Cut = std::vector<std::uint32_t>;

  [[nodiscard]] bool complete(std::uint32_t index) const;
  [[nodiscard]] bool refinable(std::uint32_t index) const;
  bool find_cut(std::uint32_t index, const Fits& fits, Cut& cut) const;
  bool find_finer(std::uint32_t index, const Fits& fits, Cut& cut) const;
  void replace(std::uint32_t index, const Cut& cut);
  void retire(std::uint32_t index);
  void show(std::uint32_t index);
  void count_shown(const Patch& patch, std::uint64_t one);
  void touch(std::uint32_t index);

  PatchList patches_;
  std::vector<std::uint32_t> touched_;  ///< shown ones that may be replaced, each perhaps more than once
  std::vector<std::uint32_t> changed_;
  std::vector<World> replaced_;
  PatchworkStats stats_;  ///< but for `waiting`
};

}  // namespace roam
