#pragma once
/// \file
/// The rows of `roam sweep`: queries in, answers out, as comma-separated values.

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

/// The header of the answers.
inline constexpr std::string_view answer_header = "hit,t,px,py,pz,nx,ny,nz,triangle,feature,distance\n";

/// The row names the columns instead of holding numbers. Throws roam::Error when it names others, or in another order,
/// than a query has.
[[nodiscard]] bool is_query_header(std::string_view row);

/// Nothing but blanks.
[[nodiscard]] bool is_blank(std::string_view row);

/// Reads one row. Throws roam::Error that says which field is wrong; the caller knows the line.
[[nodiscard]] SweepQuery parse_query(std::string_view row);

/// Appends one row: 17 significant digits, so that every double reads back as it was. Of a miss only t (always 1) and
/// distance mean something; its point and normal are zeros, its triangle is -1 and its feature `none`. Of a hit that is
/// unknown the triangle is -1 and the feature `unknown`.
void append_answer(std::string& rows, const Impact& answer);

}  // namespace roam::app
