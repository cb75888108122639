#pragma once
/// \file
/// A space without some of its objects and triangles, for one body: an open door, a layer or a part of a house that
/// the body passes.
///
///     roam::Filtered open(world);
///     open.ignore(door);  // the number of the door's mesh, or Impact::object of a ray that hit it
///     roam::Walker walker(open, settings, roam::Mode::walk, start);
///
/// The promises of space.h hold for the rest. Unknown space is never ignored. A Pager has no numbers of objects, and
/// instances ignore no half space.

#include <cstdint>
#include <span>
#include <vector>

#include "roam/space.h"

namespace roam {

/// Use one for each body: it holds no triangles. Queries may run at the same time, but not during update() or a change.
class Filtered final : public LiveSpace {
 public:
  /// Ignores nothing yet. `space` must outlive this and keep its address. A Filtered made from a Filtered is its copy.
  explicit Filtered(const Space& space);
  explicit Filtered(LiveSpace& space);
  explicit Filtered(Space&& space) = delete;

  /// Ignores an object, or ends that. no_object is never ignored; a number of a Patchwork means that object in every
  /// patch. A body inside an object that is no longer ignored is freed or held by its next step, see Walker::place().
  void ignore(ObjectId object);
  void stop_ignoring(ObjectId object);
  void ignore_only(std::span<const ObjectId> objects);  ///< replaces the set of ignored objects
  [[nodiscard]] bool ignores(ObjectId object) const;
  /// Ignores, too, every triangle whose corners all lie in one of these half spaces; it replaces those of before.
  /// Corners are as stored. A triangle that is only partly in it stays as a whole. Throws roam::Error for values that
  /// are not finite.
  void ignore_beyond(std::span<const HalfSpace> half_spaces);
  [[nodiscard]] std::span<const HalfSpace> beyond() const { return beyond_; }
  [[nodiscard]] const Space& space() const { return *space_; }
  /// Updates the LiveSpace that this was made from; false if it was made from a plain Space.
  bool update(const Body& body, const Vec3& place, const Vec3& velocity) override;
  [[nodiscard]] SpaceFacts facts() const override;
  [[nodiscard]] Object object(TriangleId triangle) const override { return space_->object(triangle); }

 protected:
  [[nodiscard]] FirstImpact find_first(const Query& query, Vicinity* vicinity) const override;
  void find_near(const Query& query, Collector& collector, Vicinity* vicinity) const override;

 private:
  [[nodiscard]] ObjectFilter filter(const Query& query) const { return {ignored_, query.ignored, beyond_}; }
  [[nodiscard]] bool ignores_nothing() const { return ignored_.empty() && beyond_.empty(); }

  const Space* space_;
  LiveSpace* live_ = nullptr;
  std::vector<ObjectId> ignored_;  ///< ascending
  std::vector<HalfSpace> beyond_;
  std::uint64_t state_;  ///< another number after each change, in all of the program
};

}  // namespace roam
