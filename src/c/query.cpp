// Single queries.
#include "c/query.h"

#include <algorithm>
#include <memory>

#include "c/structs.h"

namespace roam::c {

roam_impact c_of(const Impact& impact) {
  roam_impact result{};
  result.time = impact.time;
  result.gap = impact.distance;
  result.point = c_of(impact.point);
  result.normal = c_of(impact.normal);
  result.triangle = impact.triangle;
  result.object = impact.object;
  result.hit = impact.hit ? 1 : 0;
  result.unknown = impact.unknown ? 1 : 0;
  result.feature = static_cast<std::uint8_t>(impact.feature);
  return result;
}

namespace {

template <class Near>
roam_contact near_of(const Near& near, bool found) {
  roam_contact result{};
  result.gap = near.distance;
  result.point = c_of(near.point);
  result.normal = c_of(near.normal);
  result.triangle = near.triangle;
  result.object = near.object;
  result.found = found ? 1 : 0;
  result.unknown = near.unknown ? 1 : 0;
  result.feature = static_cast<std::uint8_t>(near.feature);
  return result;
}

/// A query of the caller, with its filter.
struct Given {
  Given(const roam_space* space, const roam_query* from)
      : in(needed(space, "the space")), query(given(from, "roam_query")) {
    if (query.ignored_count > 0) (void)needed(query.ignored, "roam_query::ignored");
    filter.objects = {query.ignored, query.ignored_count};
    check_ignored(in, filter.objects);
    it = {{query.radius, query.half_height}, cpp_of(query.from), cpp_of(query.motion), &filter};
  }
  Given(const Given&) = delete;
  Given& operator=(const Given&) = delete;

  const roam_space& in;
  roam_query query;
  ObjectFilter filter;
  Query it;
};

}  // namespace

roam_contact c_of(const Contact& contact) { return near_of(contact, true); }
roam_contact c_of(const Clearance& clearance) { return near_of(clearance, clearance.found); }

void check_ignored(const roam_space& space, std::span<const ObjectId> objects) {
  if (space.store != nullptr && !objects.empty()) {
    throw Invalid("a store has no objects to ignore; leave them out when it is built");
  }
  if (!std::is_sorted(objects.begin(), objects.end())) throw Invalid("the numbers of ignored objects must ascend");
}

void put_contacts(std::span<const Contact> contacts, roam_contact* to, size_t* count) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    at(to, i)->size = to->size;
    put(*at(to, i), c_of(contacts[i]));
  }
  *count = contacts.size();
}

}  // namespace roam::c

using namespace roam::c;

roam_status roam_sweep(const roam_space* space, const roam_query* query, roam_impact* impact) {
  return guarded([&] {
    check_room(impact, "roam_impact");
    const Given asked(space, query);
    put(*impact, c_of(asked.in.space->sweep(asked.it)));
  });
}

roam_status roam_ray(const roam_space* space, roam_vec3 from, roam_vec3 motion, roam_impact* impact) {
  return guarded([&] {
    check_room(impact, "roam_impact");
    put(*impact, c_of(needed(space, "the space").space->ray(cpp_of(from), cpp_of(motion))));
  });
}

roam_status roam_clearance(const roam_space* space, const roam_query* query, double reach, roam_contact* nearest) {
  return guarded([&] {
    check_room(nearest, "roam_contact");
    const Given asked(space, query);
    put(*nearest, c_of(asked.in.space->clearance(asked.it, reach)));
  });
}

roam_status roam_contacts(const roam_space* space, const roam_query* query, double reach, roam_contact* contacts,
                          size_t capacity, size_t* count) {
  return guarded([&] {
    (void)needed(count, "the address for the number of contacts");
    if (capacity > 0) check_room(contacts, "roam_contact");
    std::vector<roam::Contact> found(capacity);
    const Given asked(space, query);
    const std::size_t n = asked.in.space->contacts(asked.it, reach, found);
    put_contacts(std::span(found).first(n), contacts, count);
  });
}

roam_status roam_fits(const roam_space* space, const roam_query* query, int32_t* fits) {
  return guarded([&] {
    (void)needed(fits, "the address for the result");
    const Given asked(space, query);
    *fits = Fit(*asked.in.space, asked.it).fits ? 1 : 0;
  });
}
