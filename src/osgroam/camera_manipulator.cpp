// The interface of osgGA for manipulators of a camera.
#include <algorithm>
#include <osg/Notify>
#include <utility>

#include "osgroam/manipulator_state.h"
#include "osgroam/near_plane.h"
#include "osgroam/places.h"

namespace osgRoam {
namespace {

using Adapter = osgGA::GUIEventAdapter;

/// Cosine of the greatest angle to +z at which the up vector of a frame counts as roam's.
constexpr double upright = 0.999;

/// Metres: error of leastEyeDistance(), apart from that of the stored triangles.
constexpr double certified_to = 1e-6;

}  // namespace

void Manipulator::setByMatrix(const osg::Matrixd& matrix) {
  if (const std::optional<CameraPose> pose = camera_pose(matrix, _state->origin)) {
    _state->put_eye(*pose);
    _state->land();
  } else {
    OSG_WARN << "osgRoam::Manipulator: a matrix that is no camera was set, and is left out" << std::endl;
  }
}

void Manipulator::setByInverseMatrix(const osg::Matrixd& matrix) { setByMatrix(osg::Matrixd::inverse(matrix)); }

osg::Matrixd Manipulator::getMatrix() const {
  return camera_matrix({_state->eye(), _state->pose.yaw, _state->pose.pitch}, _state->origin);
}

osg::Matrixd Manipulator::getInverseMatrix() const { return osg::Matrixd::inverse(getMatrix()); }

void Manipulator::updateCamera(osg::Camera& camera) {
  _state->projection = camera.getProjectionMatrix();
  camera.setViewMatrix(getInverseMatrix());
  if (!_state->limits_near_plane) return leave_near_plane(camera);
  const double least = leastEyeDistance();
  // Drawn triangles may lie nearer than those that the space has stored.
  const double error = (_state->space ? _state->space->largest_error() : 0.0) + certified_to;
  limit_near_plane(camera, std::max(least - error, 0.5 * least));
}

void Manipulator::setNode(osg::Node* node) { _state->node = node; }

const osg::Node* Manipulator::getNode() const { return _state->node.get(); }

osg::Node* Manipulator::getNode() { return _state->node.get(); }

void Manipulator::home(double) {
  State& s = *_state;
  if (getUpVector(getCoordinateFrame(osg::Vec3d())).z() < upright) {
    OSG_WARN << "osgRoam::Manipulator: the scene's up is not +z, and bodies walk as if it were; turn the scene"
             << std::endl;
  }
  const bool computed = getAutoComputeHomePosition();
  if (computed) computeHomePosition();
  const roam::Vec3 eye = to_roam(_homeEye + s.origin), center = to_roam(_homeCenter + s.origin);
  s.put_eye(looking_at(eye, center, to_roam(_homeUp)));
  s.at_computed_home = computed;
  if (!computed || !s.walker || s.mode != roam::Mode::walk) return;
  s.guarded([&] {
    if (const std::optional<roam::Vec3> place = standing_place(*s.space, s.settings)) {
      s.pose.pitch = 0.0;
      s.put(*place);
    }
  });
}

void Manipulator::home(const Adapter& event, osgGA::GUIActionAdapter& viewer) {
  home(event.getTime());
  viewer.requestRedraw();
}

void Manipulator::init(const Adapter& event, osgGA::GUIActionAdapter& viewer) {
  // Events of keys released during another manipulator's turn have not arrived here.
  _state->keyboard.release_all(event.getTime());
  _state->pointer.let_go();
  _state->last_time.reset();
  _state->continuous = false;
  viewer.requestContinuousUpdate(false);
  viewer.requestRedraw();
}

void Manipulator::finishAnimation() { _state->journey.end(); }

bool Manipulator::handle(const Adapter& event, osgGA::GUIActionAdapter& viewer) {
  State& s = *_state;
  switch (event.getEventType()) {
    case Adapter::FRAME: {
      if (s.take_build() && s.at_computed_home && s.mode == roam::Mode::walk) home(event.getTime());
      s.frame(event.getTime());
      const bool release_down = s.keyboard.is_down(s.keys, "release");
      s.pointer.keep_grab(event, viewer, s.keys, release_down);
      const bool restless = s.restless();
      if (restless != s.continuous) viewer.requestContinuousUpdate(restless);
      s.continuous = restless;
      return false;
    }
    case Adapter::KEYUP:
      s.key_up(event);
      return false;
    case Adapter::RELEASE:
      if (event.getButtonMask() == 0) s.pointer.let_go();
      return false;
    case Adapter::CLOSE_WINDOW:
    case Adapter::QUIT_APPLICATION:
      s.keyboard.release_all(event.getTime());
      return false;
    default:
      break;
  }
  if (event.getHandled()) return false;

  bool taken = false;
  switch (event.getEventType()) {
    case Adapter::KEYDOWN:
      taken = s.key_down(event);
      if (std::exchange(s.home_wanted, false)) home(event, viewer);
      break;
    case Adapter::PUSH:
      // Two fingers that scroll sideways are buttons without a number in OpenSceneGraph's X11 windows.
      if (event.getButton() == 0) break;
      taken = !s.pointer.push(event) || s.go_to_clicked(event);
      break;
    case Adapter::DOUBLECLICK:
      s.pointer.push(event);
      taken = s.go_to_clicked(event);
      break;
    case Adapter::MOVE:
    case Adapter::DRAG:
      taken = s.look(event);
      break;
    case Adapter::SCROLL:
      taken = s.scroll(event);
      break;
    default:
      break;
  }
  if (taken) viewer.requestRedraw();
  return taken;
}

void Manipulator::getUsage(osg::ApplicationUsage& usage) const {
  for (const Controls::Command& command : _state->keys.commands()) {
    const std::string keys = Controls::keyText(command);
    // A usage keeps one line for each text of keys. With the blank ours stay beside those of other handlers.
    if (!keys.empty()) usage.addKeyboardMouseBinding(keys + " ", "roam: " + command.help);
  }
}

}  // namespace osgRoam
