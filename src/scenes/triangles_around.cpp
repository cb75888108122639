#include "scenes/triangles_around.h"

#include <algorithm>

#include "roam/error.h"

namespace roam::app {
namespace {

constexpr double least_reach = 0.5;  // m: no search is smaller

/// Thrown if there are too many triangles.
struct Enough {};

}  // namespace

bool triangles_in(const Store& store, const Box& box, std::size_t most, const std::function<bool()>& goes_on,
                  StoreTriangles& into) {
  into.triangles.clear();
  into.triangles.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(most, store.info().triangles)));
  into.missing.clear();
  into.box = box;
  const auto take = [&](std::span<const Triangle> triangles, std::span<const TriangleId>) {
    if (!goes_on()) throw Cancelled();
    if (into.triangles.size() + triangles.size() > most) throw Enough();
    into.triangles.insert(into.triangles.end(), triangles.begin(), triangles.end());
  };
  try {
    store.for_each_triangle(box, take, [&](const std::string& what) {
      if (!goes_on()) throw Cancelled();
      into.missing.push_back(what);
    });
  } catch (const Enough&) {
    return false;
  }
  return true;
}

StoreTriangles triangles_around(const Store& store, const Vec3& place, double reach, std::size_t most,
                                const std::function<bool()>& goes_on) {
  StoreTriangles found;
  while (!triangles_in(store, {place - reach, place + reach}, most, goes_on, found) && reach > least_reach)
    reach *= 0.5;
  return found;
}

}  // namespace roam::app
