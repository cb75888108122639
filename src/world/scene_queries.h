#pragma once
/// \file
/// How queries of a whole way are put together from those of its pieces, whatever holds the tiles.
///
/// A scene answers, for one piece:
///
///     std::optional<double> first(const index::Piece&);      // the time of the first impact, of which it remembers
///     bool name(FirstImpact&) const;                         // that: the triangle, and where; false where it cannot
///     Contact touched(const index::Piece& at_rest) const;    // that: the contact, seen from a place
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

/// What a hit touches at its time, which is measured here where the scene cannot find it again or where the body starts
/// in touch.
template <class Scene>
[[nodiscard, gnu::noinline]] Contact touched_of(const Scene& scene, const Query& query, double time) {
  const Query at_rest{query.body, query.from + query.motion * time, Vec3(0.0), query.ignored};
  Contact touched = scene.touched({at_rest.body, at_rest.from, at_rest.motion});
  if (time == 0.0) {  // touching or embedded: name the deepest
    Collector deepest(Collector::Kind::contacts, std::max(0.0, touched.distance), {&touched, 1});
    collect_of(scene, at_rest, {}, deepest);
  }
  return touched;
}

/// The first impact on the way; `time` is that of the whole motion.
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
