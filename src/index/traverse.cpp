#include "index/traverse.h"

#include <cassert>
#include <cmath>

#include "math/largest.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/traverse.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "index/gather-inl.h"
#include "index/near_traversal-inl.h"
#include "index/sweep_traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

Impact FirstImpact(const Index& index, const Piece& piece, double until) {
  return is_thin(piece.body) ? SweepTraversal<Ray>(index, piece, until).run()
                             : SweepTraversal<NoRay>(index, piece, until).run();
}

/// Runs the traversal with the bounds that suit.
template <class... Roots>
double VisitNearWith(const Index& index, const Piece& piece, const Near& near, Visit visit, void* context,
                     const Roots&... roots) {
  if (near.part > 0.0) return NearTraversal<Slack>(index, piece, near, visit, context).run(roots...);
  return std::isinf(near.highest) ? NearTraversal<Tight>(index, piece, near, visit, context).run(roots...)
                                  : NearTraversal<Layer>(index, piece, near, visit, context).run(roots...);
}

double VisitNear(const Index& index, const Piece& piece, const Near& near, Visit visit, void* context) {
  return VisitNearWith(index, piece, near, visit, context);
}

bool Gather(const Index& index, std::uint32_t owner, const Box& box, Roots& out) {
  return Gathering(index, owner, box, out).run();
}

Impact FirstImpactFrom(const Index& index, std::span<const Root> roots, const Piece& piece, double until) {
  assert(!is_thin(piece.body) && roam::largest(piece.motion) <= double(short_motion));
  return SweepTraversal<NoRay>(index, piece, until).run(roots);
}

double VisitNearFrom(const Index& index, std::span<const Root> roots, const Piece& piece, const Near& near, Visit visit,
                     void* context) {
  return VisitNearWith(index, piece, near, visit, context, roots);
}

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace roam::index {

HWY_EXPORT(FirstImpact);
HWY_EXPORT(VisitNear);
HWY_EXPORT(Gather);
HWY_EXPORT(FirstImpactFrom);
HWY_EXPORT(VisitNearFrom);

Impact first_impact(const Index& index, const Piece& piece, double until) {
  return HWY_DYNAMIC_DISPATCH(FirstImpact)(index, piece, until);
}

double visit_near(const Index& index, const Piece& piece, const Near& near, Visit visit, void* context) {
  return HWY_DYNAMIC_DISPATCH(VisitNear)(index, piece, near, visit, context);
}

bool gather(const Index& index, std::uint32_t owner, const Box& box, Roots& out) {
  return HWY_DYNAMIC_DISPATCH(Gather)(index, owner, box, out);
}

Impact first_impact(const Index& index, std::span<const Root> roots, const Piece& piece, double until) {
  return HWY_DYNAMIC_DISPATCH(FirstImpactFrom)(index, roots, piece, until);
}

double visit_near(const Index& index, std::span<const Root> roots, const Piece& piece, const Near& near, Visit visit,
                  void* context) {
  return HWY_DYNAMIC_DISPATCH(VisitNearFrom)(index, roots, piece, near, visit, context);
}

}  // namespace roam::index
#endif  // HWY_ONCE
