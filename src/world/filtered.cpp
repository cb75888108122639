#include "roam/filtered.h"

#include <algorithm>
#include <cmath>

#include "math/finite.h"
#include "math/floating_point.h"
#include "math/mix.h"
#include "world/data.h"
#include "world/query.h"

namespace roam {

Filtered::Filtered(const Space& space) : space_(&space), state_(next_revision()) {}
Filtered::Filtered(LiveSpace& space) : space_(&space), live_(&space), state_(next_revision()) {}

void Filtered::ignore(ObjectId object) {
  if (object == no_object) return;
  const auto at = std::lower_bound(ignored_.begin(), ignored_.end(), object);
  if (at != ignored_.end() && *at == object) return;
  ignored_.insert(at, object);
  state_ = next_revision();
}

void Filtered::stop_ignoring(ObjectId object) {
  const auto at = std::lower_bound(ignored_.begin(), ignored_.end(), object);
  if (at == ignored_.end() || *at != object) return;
  ignored_.erase(at);
  state_ = next_revision();
}

void Filtered::ignore_only(std::span<const ObjectId> objects) {
  std::vector<ObjectId> only(objects.begin(), objects.end());
  std::sort(only.begin(), only.end());
  only.erase(std::unique(only.begin(), only.end()), only.end());
  if (!only.empty() && only.back() == no_object) only.pop_back();
  if (only == ignored_) return;
  ignored_.swap(only);
  state_ = next_revision();
}

void Filtered::ignore_beyond(std::span<const HalfSpace> half_spaces) {
  for (const auto& [normal, distance] : half_spaces) {
    if (!is_finite(normal) || !std::isfinite(distance)) throw Error("a half space to ignore is not finite");
  }
  if (std::equal(half_spaces.begin(), half_spaces.end(), beyond_.begin(), beyond_.end())) return;
  beyond_ = std::vector<HalfSpace>(half_spaces.begin(), half_spaces.end());  // which may be part of beyond_
  state_ = next_revision();
}

bool Filtered::ignores(ObjectId object) const { return ObjectFilter{ignored_, nullptr}.ignores(object); }

bool Filtered::update(const Body& body, const Vec3& place, const Vec3& velocity) {
  const DefaultFloatingPoint guard;
  query::check_update(body, place, velocity);
  return live_ != nullptr && live_->update(body, place, velocity);
}

SpaceFacts Filtered::facts() const {
  SpaceFacts facts = space_->facts();
  if (facts.revision) facts.revision = mix(*facts.revision) + state_;
  return facts;
}

FirstImpact Filtered::find_first(const Query& query, Vicinity* vicinity) const {
  if (ignores_nothing()) return find_first_of(*space_, query, vicinity);
  const ObjectFilter filter = this->filter(query);
  return find_first_of(*space_, {query.body, query.from, query.motion, &filter}, vicinity);
}

void Filtered::find_near(const Query& query, Collector& collector, Vicinity* vicinity) const {
  if (ignores_nothing()) return find_near_of(*space_, query, collector, vicinity);
  const ObjectFilter filter = this->filter(query);
  find_near_of(*space_, {query.body, query.from, query.motion, &filter}, collector, vicinity);
}

}  // namespace roam
