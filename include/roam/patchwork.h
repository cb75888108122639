#pragma once
/// \file
/// A space that is put together while a body moves in it: patches come from any thread, in any order, coarse before
/// fine, and where nothing has come yet space is unknown and solid.
///
///     roam::Patchwork space;
///     const roam::PatchId tile = space.expect(box_of_the_tile);
///     space.update();                                                // now the box is unknown, and solid
///     roam::Walker walker(space, {.radius = 0.3}, roam::Mode::fly, start);
///     ...
///     space.deliver(tile, std::move(world_of_the_tile));             // from a loading thread
///     ...
///     space.update(walker.body(), walker.position());                // between two steps: now it is there
///
/// Before the first update() all is free. A patch is one World with a number. What is expected and delivered takes
/// effect at the next update(), all at once, and never in the middle of a step. What was unknown is known at once. A
/// patch that refines another takes its place only together with all others that refine it, and only when the body,
/// where it is at that moment, is free in them: nobody is caught in a wall because it became more exact. Until then the
/// coarse one stays, and every update() tries again. A body that does not fit where it is anyway (a ghost in a wall, a
/// body that waits in what is unknown) holds nothing up.
///
/// An unknown box is kept away from by Patchwork::margin beyond its surface, so that whatever comes to light in it, and
/// is stored as inexactly as World::build may, leaves a body beside it free.
///
/// expect(), deliver(), fail(), forget() and stats() may be called from any thread at any time. Everything else belongs
/// to the thread that moves the body: queries may run at the same time as each other, but not during update(). Queries
/// never lock, never wait, never allocate. Their answers depend on which patches are in use and on nothing else: not on
/// the order in which these came, nor on what was there before, to the last bit.

#include <cstdint>
#include <memory>
#include <string>

#include "roam/space.h"
#include "roam/world.h"

namespace roam {

/// The number of a patch: 1 for the first that is expected, and so on. Never given twice by one Patchwork.
enum class PatchId : std::uint64_t { none = 0 };

/// What a patchwork holds, as of the last update().
struct PatchworkStats {
  std::uint64_t patches = 0;    ///< that are known and in use
  std::uint64_t unknown = 0;    ///< boxes that are solid because they have not come, the failed ones included
  std::uint64_t failed = 0;     ///< patches that fail() spoke of last: solid, or where they refine another, coarse;
                                ///< replaced ones not
  std::uint64_t coming = 0;     ///< patches that have neither come nor failed, finer ones included, replaced ones not
  std::uint64_t waiting = 0;    ///< finer ones that are all there and wait until the body is free in them
  std::uint64_t triangles = 0;  ///< of the patches in use
  std::uint64_t bytes = 0;      ///< resident worlds, with those that wait and those that wait to be freed
};

class Patchwork final : public LiveSpace {
 public:
  /// Stored vertices may lie this far off at most, metres: what World::build keeps to.
  static constexpr double error_limit = 1e-3;
  /// How much more than its radius a body keeps from what is unknown, metres: as much as Space allows, less 10 um, and
  /// twice the largest_error() of a world that is stored to 0.99 mm. World::build mostly stores to 0.5 mm.
  static constexpr double margin = 1.99e-3;

  Patchwork();
  ~Patchwork() override;
  Patchwork(const Patchwork&) = delete;
  Patchwork& operator=(const Patchwork&) = delete;

  /// Says that something will be in `where` (m, finite, not empty, within coordinate_limit): from the next update()
  /// until it is delivered that box is unknown. Let `where` hold all that will be delivered: what lies outside may come
  /// upon a body that stands there, as if it had been put there (see Walker::place).
  ///
  /// With `refines`, the space is not unknown, since the patch `refines` is known there, and stays until this one
  /// comes. Patches that refine the same one hold together all that is there, and take its place all at once: when each
  /// of them has come, or is itself refined by patches that all have. Where one of them fails the coarse one stays, for
  /// a part of it alone would leave a hole. They may come before what they refine, and be refined in turn. Expect all
  /// that refine one patch before the last of them is delivered: what is expected for a patch that has been replaced
  /// stands alone, its box unknown until it comes.
  ///
  /// Throws roam::Error for a box that is not as said and for a `refines` that was never expected.
  PatchId expect(const Box& where, PatchId refines = PatchId::none);

  /// Brings what was expected. An empty world is an answer too: nothing is there. What has been replaced by finer ones
  /// already is dropped. Throws roam::Error for a number that was not expected or was delivered before, and for a world
  /// that is stored less exactly than error_limit or has more than 4 billion triangles.
  ///
  /// Also frees the memory of what the last updates replaced, here, so that the thread that moves the body need not:
  /// expect() and fail() do so too.
  void deliver(PatchId patch, World world);

  /// Says that what was expected can not come, with the reason for people. Where it refines another, that one stays;
  /// else its box stays solid. It may still be delivered later. Throws roam::Error for a number that was not expected
  /// or was delivered.
  void fail(PatchId patch, const std::string& reason);

  /// Forgets what was delivered, to free its memory: its box is unknown again, and the same patch may be delivered
  /// again. That waits while the body is in the box or within Patchwork::margin of it; an update() without a body does
  /// not wait. Nothing happens where finer patches have replaced it. Throws roam::Error for a number that was not
  /// expected, or that was not delivered or is forgotten already.
  /// What is delivered again while that waits takes its place at once: what
  /// sticks out may come upon the body, as if it had been put there.
  void forget(PatchId patch);

  /// Takes into use what has been delivered. `body` at `place` is where a finer patch must leave room. Returns whether
  /// any triangle or unknown box came or went. Holds the lock that deliver() takes only to swap lists. Costs next to
  /// nothing when nothing came and nothing waits, else a few looks for the nearest triangle, and some microseconds for
  /// what changed; only where a quarter of all is new is the tree over the patches made anew, 1 us a patch. Throws
  /// roam::Error for a body or a place that no query takes, and then takes nothing.
  bool update(const Body& body, const Vec3& place);
  /// The same; where the body goes to makes no difference.
  bool update(const Body& body, const Vec3& place, const Vec3& /*velocity*/) override { return update(body, place); }
  /// The same before there is a body.
  bool update();

  /// The largest error is error_limit.
  [[nodiscard]] SpaceFacts facts() const override;
  /// For what is unknown the name is the reason: what fail() gave, else "not loaded yet". A number whose patch has gone
  /// belongs to no object.
  ///
  /// The number of a triangle is that of its patch times 2^32, and its number in the patch's world: the same for as
  /// long as the patch is in use; another patch never has it, the same one again after forget(). The sides of an
  /// unknown box have numbers of their own. To Space::contacts() such a box is one contact: where it is nearest.
  /// Objects are numbered in each patch's world.
  [[nodiscard]] Object object(TriangleId triangle) const override;

  /// The patch that a triangle, or the side of an unknown box, belongs to, and its number in the patch's world.
  [[nodiscard]] static PatchId patch(TriangleId triangle) { return PatchId{triangle >> 32}; }
  [[nodiscard]] static TriangleId triangle_in_patch(TriangleId triangle) { return triangle & 0xFFFFFFFF; }

  [[nodiscard]] PatchworkStats stats() const;

 protected:
  [[nodiscard]] FirstImpact ask_first(const Query& query, Vicinity* vicinity) const override;
  void ask_near(const Query& query, Collector& collector, Vicinity* vicinity) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roam
