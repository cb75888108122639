#pragma once
/// \file
/// Queries of the tiles in memory and of the unknown cells between them.

#include <optional>

#include "index/roots.h"
#include "store/pager/cells.h"
#include "store/pager/residents.h"
#include "world/query.h"

namespace roam::paging {

/// Adds the roots in all pages that meet the box. Returns false if some are not in memory, or if there are too many.
[[nodiscard]] bool gather(const Residents& residents, const Box& box, index::Roots& out);

/// A scene for world/scene_queries.h.
class PagedScene {
 public:
  enum class What : std::uint8_t {
    everything,
    coming,  ///< unknown items that have not failed
  };
  explicit PagedScene(const Residents& residents, What what = What::everything) : residents_(residents), what_(what) {}
  /// All items, without the triangles beyond the half spaces of a filter, which may be null. The search begins at
  /// `roots` unless that is null.
  PagedScene(const Residents& residents, const index::Roots* roots, const ObjectFilter* ignored)
      : residents_(residents),
        roots_(roots),
        ignored_(ignored != nullptr && ignored->has_beyond() ? ignored : nullptr) {}

  std::optional<double> first(const index::Piece& piece);
  [[nodiscard]] bool name(FirstImpact& first) const;
  [[nodiscard]] Contact touched(const index::Piece& at_rest) const;
  void near(const index::Piece& piece, Collector& collector) const;

 private:
  std::optional<double> first_of_roots(const index::Piece& piece);
  /// Calls use(index of a page), without the ignored triangles.
  template <class Use>
  auto in_rest(const index::Index& page, const Use& use) const;

  const Residents& residents_;
  What what_ = What::everything;
  const index::Roots* roots_ = nullptr;
  const ObjectFilter* ignored_ = nullptr;
  // The result of first().
  bool known_ = false;
  std::uint32_t page_ = 0;
  index::Place place_;
  Box box_;
  TriangleId base_ = 0;
};

/// The index of the triangle or cell that a first impact touches. PagedScene has set its name.
[[nodiscard]] index::Index index_of(const Residents& residents, const FirstImpact& first);

}  // namespace roam::paging
