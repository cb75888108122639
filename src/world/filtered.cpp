#include "roam/filtered.h"

#include <algorithm>

#include "math/mix.h"

namespace roam {

void Filtered::ignore(ObjectId object) {
  const auto at = std::lower_bound(ignored_.begin(), ignored_.end(), object);
  if (at != ignored_.end() && *at == object) return;
  ignored_.insert(at, object);
  ++changes_;
}

void Filtered::stop_ignoring(ObjectId object) {
  const auto at = std::lower_bound(ignored_.begin(), ignored_.end(), object);
  if (at == ignored_.end() || *at != object) return;
  ignored_.erase(at);
  ++changes_;
}

void Filtered::ignore_only(std::span<const ObjectId> objects) {
  std::vector<ObjectId> only(objects.begin(), objects.end());
  std::sort(only.begin(), only.end());
  only.erase(std::unique(only.begin(), only.end()), only.end());
  if (only == ignored_) return;
  ignored_.swap(only);
  ++changes_;
}

bool Filtered::ignores(ObjectId object) const { return ObjectFilter{ignored_, nullptr}.ignores(object); }

bool Filtered::update(const Body& body, const Vec3& place, const Vec3& velocity) {
  return live_ != nullptr && live_->update(body, place, velocity);
}

SpaceFacts Filtered::facts() const {
  SpaceFacts facts = space_->facts();
  if (facts.revision) facts.revision = mix(*facts.revision) + changes_;
  return facts;
}

FirstImpact Filtered::ask_first(const Query& query, Vicinity* vicinity) const {
  const ObjectFilter filter = this->filter(query);
  return ask_first_of(*space_, {query.body, query.from, query.motion, &filter}, vicinity);
}

void Filtered::ask_near(const Query& query, Collector& collector, Vicinity* vicinity) const {
  const ObjectFilter filter = this->filter(query);
  ask_near_of(*space_, {query.body, query.from, query.motion, &filter}, collector, vicinity);
}

}  // namespace roam
