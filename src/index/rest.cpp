#include "index/rest.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/rest.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "index/sweep_traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

Impact FirstImpactOfRest(const Index& index, const Piece& piece, double until) {
  return is_thin(piece.body) ? SweepTraversal<Ray, true>(index, piece, until).run()
                             : SweepTraversal<NoRay, true>(index, piece, until).run();
}

Impact FirstImpactOfRestFrom(const Index& index, std::span<const Root> roots, const Piece& piece, double until) {
  return SweepTraversal<NoRay, true>(index, piece, until).run(roots);
}

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace roam::index {

HWY_EXPORT(FirstImpactOfRest);
HWY_EXPORT(FirstImpactOfRestFrom);

Impact first_impact_of_rest(const Index& index, const Piece& piece, double until) {
  return HWY_DYNAMIC_DISPATCH(FirstImpactOfRest)(index, piece, until);
}

Impact first_impact_of_rest(const Index& index, std::span<const Root> roots, const Piece& piece, double until) {
  return HWY_DYNAMIC_DISPATCH(FirstImpactOfRestFrom)(index, roots, piece, until);
}

}  // namespace roam::index
#endif  // HWY_ONCE
