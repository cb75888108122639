#pragma once
/// \file
/// A space that is put together while a body moves in it: patches come from any thread, in any order, coarse before
/// fine, and where nothing has come yet space is unknown and solid.
///
///     roam::Patchwork space;
///     const roam::PatchId tile = space.expect(box_of_the_tile);      // unknown, solid
///     roam::Walker walker(space, {.radius = 0.3}, roam::Mode::fly, start);
///     ...
///     space.deliver(tile, std::move(world_of_the_tile));             // from a loading thread
///     ...
///     space.update(walker.body(), walker.position());                // between two steps: now it is there
///
/// A patch is one World with a number. What is delivered takes effect at the next update(), all at once, and never in
/// the middle of a step. A patch that refines another takes its place only when the body, where it is at that moment,
/// is free in the new one: nobody is caught in a wall because it became more exact. Until then the coarse one stays,
/// and the next update() tries again.
///
/// expect(), deliver(), fail() and stats() may be called from any thread at any time. Queries and update() belong to
/// the thread that moves the body: queries may run at the same time as each other, but not during update(). Queries
/// never lock, never wait, never allocate.

#include <cstdint>
#include <memory>
#include <string>

#include "roam/space.h"
#include "roam/world.h"

namespace roam {

/// The number of a patch. Never given twice by one Patchwork.
enum class PatchId : std::uint64_t { none = 0 };

/// What a patchwork holds. Counts of patches are those of the last update().
struct PatchworkStats {
  std::uint64_t patches = 0;    ///< that are known and in use
  std::uint64_t unknown = 0;    ///< that are expected and have not come: solid
  std::uint64_t failed = 0;     ///< that will not come: solid for good, see fail()
  std::uint64_t waiting = 0;    ///< finer ones that wait until the body is free in them
  std::uint64_t triangles = 0;  ///< of the patches in use
  std::uint64_t bytes = 0;      ///< resident, the waiting ones included
};

class Patchwork final : public Space {
 public:
  /// Stored vertices may lie this far off at most, metres: what World::build keeps to.
  static constexpr double error_limit = 1e-3;

  Patchwork();
  ~Patchwork() override;
  Patchwork(const Patchwork&) = delete;
  Patchwork& operator=(const Patchwork&) = delete;

  /// Says that something will be in `where` (m, finite, not empty): until it is delivered that box is unknown. With
  /// `refines`, the space is not unknown, since the patch `refines` is known there and stays until this one comes;
  /// several patches may refine one: it goes when all of them are in use.
  PatchId expect(const Box& where, PatchId refines = PatchId::none);

  /// Brings what was expected. An empty world is an answer too: nothing is there. Throws roam::Error for a number that
  /// was not expected, was delivered before, or for a world that is stored less exactly than error_limit.
  void deliver(PatchId patch, World world);

  /// Says that what was expected can not come, with the reason for people. Where it refines another, that one stays;
  /// else its box stays solid. It may still be delivered later.
  void fail(PatchId patch, const std::string& reason);

  /// Takes into use what has been delivered. `body` at `place` is where a finer patch must leave room. Returns whether
  /// anything changed.
  bool update(const Body& body, const Vec3& place);

  [[nodiscard]] Impact sweep(const Body& body, const Vec3& from, const Vec3& motion) const override;
  std::size_t contacts(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                       std::span<Contact> contacts) const override;
  using Space::clearance;
  [[nodiscard]] Clearance clearance(const Body& body, const Vec3& from, const Vec3& motion,
                                    double reach) const override;
  [[nodiscard]] Box bounds() const override;
  [[nodiscard]] double largest_error() const override { return error_limit; }
  /// Of what is unknown: why, where fail() said it, else "not loaded yet". A number whose patch has gone gives "".
  [[nodiscard]] std::string object_name(TriangleId triangle) const override;

  [[nodiscard]] PatchworkStats stats() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roam
