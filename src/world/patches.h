#pragma once
/// \file
/// Which patches are in use: a cut through the trees of patches and what refines them. Belongs to one thread.

#include <cstdint>
#include <functional>
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

class Patches {
 public:
  /// Whether the body has room in a world.
  using Fits = std::function<bool(const World&)>;

  void expect(const Box& where, PatchId refines);
  void deliver(PatchId patch, World world);
  void fail(PatchId patch, std::string reason);

  /// Replaces what can be replaced, by the finest for which `fits` holds, or for everything where it is empty. What was
  /// unknown is replaced at once. Returns those that came to be shown or known, or ceased to be shown, since the last
  /// call; some perhaps more than once.
  [[nodiscard]] std::vector<std::uint32_t> settle(const Fits& fits);
  /// Whether some wait until the body is free in them.
  [[nodiscard]] bool unsettled() const { return !touched_.empty(); }

  [[nodiscard]] const Patch& operator[](std::uint32_t index) const { return patches_[index]; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(patches_.size()); }
  /// The worlds that are of no more use since this was called last.
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

  std::vector<Patch> patches_;
  std::vector<std::uint32_t> touched_;  ///< shown ones that may be replaced, each perhaps more than once
  std::vector<std::uint32_t> changed_;
  std::vector<World> replaced_;
  PatchworkStats stats_;  ///< but for `waiting`
};

}  // namespace roam
