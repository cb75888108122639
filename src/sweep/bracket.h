#pragma once
/// \file
/// The minimum of a convex function of time, bracketed by samples whose planes bound it from below.

namespace roam::certified {

/// The crossing of the planes of two samples, of which `left` falls and `right` does not. Between the samples the
/// function is at least `distance`. A sample has a `time`, the `distance` there and the `slope` of its plane.
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

/// Narrows a bracket of two samples until `is_tight(lower)`, at most `limit` times. Returns the lower bound between
/// them. `guess(step, lower)` proposes the time of the next sample; a time outside the open bracket is skipped.
/// `sample(time)` evaluates.
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
