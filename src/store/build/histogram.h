#pragma once
/// \file
/// The numbers of triangles of a part in cells of the curve.

#include <span>

#include "store/build/run.h"
#include "store/part.h"

namespace roam::store {

/// Depends on the triangles only, not on their division into runs. Never has more than some 2^20 cells.
class Histogram {
 public:
  /// Items ascending by key.
  void add(std::span<const RunItem> items);
  /// Sets the cells of the part, as fine as possible. The largest number of cells is one for 2048 triangles, but from
  /// 256 to 2^18.
  void finish(PartFile& part);

 private:
  void coarsen(std::size_t most);

  int bits_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace roam::store
