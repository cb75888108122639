#pragma once
/// \file
/// A query of everything that is in memory and of what is not.

#include <optional>

#include "index/roots.h"
#include "store/pager/cells.h"
#include "store/pager/residents.h"
#include "world/query.h"

namespace roam::paging {

/// Adds what of all pages meets the box. False where not all of that is in memory, or is too much.
[[nodiscard]] bool gather(const Residents& residents, const Box& box, index::Roots& out);

/// As world/scene_queries.h asks it.
class PagedScene {
 public:
  enum class What : std::uint8_t {
    everything,
    coming,  ///< what is unknown and has not failed
  };
  explicit PagedScene(const Residents& residents, What what = What::everything) : residents_(residents), what_(what) {}
  /// Of everything, beginning at `roots`, unless that is null.
  PagedScene(const Residents& residents, const index::Roots* roots) : residents_(residents), roots_(roots) {}

  std::optional<double> first(const index::Piece& piece);
  [[nodiscard]] bool name(FirstImpact& first) const;
  [[nodiscard]] Contact touched(const index::Piece& at_rest) const;
  void near(const index::Piece& piece, Collector& collector) const;

 private:
  std::optional<double> first_of_roots(const index::Piece& piece);

  const Residents& residents_;
  What what_ = What::everything;
  const index::Roots* roots_ = nullptr;
  // What first() met.
  bool known_ = false;
  std::uint32_t page_ = 0;
  index::Place place_;
  Box box_;
  TriangleId base_ = 0;
};

/// The index that holds what a first impact touches, which PagedScene has named.
[[nodiscard]] index::Index index_of(const Residents& residents, const FirstImpact& first);

}  // namespace roam::paging
