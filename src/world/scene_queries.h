#pragma once
/// \file
/// How queries of a whole way are put together from those of its pieces, whatever holds the tiles.
///
/// A scene answers, for one piece:
///
///     std::optional<double> first(const index::Piece&);      // the time of the first impact, of which it remembers
///     Contact touched(const index::Piece& at_rest) const;    // the contact, seen from a place
///     void near(const index::Piece&, Collector&) const;      // offers everything within the collector's reach

#include <algorithm>
#include <optional>

#include "world/pieces.h"
#include "world/query.h"

namespace roam::query {

template <class Scene>
void collect_of(const Scene& scene, const Way& way, Collector& collector) {
  const Pieces pieces(way);
  for (int i = 0; i < pieces.count(); ++i) scene.near(pieces[i], collector);
}

/// The first impact on the way; `time` is that of the whole motion.
template <class Scene>
[[nodiscard]] Impact impact_of(Scene& scene, const Way& way) {
  const Pieces pieces(way);
  Impact result;
  for (int i = 0; i < pieces.count(); ++i) {
    const std::optional<double> time = scene.first(pieces[i]);
    if (!time) continue;
    result.hit = true;
    result.time = pieces.time(i, *time);
    const Way at_rest{way.body, way.from + way.motion * result.time, Vec3(0.0)};
    Contact touched = scene.touched({at_rest.body, at_rest.from, Vec3(0.0)});
    if (result.time == 0.0) {  // touching or embedded: name the deepest
      Collector deepest(std::max(0.0, touched.distance), {&touched, 1}, false);
      collect_of(scene, at_rest, deepest);
    } else {
      touched.distance = std::max(0.0, touched.distance);  // `time` is certified free: only rounding can say less
    }
    result.point = touched.point;
    result.normal = touched.normal;
    result.feature = touched.feature;
    result.triangle = touched.triangle;
    result.distance = touched.distance;
    result.unknown = touched.unknown;
    break;
  }
  return result;
}

}  // namespace roam::query
