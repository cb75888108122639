#include "generate/axis.h"

#include <cmath>

namespace roam::generate {
namespace {

double length_in_plan(const Vec3& d) { return std::sqrt(d.x * d.x + d.y * d.y); }

Vec3 level_direction(const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length = length_in_plan(d);
  return {d.x / length, d.y / length, 0.0};
}

Vec3 square_left(const Vec3& ahead) { return {-ahead.y, ahead.x, 0.0}; }

}  // namespace

Axis::Axis(const Vec3& a, const Vec3& b)
    : start_(a), ahead1_(level_direction(a, b)), ahead2_(ahead1_), corner_point_(b), corner_(length_in_plan(b - a)) {}

Axis::Axis(const Vec3& a, const Vec3& b, const Vec3& c, double blend)
    : start_(a),
      ahead1_(level_direction(a, b)),
      ahead2_(level_direction(b, c)),
      corner_point_(b),
      corner_(length_in_plan(b - a)),
      length2_(length_in_plan(c - b)),
      blend_(blend) {
  const double cosine = ahead1_.x * ahead2_.x + ahead1_.y * ahead2_.y;
  const double sine = ahead1_.x * ahead2_.y - ahead1_.y * ahead2_.x;
  half_tangent_ = sine / (1.0 + cosine);
}

Vec3 Axis::left(double station) const { return square_left(ahead(station)); }

Axis::Frame Axis::frame(double station) const {
  const bool first = station <= corner_;
  const Vec3 along = ahead(station);
  const Vec3 base = first ? start_ : corner_point_;
  const double s = first ? station : station - corner_;
  Vec3 left = square_left(along);
  const double to_corner = std::fabs(station - corner_);
  if (half_tangent_ != 0.0 && to_corner < blend_) {
    const double shear = half_tangent_ * (1.0 - to_corner / blend_);
    left += along * (first ? -shear : shear);
  }
  return {{base.x + along.x * s, base.y + along.y * s, 0.0}, left};
}

Axis::Place Axis::place(double x, double y) const {
  const double dx = x - corner_point_.x, dy = y - corner_point_.y;
  const bool first = dx * (ahead1_.x + ahead2_.x) + dy * (ahead1_.y + ahead2_.y) <= 0.0;
  const Vec3& along = first ? ahead1_ : ahead2_;
  const double offset = dy * along.x - dx * along.y;
  const double s = dx * along.x + dy * along.y;
  return {corner_ + s + (first ? offset : -offset) * half_tangent_, offset};
}

}  // namespace roam::generate
