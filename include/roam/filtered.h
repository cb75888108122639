#pragma once
/// \file
/// A space without some of its objects, as one body meets it: a door that stands open for it, a layer that it passes.
///
///     roam::Filtered open(world);
///     open.ignore(door);  // the number of the door's mesh, or Impact::object of a ray that met it
///     roam::Walker walker(open, settings, roam::Mode::walk, start);
///
/// All promises of space.h hold for what is left. What is unknown is never ignored, and the triangles of a Pager have
/// no numbered objects: there nothing is.

#include <cstdint>
#include <span>
#include <vector>

#include "roam/space.h"

namespace roam {

/// Bodies that ignore different objects of one space have a Filtered each; it holds no triangles. Queries may run at
/// the same time, but not during a change of what is ignored.
class Filtered final : public LiveSpace {
 public:
  /// `space` must outlive it and stay where it is. Nothing is ignored yet.
  explicit Filtered(const Space& space);
  /// The same, and update() updates it.
  explicit Filtered(LiveSpace& space);
  explicit Filtered(Space&& space) = delete;
  // A copy is of the same space and ignores the same: so is a Filtered that is made of a Filtered.

  /// From now on queries pass over this object, or meet it again. A walker follows with its next step; one that stands
  /// inside a door that is met again is freed or held (Walker::place). no_object is never ignored. A Patchwork numbers
  /// the objects of each patch: there the same number is passed over in every patch.
  void ignore(ObjectId object);
  void stop_ignoring(ObjectId object);
  /// Ignores these objects and no others.
  void ignore_only(std::span<const ObjectId> objects);
  [[nodiscard]] bool ignores(ObjectId object) const;
  [[nodiscard]] const Space& space() const { return *space_; }

  /// That of the space which it was made of; false where that is no LiveSpace.
  bool update(const Body& body, const Vec3& place, const Vec3& velocity) override;

  [[nodiscard]] SpaceFacts facts() const override;
  [[nodiscard]] Object object(TriangleId triangle) const override { return space_->object(triangle); }

 protected:
  [[nodiscard]] FirstImpact ask_first(const Query& query, Vicinity* vicinity) const override;
  void ask_near(const Query& query, Collector& collector, Vicinity* vicinity) const override;

 private:
  [[nodiscard]] ObjectFilter filter(const Query& query) const { return {ignored_, query.ignored}; }

  const Space* space_;
  LiveSpace* live_ = nullptr;
  std::vector<ObjectId> ignored_;  ///< ascending
  std::uint64_t state_;            ///< another number after each change, in all of the program
};

}  // namespace roam
