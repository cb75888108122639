#include "osgRoam/Manipulator.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "math/finite.h"
#include "osgRoam/Triangles.h"
#include "osgroam/manipulator_state.h"
#include "text/number.h"

namespace osgRoam {
namespace {

/// Greatest deviation of the length of a graph's float normal from 1.
constexpr double unit_tolerance = 1e-3;

void demand_finite(double sum, const char* what) {
  if (!std::isfinite(sum)) throw roam::Error(std::string(what) + " is not a finite number");
}

void demand_place(const roam::Vec3& place, const char* what) {
  if (!roam::is_within_limit(place))
    throw roam::Error(std::string(what) + " is not a point within 1e9 m of the origin");
}

}  // namespace

Manipulator::Manipulator() : _state(std::make_unique<State>()) {}

Manipulator::Manipulator(osg::Node* scene, const roam::WalkerSettings& settings, roam::Mode mode,
                         const osg::Vec3d& origin)
    : Manipulator() {
  setOrigin(origin);
  setSettings(settings);
  setMode(mode);
  if (scene) buildSpace(*scene);
}

Manipulator::Manipulator(const Manipulator& other, const osg::CopyOp& copy)
    : osg::Object(other, copy),
      osg::Callback(other, copy),
      osgGA::CameraManipulator(other, copy),
      _state(std::make_unique<State>()) {
  const State& from = *other._state;
  State& s = *_state;
  s.settings = from.settings;
  s.regions = from.regions;
  s.mode = from.mode;
  s.before_ghost = from.before_ghost;
  s.space = from.space;
  s.space_is_built = from.space_is_built;
  s.update = from.update;
  s.origin = from.origin;
  s.pose = {other.eye(), from.pose.yaw, from.pose.pitch};
  s.limits_near_plane = from.limits_near_plane;
  s.node = from.node;
  s.at_computed_home = from.at_computed_home;
  s.keys = from.keys;
  s.look_speed = from.look_speed;
  s.look_inverted = from.look_inverted;
  s.easing = from.easing;
  s.make_walker(from.walker ? s.centre_above(from.walker->feet()) : s.centre_under(s.pose.eye));
}

Manipulator::~Manipulator() = default;

// --- the body and its space

void Manipulator::setSpace(std::shared_ptr<const roam::Space> space) {
  _state->build.reset();
  _state->change_space(std::move(space), nullptr);
  if (_state->at_computed_home && _state->mode == roam::Mode::walk) home(0.0);
}

void Manipulator::setGrowingSpace(std::shared_ptr<roam::Space> space) {
  _state->build.reset();
  State::Update update;
  if (const auto live = std::dynamic_pointer_cast<roam::LiveSpace>(space)) {
    update = [live](const roam::Body& body, const roam::Vec3& place, const roam::Vec3& velocity) {
      (void)live->update(body, place, velocity);
    };
  }
  _state->change_space(std::move(space), std::move(update));
  if (_state->at_computed_home && _state->mode == roam::Mode::walk) home(0.0);
}

const std::shared_ptr<const roam::Space>& Manipulator::space() const { return _state->space; }

void Manipulator::setSpaceUpdate(std::function<void(const roam::Body&, const roam::Vec3&)> update) {
  _state->update = nullptr;
  if (!update) return;
  _state->update = [given = std::move(update)](const roam::Body& body, const roam::Vec3& place, const roam::Vec3&) {
    given(body, place);
  };
}

void Manipulator::buildSpace(osg::Node& scene) {
  _state->build.reset();
  _state->build = std::make_unique<BackgroundBuild>(collectMeshes(scene, _state->origin));
}

bool Manipulator::building() const { return _state->build != nullptr; }

double Manipulator::buildProgress() const { return _state->build ? _state->build->fraction() : 1.0; }

void Manipulator::setOrigin(const osg::Vec3d& origin) {
  demand_finite(origin.x() + origin.y() + origin.z(), "the origin of the graph");
  if (origin != _state->origin && (_state->build || _state->space_is_built)) {
    throw roam::Error(
        "the origin of the graph was set after a space had been built from the graph with another one: pass it to the "
        "manipulator's constructor, or call setOrigin before buildSpace");
  }
  const osg::Vec3d moved = std::exchange(_state->origin, origin) - origin;
  // The home position is in the frame of the graph, which has just changed.
  _homeEye += moved;
  _homeCenter += moved;
}

const osg::Vec3d& Manipulator::origin() const { return _state->origin; }

void Manipulator::setSettings(const roam::WalkerSettings& settings) {
  State& s = *_state;
  roam::check(settings);
  roam::check(s.regions, settings);
  const roam::Vec3 feet = s.walker ? s.walker->feet() : roam::Vec3(0.0);
  s.settings = settings;
  s.change_speed(settings.speed);
  if (s.walker) s.make_walker(s.centre_above(feet));
}

const roam::WalkerSettings& Manipulator::settings() const { return _state->settings; }

void Manipulator::setRegions(std::span<const roam::SizeRegion> regions) {
  State& s = *_state;
  roam::check(regions, s.settings);
  s.regions.assign(regions.begin(), regions.end());
  if (s.walker) s.walker->set_regions(s.regions);
}

std::span<const roam::SizeRegion> Manipulator::regions() const { return _state->regions; }

void Manipulator::setMode(roam::Mode mode) { _state->change_mode(mode); }

roam::Mode Manipulator::mode() const { return _state->mode; }

void Manipulator::setSpeed(double speed) {
  demand_finite(speed, "the speed");
  _state->change_speed(speed);
}

double Manipulator::speed() const { return _state->settings.speed; }

roam::Walker* Manipulator::walker() { return _state->walker.get(); }

const roam::Walker* Manipulator::walker() const { return _state->walker.get(); }

void Manipulator::placed() {
  _state->at_computed_home = false;
  _state->tell_placed();
}

const roam::StepReport& Manipulator::report() const {
  static const roam::StepReport none;
  return _state->walker ? _state->walker->report() : none;
}

bool Manipulator::held() const { return !_state->walker || _state->stuck || _state->walker->held(); }

const std::string& Manipulator::problem() const { return _state->problem; }

// --- the pose

void Manipulator::setPose(const roam::Vec3& eye, double yaw, double pitch) {
  demand_place(eye, "the place of the eye");
  demand_finite(yaw + pitch, "the angle of the eye");
  _state->put_eye({eye, wrapped_yaw(yaw), limited_pitch(pitch)});
}

void Manipulator::setFeet(const roam::Vec3& feet, double yaw, double pitch) {
  const roam::WalkerSettings& s = _state->settings;
  setPose(feet + roam::Vec3(0.0, 0.0, 0.5 * s.height + eye_height(s, s.height)), yaw, pitch);
}

void Manipulator::look(double yaw, double pitch) {
  demand_finite(yaw + pitch, "the angle to look at");
  _state->pose.yaw = wrapped_yaw(yaw);
  _state->pose.pitch = limited_pitch(pitch);
}

double Manipulator::yaw() const { return _state->pose.yaw; }

double Manipulator::pitch() const { return _state->pose.pitch; }

roam::Vec3 Manipulator::eye() const { return _state->eye(); }

double Manipulator::leastEyeDistance() const { return least_eye_distance(_state->settings); }

void Manipulator::setAdjustNearFarRatio(bool on) { _state->limits_near_plane = on; }

bool Manipulator::adjustNearFarRatio() const { return _state->limits_near_plane; }

void Manipulator::setHomePose(const roam::Vec3& eye, double yaw, double pitch) {
  demand_place(eye, "the place of the home pose");
  demand_finite(yaw + pitch, "the angle of the home pose");
  const osg::Vec3d at = to_osg(eye) - _state->origin;
  const osg::Vec3d up = to_osg(glm::cross(osgRoam::right(yaw), forward(yaw, pitch)));
  setHomePosition(at, at + to_osg(forward(yaw, pitch)), up, false);
}

// --- motion without keys

void Manipulator::goTo(const roam::Vec3& point, const roam::Vec3& normal) {
  demand_place(point, "the place to go to");
  const double length = glm::length(normal);
  if (!(std::abs(length - 1.0) <= unit_tolerance)) {
    throw roam::Error("the normal at the place to go to has a length of " + roam::number_text(length) +
                      "; it must be 1");
  }
  if (_state->can_go()) _state->go(point, normal);
}

bool Manipulator::going() const { return _state->journey.under_way(); }

void Manipulator::stopGoing() { _state->journey.end(); }

void Manipulator::setPilot(Pilot pilot) {
  _state->pilot = std::move(pilot);
  ++_state->pilots;
  _state->owed = 0.0;
  _state->journey.end();
}

bool Manipulator::piloted() const { return static_cast<bool>(_state->pilot); }

// --- keys and mouse

Controls& Manipulator::controls() { return _state->keys; }

const Controls& Manipulator::controls() const { return _state->keys; }

void Manipulator::setCommandCallback(std::function<void(const std::string& name)> callback) {
  _state->on_command = std::move(callback);
}

bool Manipulator::run(std::string_view command) {
  State& s = *_state;
  const Controls::Command* const found = s.keys.find(command);
  if (!found || found->kind != Controls::Kind::pressed) return false;
  const double now = s.last_time.value_or(0.0);
  const bool taken = s.press(*found, now);
  if (std::exchange(s.home_wanted, false)) home(now);
  return taken;
}

bool Manipulator::down(std::string_view command) const { return _state->keyboard.is_down(_state->keys, command); }

void Manipulator::releaseKeys() {
  if (_state->last_time) _state->keyboard.release_all(*_state->last_time);
}

void Manipulator::setAxes(const Axes& axes) {
  _state->axes = axes;
  for (double Axes::*axis : {&Axes::forward, &Axes::right, &Axes::up, &Axes::turn_left, &Axes::look_up}) {
    if (!std::isfinite(axes.*axis)) _state->axes.*axis = 0.0;
  }
  for (double Axes::*axis : {&Axes::forward, &Axes::right, &Axes::up}) {
    _state->axes.*axis = std::clamp(_state->axes.*axis, -1.0, 1.0);
  }
}

const Manipulator::Axes& Manipulator::axes() const { return _state->axes; }

void Manipulator::setMouseGrab(bool on) { _state->pointer.want_grab(on); }

bool Manipulator::mouseGrab() const { return _state->pointer.grab_wanted(); }

void Manipulator::setLookSpeed(double angle) {
  demand_finite(angle, "the speed of looking");
  _state->look_speed = angle;
}

double Manipulator::lookSpeed() const { return _state->look_speed; }
void Manipulator::setLookInverted(bool on) { _state->look_inverted = on; }
bool Manipulator::lookInverted() const { return _state->look_inverted; }

void Manipulator::setEasing(double seconds) {
  demand_finite(seconds, "the time of easing");
  if (seconds < 0.0) throw roam::Error("the time of easing is negative; take 0 for none");
  _state->easing = seconds;
}

double Manipulator::easing() const { return _state->easing; }

// --- callbacks

void Manipulator::setStepCallback(std::function<void(const roam::StepReport& report, double seconds)> callback) {
  _state->on_step = std::move(callback);
}

std::int64_t Manipulator::collisionNanoseconds() const { return _state->nanoseconds; }

std::int64_t Manipulator::collisionOwnNanoseconds() const { return _state->own_ns; }

int Manipulator::steps() const { return _state->steps; }

}  // namespace osgRoam
