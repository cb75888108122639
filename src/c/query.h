#pragma once
/// \file
/// Queries and their results as the structs of roam.h.

#include <span>
#include <vector>

#include "c/space.h"
#include "roam/roam.h"

namespace roam::c {

[[nodiscard]] roam_impact c_of(const Impact& impact);
[[nodiscard]] roam_contact c_of(const Contact& contact);
[[nodiscard]] roam_contact c_of(const Clearance& clearance);

/// Writes into the caller's array, of which each element has its size.
void put_contacts(std::span<const Contact> contacts, roam_contact* to, std::size_t* count);

/// Throws Invalid unless ObjectFilter can search them.
/// Throws Invalid unless they ascend, or if there are any in a store, whose triangles have no object.
void check_ignored(const roam_space& space, std::span<const ObjectId> objects);

/// Space::fits, with a filter: whether the body fits, and what is in the way.
struct Fit {
  Fit(const Space& space, const Query& query)
      : nearest(space.clearance({query.body, query.from, Vec3(0.0), query.ignored}, least_gap)),
        fits(nearest.distance >= least_gap) {}

  static constexpr double least_gap = 1e-6;
  Clearance nearest;
  bool fits;
};

}  // namespace roam::c
