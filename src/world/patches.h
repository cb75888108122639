#pragma once
/// \file
/// The patches in use: a cut through the trees of patches and their refinements. Used by one thread.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "roam/patchwork.h"

namespace roam {

/// One patch. It is *finer* than the one shown in its place, *shown* (known, or unknown and solid), or *replaced* by
/// finer ones. A shown patch has no other shown patch above or below it in its tree.
struct Patch {
  enum class Role : std::uint8_t { finer, shown, replaced };

  Box where;
  std::uint32_t parent = 0;  ///< index; no_parent if it refines nothing
  Role role = Role::shown;
  bool failed = false;
  std::vector<std::uint32_t> finer;  ///< the patches that refine it
  std::optional<World> world;        ///< the delivered world, until the patch is replaced
  std::string reason;                ///< reason of the failure
};

/// All patches by index, in blocks. A block whose patches have all been replaced takes no memory.
class PatchList {
 public:
  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] const Patch& operator[](std::uint32_t index) const { return blocks_[index / width]->at(index); }
  [[nodiscard]] Patch& operator[](std::uint32_t index) { return blocks_[index / width]->at(index); }
  /// Whether it has been replaced, and perhaps freed.
  [[nodiscard]] bool is_replaced(std::uint32_t index) const {
    return blocks_[index / width] == nullptr || (*this)[index].role == Patch::Role::replaced;
  }

  void push_back(Patch patch);
  /// Must be called once for each replaced patch.
  void count_replaced(std::uint32_t index);
  /// Frees the blocks whose patches have all been replaced.
  void release();

 private:
  static constexpr std::uint32_t width = 64;
  struct Block {
    std::array<Patch, width> patches;
    std::uint32_t replaced = 0;

    [[nodiscard]] Patch& at(std::uint32_t index) { return patches[index % width]; }
  };

  std::vector<std::unique_ptr<Block>> blocks_;
  std::vector<std::uint32_t> done_;  ///< blocks whose patches have all been replaced
  std::uint32_t size_ = 0;
};

class Patches {
 public:
  /// Whether the body has room in a world.
  using Fits = std::function<bool(const World&)>;

  void expect(const Box& where, PatchId refines);
  void deliver(PatchId patch, World world);
  void fail(PatchId patch, std::string reason);
  /// Makes a delivered patch unknown again; no effect if it has been replaced.
  void forget(std::uint32_t index);

  /// Replaces patches by the finest for which `fits` holds, or by the finest at all if `fits` is empty. An unknown
  /// patch is replaced at once. Returns the patches that became shown or known, or are no longer shown, since the last
  /// call; some may occur more than once.
  [[nodiscard]] std::vector<std::uint32_t> settle(const Fits& fits);
  /// Whether some patches wait until the body fits in them.
  [[nodiscard]] bool unsettled() const { return !touched_.empty(); }

  /// A patch that was not is_replaced() at the last call of take_replaced().
  [[nodiscard]] const Patch& operator[](std::uint32_t index) const { return patches_[index]; }
  [[nodiscard]] bool is_replaced(std::uint32_t index) const { return patches_.is_replaced(index); }
  [[nodiscard]] std::uint32_t size() const { return patches_.size(); }
  /// The worlds no longer in use since the last call. Replaced patches are freed with them.
  [[nodiscard]] std::vector<World> take_replaced();

  /// `bytes` counts all worlds that are held.
  [[nodiscard]] PatchworkStats stats() const;

 private:
  static constexpr std::uint32_t no_parent = UINT32_MAX;
  using Cut = std::vector<std::uint32_t>;

  /// Whether a patch below this one is within the levels that recursion bears.
  [[nodiscard]] bool may_refine(std::uint32_t index) const;
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
  std::vector<std::uint32_t> touched_;  ///< shown patches that may be replaced, some more than once
  std::vector<std::uint32_t> changed_;
  std::vector<World> replaced_;
  PatchworkStats stats_;  ///< without `waiting`
};

}  // namespace roam
