#pragma once
/// \file
/// The queries of the benchmarks, made from the scene with a fixed seed: four sets of sweeps, two of rays, one of
/// nearest points.
///
///     set       body                             motion                               start
///     random    sphere, r 0.2-1 m                0.05-2 m, any direction              within 3 m of a surface
///     coherent  sphere, r 0.3-0.5 m, 100 walkers 1.5-50 m/s at 60 Hz, turning at hits where the last step ended
///     long      sphere, r 0.2-1 m                50 m, any direction                  within 3 m of a surface
///     capsule   r 0.3 m, height 1.8 m            0.05-2 m, any direction              within 3 m of a surface
///     rays      point                            50 m, any direction                  within 3 m of a surface
///     walkrays  point                            50 m, ahead of the walker            those of coherent
///     nearest   point                            none                                 those of coherent
///
/// All ranges are uniform. A start is a random point of a random triangle, moved by 0-3 m in a random direction, on
/// either side of the surface. All triangles are equally likely, so queries are dense where the detail is. A start
/// needs free space within radius + 1 mm, so no query starts embedded. Walkers start where walls are all around, if the
/// scene has such places. They stay within 3 m of a surface and keep 5 mm off.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "query.h"
#include "reference.h"

namespace roam::bench {

/// "random", "coherent", "long", "capsule".
[[nodiscard]] const std::vector<std::string>& query_set_names();

/// "rays", "walkrays", "nearest".
[[nodiscard]] const std::vector<std::string>& point_set_names();

/// `count` queries; the same for the same scene, name and count. Throws roam::Error for an unknown name, and for a
/// scene without room for the body.
[[nodiscard]] QuerySet make_queries(const std::string& name, std::size_t count, const Reference& reference);

}  // namespace roam::bench
