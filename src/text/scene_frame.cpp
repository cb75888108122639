#include "roam/scene_frame.h"

#include <string>

#include "math/floating_point.h"
#include "roam/error.h"
#include "text/printable.h"

namespace roam {

UpAxis parse_up_axis(std::string_view text) {
  for (std::size_t i = 0; i < up_axis_names.size(); ++i) {
    if (up_axis_names[i] == text) return static_cast<UpAxis>(i);
  }
  throw Error("'" + excerpt(text) + "' is no axis; give x, y, z, -x, -y or -z.");
}

LengthUnit parse_length_unit(std::string_view text) {
  for (std::size_t i = 0; i < length_unit_names.size(); ++i) {
    if (length_unit_names[i] == text) return static_cast<LengthUnit>(i);
  }
  throw Error("'" + excerpt(text) + "' is no unit of length; give m, cm, mm, ft or in.");
}

std::array<std::array<double, 4>, 4> SceneFrame::to_file() const {
  const DefaultFloatingPoint guard;
  const double k = 1.0 / metres_per(unit);
  switch (up) {
    case UpAxis::x:
      return {{{0, 0, k, 0}, {0, k, 0, 0}, {-k, 0, 0, 0}, {0, 0, 0, 1}}};
    case UpAxis::y:
      return {{{k, 0, 0, 0}, {0, 0, k, 0}, {0, -k, 0, 0}, {0, 0, 0, 1}}};
    case UpAxis::z:
      break;
    case UpAxis::minus_x:
      return {{{0, 0, -k, 0}, {0, k, 0, 0}, {k, 0, 0, 0}, {0, 0, 0, 1}}};
    case UpAxis::minus_y:
      return {{{k, 0, 0, 0}, {0, 0, -k, 0}, {0, k, 0, 0}, {0, 0, 0, 1}}};
    case UpAxis::minus_z:
      return {{{k, 0, 0, 0}, {0, -k, 0, 0}, {0, 0, -k, 0}, {0, 0, 0, 1}}};
  }
  return {{{k, 0, 0, 0}, {0, k, 0, 0}, {0, 0, k, 0}, {0, 0, 0, 1}}};
}

}  // namespace roam
