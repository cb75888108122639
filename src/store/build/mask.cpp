#include "store/build/mask.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/largest.h"

namespace roam::store {
namespace {

/// The axes that may separate a triangle from a box of half size h, except the box's own (Akenine-Möller, "Fast 3D
/// triangle-box overlap testing", 2001).
class Separation {
 public:
  Separation(const Triangle& t, const Vec3& h) {
    const Vec3 edge[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    add(glm::cross(edge[0], edge[1]), t, h);
    for (const Vec3& e : edge) {
      add({0.0, -e.z, e.y}, t, h);
      add({e.z, 0.0, -e.x}, t, h);
      add({-e.y, e.x, 0.0}, t, h);
    }
  }

  /// Whether the box around `centre` may touch the triangle.
  [[nodiscard]] bool touches(const Vec3& centre) const {
    for (const Axis& axis : axes_) {
      const double at = glm::dot(axis.direction, centre);
      if (at < axis.lower || at > axis.upper) return false;
    }
    return true;
  }

 private:
  struct Axis {
    Vec3 direction;
    double lower, upper;  ///< range along it of the centres of touching boxes
  };

  void add(const Vec3& d, const Triangle& t, const Vec3& h) {
    const double reach = std::abs(d.x) * h.x + std::abs(d.y) * h.y + std::abs(d.z) * h.z;
    const double a = glm::dot(d, t[0]), b = glm::dot(d, t[1]), c = glm::dot(d, t[2]);
    axes_[count_++] = {d, std::min({a, b, c}) - reach, std::max({a, b, c}) + reach};
  }

  std::array<Axis, 10> axes_;
  std::size_t count_ = 0;
};

}  // namespace

Mask::Mask(const Box& box, double margin) : lower_(box.lower) {
  const Vec3 size = box.size();
  // The computations below round by less than 2^-40 of their coordinates.
  const double far = std::max(largest(box.lower), largest(box.upper));
  margin_ = margin + 0x1p-30 * largest(size) + 0x1p-50 * far;
  cell_ = size / double(mask_cells);
  half_ = 0.5 * cell_ + margin_;
  for (int k = 0; k < 3; ++k) per_metre_[k] = size[k] > 0.0 ? double(mask_cells) / size[k] : 0.0;
}

void Mask::add(const Triangle& triangle) {
  const Triangle t{triangle[0] - lower_, triangle[1] - lower_, triangle[2] - lower_};
  int first[3], last[3], cells = 1;
  for (int k = 0; k < 3; ++k) {
    const double lower = std::min({t[0][k], t[1][k], t[2][k]}) - margin_;
    const double upper = std::max({t[0][k], t[1][k], t[2][k]}) + margin_;
    const auto cell = [&](double at) {
      return static_cast<int>(std::clamp(at * per_metre_[k], 0.0, double(mask_cells - 1)));
    };
    first[k] = cell(lower);
    last[k] = cell(upper);
    cells *= last[k] - first[k] + 1;
  }
  if (cells == 1) {
    set(first[0], first[1], first[2]);
    return;
  }
  const Separation separation(t, half_);
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const Vec3 centre = cell_ * Vec3(x + 0.5, y + 0.5, z + 0.5);
        if (cells == 2 || separation.touches(centre)) set(x, y, z);
      }
    }
  }
}

}  // namespace roam::store
