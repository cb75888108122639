#pragma once
/// \file
/// Points of a circle without the mathematics library, whose last bits differ between machines.

namespace roam::generate {

struct CirclePoint {
  double cosine, sine;
};

/// The point of the unit circle at `turn` full turns, 0 <= turn <= 1. Uses Taylor series about the nearest multiple of
/// a quarter turn; the error is less than 1e-15.
[[nodiscard]] inline CirclePoint circle(double turn) {
  const int quarter = static_cast<int>(turn * 4.0 + 0.5);  // nearest multiple of a quarter turn
  constexpr double full = 6.283185307179586;
  const double x = (turn - 0.25 * quarter) * full, q = x * x;  // |x| <= pi / 4
  const double s =
      x *
      (1.0 -
       q / 6.0 *
           (1.0 - q / 20.0 *
                      (1.0 - q / 42.0 * (1.0 - q / 72.0 * (1.0 - q / 110.0 * (1.0 - q / 156.0 * (1.0 - q / 210.0)))))));
  const double c =
      1.0 -
      q / 2.0 *
          (1.0 -
           q / 12.0 * (1.0 - q / 30.0 * (1.0 - q / 56.0 * (1.0 - q / 90.0 * (1.0 - q / 132.0 * (1.0 - q / 182.0))))));
  switch (quarter & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace roam::generate
