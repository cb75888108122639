#pragma once
/// \file
/// A patchwork: a space loaded while a body moves in it, from worlds delivered by any thread, coarse before fine.
///
///     roam::Patchwork space;
///     const roam::PatchId tile = space.expect(box_of_the_tile);
///     space.update();                                                // from now on the box is unknown, and solid
///     roam::Walker walker(space, {.radius = 0.3}, roam::Mode::fly, start);
///     space.deliver(tile, std::move(world_of_the_tile));             // from a loading thread
///     space.update(walker.body(), walker.position());                // between two steps: now it is there
///
/// Before the first update() all space is free. Expected, delivered and forgotten patches take effect at the next
/// update(). Patches that refine another replace it together, once the body is free in them. A body that does not fit
/// in the old patches either (a ghost in a wall, a body in unknown space) delays nothing.
///
/// expect(), deliver(), fail(), forget() and stats() may be called from any thread at any time. All else belongs to the
/// thread that moves the body; queries may run at the same time, but not during update(). Results depend, to the bit,
/// only on the patches in use, not on their order or history. Lengths are metres.

#include <cstdint>
#include <memory>
#include <string>

#include "roam/space.h"
#include "roam/world.h"

namespace roam {

enum class PatchId : std::uint64_t { none = 0 };  ///< counted from 1 in the order of expect(); never reused

/// Counts of a patchwork after its last update(). Replaced patches are not counted.
struct PatchworkStats {
  std::uint64_t patches = 0;    ///< known and in use
  std::uint64_t unknown = 0;    ///< solid boxes of patches that have not come, failed ones included
  std::uint64_t failed = 0;     ///< patches whose last message was fail(): solid, or still coarse if they refine one
  std::uint64_t coming = 0;     ///< patches that have neither come nor failed, refining ones included
  std::uint64_t waiting = 0;    ///< refining patches that are complete and wait until the body is free in them
  std::uint64_t triangles = 0;  ///< in the patches in use
  std::uint64_t bytes = 0;      ///< of all resident worlds, including those that wait to replace or to be freed
};

class Patchwork final : public LiveSpace {
 public:
  static constexpr double error_limit = 1e-3;  ///< largest error of a world that deliver() takes
  static constexpr double margin = 1.99e-3;    ///< extra distance from unknown boxes: room for a world that comes there
  static constexpr int most_levels = 1000;     ///< of refinements, one below the other, that wait for their turn

  Patchwork();
  ~Patchwork() override;
  Patchwork(const Patchwork&) = delete;
  Patchwork& operator=(const Patchwork&) = delete;

  /// Announces a patch. From the next update() until its delivery the box `where` is unknown. Triangles of the patch
  /// outside that box may overlap a body, which is then freed or held (see Walker::place()). Throws roam::Error for a
  /// box that is empty, not finite or beyond coordinate_limit, and for a `refines` that was never expected.
  ///
  /// Patches that refine the same one must cover it together. They replace it together, when each has come or is itself
  /// refined by patches that have; if one fails, the coarse patch stays. They may be delivered before the coarse one.
  /// Call expect() for all of them before you deliver the last. A patch that is announced after `refines` was replaced,
  /// or more than most_levels deep, is not part of the replacement: its box is unknown at first.
  PatchId expect(const Box& where, PatchId refines = PatchId::none);

  /// Delivers an expected patch; an empty world means that nothing is there. Drops it if it has been replaced. Worlds
  /// that updates replaced are freed here, and in expect(), fail() and forget(). Throws roam::Error for a patch that is
  /// not expected or delivered already, and for a world with a larger error than error_limit or of over 4 billion
  /// triangles.
  void deliver(PatchId patch, World world);

  /// Marks a patch as failed, with a reason for display. Its box stays solid; if it refines another, that one stays. It
  /// may still be delivered. Throws roam::Error for a patch that was not expected or is delivered.
  void fail(PatchId patch, const std::string& reason);

  /// Makes a delivered patch unknown again, which frees its world; it may be delivered again. Waits while the body is
  /// in the box or within 2 * margin of it, unless update() gets no body. If the patch is delivered again during the
  /// wait, the next update() takes the new one, which may overlap the body. Does nothing if finer patches replaced it.
  /// Throws roam::Error for a patch that was not expected or is not delivered.
  void forget(PatchId patch);

  /// Takes delivered patches into use; finer ones must leave `body` free at `place`. Returns whether a triangle or an
  /// unknown box came or went. Throws roam::Error, and takes nothing, for a body or position that no query takes.
  /// After std::bad_alloc patches may be missing. Then all space is unknown, and every update() throws roam::Error.
  bool update(const Body& body, const Vec3& place);
  bool update(const Body& body, const Vec3& place, const Vec3& velocity) override;
  bool update();                                    ///< the same without a body
  [[nodiscard]] SpaceFacts facts() const override;  ///< the largest error is error_limit
  /// A triangle's number is its patch times 2^32 plus that in the patch's world: stable while the patch is in use, and
  /// never another patch's. Objects are numbered within each patch. The sides of an unknown box have numbers too; the
  /// name is the reason: that of fail(), else "not loaded yet". Space::contacts() lists such a box once.
  [[nodiscard]] Object object(TriangleId triangle) const override;
  /// The patch of a triangle or of the side of an unknown box, and its number in the patch's world.
  [[nodiscard]] static PatchId patch(TriangleId triangle) { return PatchId{triangle >> 32}; }
  [[nodiscard]] static TriangleId triangle_in_patch(TriangleId triangle) { return triangle & 0xFFFFFFFF; }
  [[nodiscard]] PatchworkStats stats() const;

 protected:
  [[nodiscard]] FirstImpact find_first(const Query& query, Vicinity* vicinity) const override;
  void find_near(const Query& query, Collector& collector, Vicinity* vicinity) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roam
