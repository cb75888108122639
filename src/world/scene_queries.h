#pragma once
/// \file
/// Queries of a whole motion, composed of queries of its pieces, for any holder of tiles.
///
/// A Scene has these members for one piece:
///
///     std::optional<double> first(const index::Piece&);      // time of the first impact, which the scene remembers
///     bool name(FirstImpact&) const;                         // sets its triangle and object; false if it cannot
///     Contact touched(const index::Piece& at_rest) const;    // its contact, for a body at rest
///     void near(const index::Piece&, Collector&) const;      // offers everything within the collector's reach

#include <algorithm>
#include <optional>

#include "world/pieces.h"
#include "world/query.h"

namespace roam::query {

template <class Scene>
void collect_of(const Scene& scene, const Query& query, const Part& part, Collector& collector) {
  const Pieces pieces(query, part);
  for (int i = 0; i < pieces.count(); ++i) scene.near(pieces[i], collector);
}

/// The contact of a hit at its time. Measured here if the scene cannot find it again, or if the body starts in touch.
template <class Scene>
[[nodiscard, gnu::noinline]] Contact touched_of(const Scene& scene, const Query& query, double time) {
  const Query at_rest{query.body, query.from + query.motion * time, Vec3(0.0), query.ignored};
  Contact touched = scene.touched({at_rest.body, at_rest.from, at_rest.motion});
  if (time == 0.0) {  // touching or embedded: the deepest contact is wanted
    Collector deepest(Collector::Kind::contacts, std::max(0.0, touched.distance), {&touched, 1});
    collect_of(scene, at_rest, {}, deepest);
  }
  return touched;
}

/// The first impact during the motion; `time` refers to the whole motion.
template <class Scene>
[[nodiscard]] FirstImpact first_of(Scene& scene, const Query& query, const Part& part = {}) {
  const Pieces pieces(query, part);
  FirstImpact first;
  for (int i = 0; i < pieces.count() && !first.hit; ++i) {
    const std::optional<double> time = scene.first(pieces[i]);
    if (!time) continue;
    first.hit = true;
    first.time = pieces.time(i, *time);
    if (first.time > 0.0 && scene.name(first)) return first;
    first.contact = touched_of(scene, query, first.time);
    first.triangle = first.contact->triangle;
    first.unknown = first.contact->unknown;
  }
  return first;
}

}  // namespace roam::query
