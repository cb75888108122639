#include "world/patches.h"

#include <algorithm>
#include <utility>

namespace roam {
namespace {

constexpr std::uint64_t minus_one = ~std::uint64_t{0};  // unsigned counts wrap around

std::uint32_t index_of(PatchId patch) { return static_cast<std::uint32_t>(patch) - 1; }

}  // namespace

void PatchList::push_back(Patch patch) {
  if (size_ % width == 0) blocks_.push_back(std::make_unique<Block>());
  blocks_.back()->at(size_++) = std::move(patch);
}

void PatchList::count_replaced(std::uint32_t index) {
  if (++blocks_[index / width]->replaced == width) done_.push_back(index / width);
}

void PatchList::release() {
  for (const std::uint32_t block : done_) blocks_[block].reset();
  done_.clear();
}

void Patches::expect(const Box& where, PatchId refines) {
  const std::uint32_t self = size();
  Patch patch;
  patch.where = where;
  patch.parent = refines == PatchId::none ? no_parent : index_of(refines);
  // A patch that has been replaced cannot be refined any more.
  if (patch.parent != no_parent && (is_replaced(patch.parent) || !may_refine(patch.parent))) patch.parent = no_parent;
  if (patch.parent != no_parent) {
    patch.role = Patch::Role::finer;
    patches_[patch.parent].finer.push_back(self);
  }
  patches_.push_back(std::move(patch));
  ++stats_.coming;
  if (patches_[self].role == Patch::Role::shown) show(self);
}

void Patches::deliver(PatchId id, World world) {
  const std::uint32_t self = index_of(id);
  if (is_replaced(self)) {
    replaced_.push_back(std::move(world));
    return;
  }
  Patch& patch = patches_[self];
  --(patch.failed ? stats_.failed : stats_.coming);
  patch.failed = false;
  patch.reason.clear();
  stats_.bytes += world.stats().bytes;
  if (patch.role == Patch::Role::shown) count_shown(patch, minus_one);
  patch.world = std::move(world);
  if (patch.role == Patch::Role::shown) {
    count_shown(patch, 1);
    changed_.push_back(self);
  } else {
    touch(self);
  }
}

void Patches::fail(PatchId id, std::string reason) {
  // A replaced patch is not needed.
  if (is_replaced(index_of(id))) return;
  Patch& patch = patches_[index_of(id)];
  if (!patch.failed) {
    ++stats_.failed;
    --stats_.coming;
  }
  patch.failed = true;
  patch.reason = std::move(reason);
}

void Patches::forget(std::uint32_t index) {
  if (is_replaced(index) || !patches_[index].world) return;
  Patch& patch = patches_[index];
  const bool shown = patch.role == Patch::Role::shown;
  if (shown) count_shown(patch, minus_one);
  stats_.bytes -= patch.world->stats().bytes;
  ++stats_.coming;
  replaced_.push_back(std::move(*patch.world));
  patch.world.reset();
  if (!shown) return;
  count_shown(patch, 1);
  changed_.push_back(index);
}

bool Patches::may_refine(std::uint32_t index) const {
  for (int level = 1; level < Patchwork::most_levels; ++level) {
    if (patches_[index].role != Patch::Role::finer) return true;
    index = patches_[index].parent;
  }
  return false;
}

void Patches::touch(std::uint32_t index) {
  while (patches_[index].role == Patch::Role::finer) index = patches_[index].parent;
  touched_.push_back(index);
}

bool Patches::complete(std::uint32_t index) const { return patches_[index].world || refinable(index); }

bool Patches::refinable(std::uint32_t index) const {
  const Patch& patch = patches_[index];
  return !patch.finer.empty() &&
         std::all_of(patch.finer.begin(), patch.finer.end(), [this](std::uint32_t i) { return complete(i); });
}

bool Patches::find_cut(std::uint32_t index, const Fits& fits, Cut& cut) const {
  if (find_finer(index, fits, cut)) return true;
  const std::optional<World>& world = patches_[index].world;
  if (!world || (fits && !fits(*world))) return false;
  cut.push_back(index);
  return true;
}

bool Patches::find_finer(std::uint32_t index, const Fits& fits, Cut& cut) const {
  if (!refinable(index)) return false;
  const std::size_t before = cut.size();
  for (const std::uint32_t finer : patches_[index].finer) {
    if (find_cut(finer, fits, cut)) continue;
    cut.resize(before);
    return false;
  }
  return true;
}

std::vector<std::uint32_t> Patches::settle(const Fits& fits) {
  Cut touched = std::exchange(touched_, {});
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  while (!touched.empty()) {
    const std::uint32_t index = touched.back();
    touched.pop_back();
    if (!refinable(index)) continue;
    Cut cut;
    if (find_finer(index, fits, cut) || (!patches_[index].world && find_finer(index, {}, cut))) {
      replace(index, cut);
      // A patch that is not the finest waits until the body fits in a finer one.
      touched.insert(touched.end(), cut.begin(), cut.end());
    } else {
      touched_.push_back(index);
    }
  }
  return std::exchange(changed_, {});
}

void Patches::replace(std::uint32_t index, const Cut& cut) {
  retire(index);
  for (const std::uint32_t i : cut) {
    for (std::uint32_t above = patches_[i].parent; patches_[above].role == Patch::Role::finer;
         above = patches_[above].parent) {
      retire(above);
    }
    show(i);
  }
}

void Patches::retire(std::uint32_t index) {
  Patch& patch = patches_[index];
  if (patch.role == Patch::Role::shown) {
    count_shown(patch, minus_one);
    changed_.push_back(index);
  }
  // A patch that finer ones have replaced counts neither as coming nor as failed.
  if (!patch.world) --(patch.failed ? stats_.failed : stats_.coming);
  patch.role = Patch::Role::replaced;
  patches_.count_replaced(index);
  patch.failed = false;
  patch.finer = {};
  patch.reason = {};
  if (!patch.world) return;
  stats_.bytes -= patch.world->stats().bytes;
  replaced_.push_back(std::move(*patch.world));
  patch.world.reset();
}

void Patches::show(std::uint32_t index) {
  patches_[index].role = Patch::Role::shown;
  count_shown(patches_[index], 1);
  changed_.push_back(index);
}

void Patches::count_shown(const Patch& patch, std::uint64_t one) {
  (patch.world ? stats_.patches : stats_.unknown) += one;
  if (patch.world) stats_.triangles += one * patch.world->stats().triangles;
}

std::vector<World> Patches::take_replaced() {
  patches_.release();
  return std::exchange(replaced_, {});
}

PatchworkStats Patches::stats() const {
  Cut cut;
  for (const std::uint32_t index : touched_) find_finer(index, {}, cut);
  PatchworkStats stats = stats_;
  stats.waiting = cut.size();
  return stats;
}

}  // namespace roam
