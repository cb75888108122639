#pragma once
/// \file
/// A query of everything that is in memory and of what is not.

#include <optional>

#include "store/pager/cells.h"
#include "store/pager/residents.h"
#include "world/query.h"

namespace roam::paging {

/// As world/scene_queries.h asks it.
class PagedScene {
 public:
  enum class What : std::uint8_t {
    everything,
    coming,  ///< what is unknown and has not failed
  };
  explicit PagedScene(const Residents& residents, What what = What::everything) : residents_(residents), what_(what) {}

  std::optional<double> first(const index::Piece& piece);
  [[nodiscard]] Contact touched(const index::Piece& at_rest) const;
  void near(const index::Piece& piece, query::Collector& collector) const;

 private:
  const Residents& residents_;
  What what_;
  // What first() met.
  bool known_ = false;
  std::uint32_t page_ = 0;
  index::Place place_;
  Box box_;
  TriangleId base_ = 0;
};

}  // namespace roam::paging
