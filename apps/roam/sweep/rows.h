#pragma once
/// \file
/// The rows of `roam sweep`, as comma-separated values: queries and results.

#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

#include "roam/sweep.h"
#include "roam/world.h"

namespace roam::app {

/// One query: `x,y,z,dx,dy,dz,radius[,half_height]`, all in metres.
struct SweepQuery {
  Vec3 from{0.0};
  Vec3 motion{0.0};
  Body body;
};

/// The header of the results.
inline constexpr std::string_view answer_header = "hit,t,px,py,pz,nx,ny,nz,triangle,feature,distance\n";

/// Whether the row names columns instead of holding numbers. Throws roam::Error if the names or their order are wrong.
[[nodiscard]] bool is_query_header(std::string_view row);

/// Whether the row has only blanks.
[[nodiscard]] bool is_blank(std::string_view row);

/// Reads one row. Throws roam::Error with the invalid field; the caller adds the line.
[[nodiscard]] SweepQuery parse_query(std::string_view row);

/// Appends one row. 17 significant digits preserve every double. A miss has t = 1 and a distance; its point and normal
/// are zeros, its triangle is -1 and its feature `none`. A hit on unknown space has the triangle -1 and the feature
/// `unknown`.
void append_answer(std::string& rows, const Impact& answer);

}  // namespace roam::app
