#include "roam/walker.h"

#include "math/floating_point.h"
#include "motion/state.h"

namespace roam {
namespace {

/// The settings, after check().
const WalkerSettings& checked(const WalkerSettings& settings) {
  check(settings);
  return settings;
}

}  // namespace

Walker::Walker(const Space& space, const WalkerSettings& settings, Mode mode, const Vec3& start) {
  const DefaultFloatingPoint guard;
  state_ = std::make_unique<State>(space, checked(settings), mode);
  place(start);
}

Walker::~Walker() = default;
Walker::Walker(const Walker& other) : state_(other.state_ ? std::make_unique<State>(*other.state_) : nullptr) {}
Walker::Walker(Walker&& other) noexcept = default;
Walker& Walker::operator=(Walker&& other) noexcept = default;

Walker& Walker::operator=(const Walker& other) {
  if (this != &other) *this = Walker(other);
  return *this;
}

const StepReport& Walker::step(const WalkerInput& input, double dt) {
  const DefaultFloatingPoint guard;
  return state_->step(input, dt);
}

const StepReport& Walker::place(const Vec3& centre) {
  const DefaultFloatingPoint guard;
  return state_->place(centre, 0.0);
}

const StepReport& Walker::place_feet(const Vec3& feet) {
  const DefaultFloatingPoint guard;
  return state_->place(feet, 0.5);
}

const StepReport& Walker::set_mode(Mode mode) {
  const DefaultFloatingPoint guard;
  return state_->set_mode(mode);
}

void Walker::set_regions(std::span<const SizeRegion> regions) {
  const DefaultFloatingPoint guard;
  state_->set_regions(regions);
}

bool Walker::resize(double radius, double support_radius) {
  const DefaultFloatingPoint guard;
  return state_->resize(radius, support_radius);
}

const Space& Walker::space() const { return *state_->space_; }
const WalkerSettings& Walker::settings() const { return state_->settings_; }
std::span<const SizeRegion> Walker::regions() const { return state_->regions_; }
Mode Walker::mode() const { return state_->mode_; }
const Vec3& Walker::position() const { return state_->at_.place; }
bool Walker::crouched() const { return state_->at_.height < state_->settings_.height; }
bool Walker::grounded() const { return state_->gait_.grounded(); }
const Stance& Walker::stance() const { return state_->gait_; }
bool Walker::held() const { return state_->held(); }
double Walker::rise_speed() const {
  const DefaultFloatingPoint guard;
  const walking::Gait& gait = state_->gait_;
  return gait.grounded() ? gait.rise_speed : gait.rise_speed + gait.ground_velocity.z;
}
const StepReport& Walker::report() const { return state_->report_; }
double Walker::skin() const { return state_->skin_; }
double Walker::fall_limit() const {
  const DefaultFloatingPoint guard;
  return state_->settings_.radius + state_->settings_.step;
}

Body Walker::body() const {
  const DefaultFloatingPoint guard;
  return state_->body();
}

Vec3 Walker::feet() const {
  const DefaultFloatingPoint guard;
  return state_->feet();
}

Vec3 Walker::eye() const {
  const DefaultFloatingPoint guard;
  const WalkerSettings& settings = state_->settings_;
  return state_->feet() + Vec3(0.0, 0.0, settings.eye * (state_->at_.height / settings.height));
}

Vec3 Walker::velocity() const {
  const DefaultFloatingPoint guard;
  return state_->velocity();
}

Vec3 Walker::pace() const {
  const DefaultFloatingPoint guard;
  return state_->pace();
}

}  // namespace roam
