#include "scenes/arrivals.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <thread>
#include <utility>

#include "cli/tell.h"

namespace roam::app {
namespace {

/// Seconds of one wait.
constexpr double slice = 0.02;

/// Seconds without an arrival and without a read after which no more will arrive: if memory is full, and if it is not,
/// which a busy machine needs.
constexpr double full_after = 0.1, idle_after = 5.0;

/// m/s. A pager counts on this speed at least.
constexpr double least_pace = 4.0;

/// Factor by which a reach that did not fit into memory grows again with each wait.
constexpr double recovery = 1.01;

double age(std::chrono::steady_clock::time_point event) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - event).count();
}

}  // namespace

Arrivals::Arrivals(Pager& pager, double stuck) : pager_(pager), stuck_(stuck), loads_(pager.stats().loads) {}

bool Arrivals::wait(const Body& body, const Vec3& place, const Vec3& velocity, double within) {
  settled_ = pager_.wait(body, place, velocity, slice, within);
  if (settled_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const PagerStats now = pager_.stats();
  if (now.loads != loads_) last_ = Clock::now();
  if (now.loads != loads_ || now.reading > 0) read_ = Clock::now();
  loads_ = now.loads;
  return !settled_ && !stuck() && age(read_) < (now.full ? full_after : idle_after);
}

double Arrivals::silence() const { return age(last_); }

TilesAround::TilesAround(Pager& pager, std::function<bool()> goes_on, double stuck)
    : pager_(pager), goes_on_(std::move(goes_on)), stuck_(stuck) {}

/// Whether tiles have failed that a web server may still send: the pager tries them again.
bool TilesAround::failed_may_come() {
  const std::uint64_t now = pager_.stats().failed_may_pass;
  lost_ = std::min(lost_, now);
  return now > lost_;
}

void TilesAround::wait(const Body& body, const Vec3& place, const Vec3& velocity, double reach) {
  const double speed = glm::length(velocity), within = std::min(std::max(reach, ahead * speed), fits_);
  const double pace = std::max({speed, within / ahead, least_pace});
  const Vec3 heading = speed > 0.0 ? velocity / speed : Vec3(1.0, 0.0, 0.0);
  if (pager_.wait(body, place, pace * heading, slice, within / pace) && !failed_may_come()) {
    fits_ *= recovery;
    return;
  }
  if (pager_.stats().loads == stuck_at_) return;
  Arrivals arrivals(pager_, stuck_);
  const auto more_may_come = [&] {
    return arrivals.wait(body, place, pace * heading, within / pace) ||
           (arrivals.settled() && failed_may_come() && !arrivals.stuck());
  };
  while (goes_on_() && more_may_come()) {
  }
  if (!goes_on_() || (arrivals.settled() && !failed_may_come())) return;
  const PagerStats now = pager_.stats();
  if (!arrivals.stuck()) {
    if (now.full) fits_ = 0.5 * within;
    return;
  }
  stuck_at_ = now.loads;
  lost_ = now.failed_may_pass;
  tell(fmt::format("note: nothing has come from {} for {:g} s; it is no longer waited for, and stays solid",
                   pager_.store().name(), stuck_));
}

}  // namespace roam::app
