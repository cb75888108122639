#pragma once
/// \file
/// Counts the triangles of a scene's parts in cells of the curve.

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "store/build/divide.h"
#include "store/build/intake.h"
#include "store/build/work.h"

namespace roam::store {

/// See Refine. The cells are those of the part's file, or narrower ones that are counted in the part's runs.
class PartCells {
 public:
  PartCells(Work& work, const std::vector<PartRecord>& parts) : work_(work), parts_(parts), cell_bits_(parts.size()) {}

  /// Throws roam::Error for files that cannot be read, and if the parts that were counted as a whole have more
  /// triangles than any scene.
  std::vector<PartCell> operator()(std::uint32_t part, const CurveCell& cell);
  /// Parts without runs that had to be counted in them. Each such cell counts as one triangle.
  [[nodiscard]] const std::set<std::size_t>& unread() const { return unread_; }

 private:
  std::optional<std::vector<PartCell>> in_file(std::uint32_t part, const CurveCell& cell);
  std::vector<PartCell> in_runs(std::uint32_t part, const CurveCell& cell);

  Work& work_;
  const std::vector<PartRecord>& parts_;
  std::vector<int> cell_bits_;  ///< of each part's file, once it was read; else 0
  std::set<std::size_t> unread_;
  std::uint64_t triangles_ = 0;  ///< of the parts that were counted as a whole
};

}  // namespace roam::store
