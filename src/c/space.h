#pragma once
/// \file
/// The handle of a space.

#include <functional>
#include <memory>

#include "roam/filtered.h"
#include "roam/pager.h"
#include "roam/roam.h"
#include "roam/space.h"
#include "roam/store.h"
#include "roam/world.h"

namespace roam::c {

/// A pager whose updates can be ended by an exception: follow() has no other way out.
class StoreSpace final : public LiveSpace {
 public:
  StoreSpace(std::shared_ptr<const Store> store, const PagerOptions& options) : pager(std::move(store), options) {}

  bool update(const Body& body, const Vec3& place, const Vec3& velocity) override {
    if (before_update) before_update();
    return pager.update(body, place, velocity);
  }
  [[nodiscard]] SpaceFacts facts() const override { return pager.facts(); }
  [[nodiscard]] Object object(TriangleId triangle) const override { return pager.object(triangle); }

  Pager pager;
  std::function<void()> before_update;  ///< may throw

 protected:
  [[nodiscard]] FirstImpact find_first(const Query& query, Vicinity* vicinity) const override {
    return find_first_of(pager, query, vicinity);
  }
  void find_near(const Query& query, Collector& collector, Vicinity* vicinity) const override {
    find_near_of(pager, query, collector, vicinity);
  }
};

}  // namespace roam::c

struct roam_space {
  std::shared_ptr<const roam::Space> space;  ///< keeps alive what it is made of
  roam::LiveSpace* live = nullptr;           ///< `space`, if it changes
  roam::Filtered* filtered = nullptr;        ///< `space`, if it is one
  const roam::World* world = nullptr;        ///< the triangles of `space`: either these
  roam::c::StoreSpace* store = nullptr;      ///< or these
};
