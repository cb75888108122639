#pragma once
/// \file
/// The least of a convex function of time, from samples that each bring a plane which bounds it from below.

namespace roam::certified {

/// Where the planes of two samples cross, the left falling and the right not: between them nothing is less than
/// `distance`. A sample has a `time`, the `distance` there and the `slope` of its plane.
struct Crossing {
  template <class Sample>
  Crossing(const Sample& left, const Sample& right) {
    const double fall = -left.slope, rise = right.slope, width = right.time - left.time;
    time = left.time + (left.distance - right.distance + rise * width) / (fall + rise);
    distance = (left.distance * rise + right.distance * fall - fall * rise * width) / (fall + rise);
  }

  double time;
  double distance;
};

/// Narrows a bracket of two samples until `is_tight(lower)` or `limit` times, and returns the lower bound between them.
/// `guess(step, lower)` is where to look next; a time that is not inside of the bracket is left out. `sample(time)`
/// looks.
template <class Sample, class Look, class Guess, class IsTight>
Crossing narrow(Sample& left, Sample& right, int limit, const Look& sample, const Guess& guess,
                const IsTight& is_tight) {
  Crossing lower(left, right);
  for (int step = 0; step < limit; ++step) {
    if (is_tight(lower)) break;
    const double time = guess(step, lower);
    if (!(left.time < time && time < right.time)) continue;
    const Sample s = sample(time);
    (s.slope < 0.0 ? left : right) = s;
    lower = Crossing(left, right);
  }
  return lower;
}

}  // namespace roam::certified
