#pragma once
/// \file
/// An index without the triangles that a filter ignores.

#include "index/traverse.h"
#include "world/data.h"
#include "world/query.h"

namespace roam::query {

/// Refers to the filter and the world; its index is valid as long as it lives.
class Remaining {
 public:
  /// `objects`: the world of the index; null if its triangles have no objects.
  Remaining(const index::Index& whole, const ObjectFilter& ignored, const WorldData* objects)
      : objects_(objects), ignored_(ignored), has_beyond_(ignored.has_beyond()), index_(whole) {
    index_.skip = &skip_;
  }
  Remaining(const Remaining&) = delete;
  Remaining& operator=(const Remaining&) = delete;

  [[nodiscard]] const index::Index& index() const { return index_; }

 private:
  static bool skips(const void* self, const index::Place& place) {
    const Remaining& r = *static_cast<const Remaining*>(self);
    if (r.objects_ != nullptr && r.ignored_.ignores(r.objects_->object(number_at(r.index_, place)))) return true;
    if (!r.has_beyond_) return false;
    const auto& [a, b, c] = index::local_triangle(r.index_, place, Vec3(0.0)).corner;
    return r.ignored_.ignores(Triangle{a, b, c});
  }

  const WorldData* objects_;
  const ObjectFilter& ignored_;
  bool has_beyond_;
  index::Skip skip_{&Remaining::skips, this};
  index::Index index_;
};

}  // namespace roam::query
