#pragma once
/// \file
/// The state of an osgRoam::Manipulator, and its update in each frame.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <osg/Node>
#include <string>
#include <utility>
#include <vector>

#include "osgRoam/Manipulator.h"
#include "osgroam/background_build.h"
#include "osgroam/camera_pose.h"
#include "osgroam/journey.h"
#include "osgroam/keyboard.h"
#include "osgroam/pointer.h"
#include "osgroam/soft_eye.h"

namespace osgRoam {

/// A rate of turning that follows the wanted one.
struct EasedTurn {
  double rate = 0.0;  ///< rad/s
  double pace = 0.0;  ///< rad/s, that is reached or left in the time of easing

  /// Returns the angle turned in `seconds`.
  double advance(double wanted, double seconds, double easing);
};

struct Manipulator::State {
  using Update = std::function<void(const roam::Body&, const roam::Vec3& place, const roam::Vec3& velocity)>;
  using StepCallback = std::function<void(const roam::StepReport&, double)>;

  // The body.
  roam::WalkerSettings settings;
  std::vector<roam::SizeRegion> regions;
  roam::Mode mode = roam::Mode::fly;
  roam::Mode before_ghost = roam::Mode::fly;
  std::shared_ptr<const roam::Space> space;
  bool space_is_built = false;  ///< built from the graph, at the present origin
  Update update;
  std::unique_ptr<roam::Walker> walker;
  unsigned walkers = 0;  ///< number of walkers so far
  std::unique_ptr<BackgroundBuild> build;
  std::string problem;
  bool stuck = false;  ///< because of the problem

  // The camera.
  osg::Vec3d origin;
  CameraPose pose;  ///< the eye is valid only while there is no walker
  SoftEye soft;
  std::optional<osg::Matrixd> projection;  ///< of the camera at its last update
  bool limits_near_plane = true;
  osg::ref_ptr<osg::Node> node;
  bool at_computed_home = false;  ///< and it has not moved since
  bool lands = false;             ///< a camera from elsewhere has placed the body where there is no space yet

  // Motion.
  Controls keys;
  Keyboard keyboard;
  Pointer pointer;
  Journey journey;
  Pilot pilot;
  unsigned pilots = 0;     ///< number of pilots so far, because a pilot may set its successor
  double owed = 0.0;       ///< seconds that the pilot has not simulated yet
  double jump_left = 0.0;  ///< seconds for which a requested jump may still begin
  double look_speed = 0.0;
  bool look_inverted = false;
  double easing = 0.0;              ///< seconds; see Manipulator::setEasing
  double eased_speed = 0.0;         ///< m/s, that is reached or left in this time; 0: keys have not moved the body
  std::optional<double> last_time;  ///< of the last frame, seconds
  bool continuous = false;          ///< continuous update has been requested from the viewer
  HeldCommands held_before;         ///< as of the last frame
  Axes axes;
  EasedTurn turning_left, looking_up;
  double scrolled_at = -1e9;  ///< s, of the last turn of the wheel

  // Reports.
  StepCallback on_step;
  std::function<void(const std::string&)> on_command;
  std::int64_t nanoseconds = 0;
  std::int64_t own_ns = 0;  ///< of these, the processor time of this thread
  int steps = 0;
  bool moved = false;  ///< in the last frame

  State();

  [[nodiscard]] roam::Vec3 eye() const;
  /// The body's centre, for a standing body with that eye.
  [[nodiscard]] roam::Vec3 centre_under(const roam::Vec3& eye) const;
  /// The body's centre, for a body that stands at `feet`.
  [[nodiscard]] roam::Vec3 centre_above(const roam::Vec3& feet) const;
  /// Runs `work`. An exception becomes the problem.
  template <class Work>
  void guarded(const Work& work) {
    try {
      work();
    } catch (const std::exception& error) {
      fail(error.what());
    } catch (...) {
      fail("a callback threw something that is no std::exception");
    }
  }
  void fail(const std::string& what);
  /// Calls a function of the caller, if there is one. It may replace itself while it runs.
  template <class Function, class... Arguments>
  static void call(const Function function, const Arguments&... arguments) {
    if (function) function(arguments...);
  }

  void change_space(std::shared_ptr<const roam::Space> to, Update update_of_it, bool is_built = false);
  /// Makes a new walker in the space at `centre`; none without a space.
  void make_walker(const roam::Vec3& centre);
  void put(const roam::Vec3& centre);
  void put_eye(const CameraPose& where);
  /// Puts a walking body that is held, or has no floor near below, on a floor; see Manipulator::setByMatrix.
  void land();
  void tell_placed();
  void change_mode(roam::Mode to);
  void change_speed(double to);

  /// Returns whether a world that was under construction has become the space.
  bool take_build();
  /// Moves the body by the time since the last frame.
  void frame(double time);
  /// Turns the gaze by the axes.
  void turn(double seconds);
  /// Whether keys or axes move the body.
  [[nodiscard]] bool moves(const HeldCommands& held) const;
  void run(double seconds, const HeldCommands& held);
  void step(double seconds, const HeldCommands& held);
  /// Whether the body can go to a target by itself.
  [[nodiscard]] bool can_go() const { return walker && !stuck && !pilot; }
  void go(const roam::Vec3& point, const roam::Vec3& normal);
  void fly_pilot(double seconds);
  [[nodiscard]] roam::Vec3 wish(const HeldCommands& held) const;
  /// Limits the acceleration of keys.
  void ease(roam::WalkerInput& input, const HeldCommands& held);
  /// Whether the next frame will differ from this one without any event.
  [[nodiscard]] bool restless() const;

  // Events. They return true if they handle the event.
  bool key_down(const osgGA::GUIEventAdapter& event);
  void key_up(const osgGA::GUIEventAdapter& event);
  bool press(const Controls::Command& command, double time);
  bool look(const osgGA::GUIEventAdapter& event);
  bool scroll(const osgGA::GUIEventAdapter& event);
  bool go_to_clicked(const osgGA::GUIEventAdapter& event);
  bool home_wanted = false;  ///< its key has been pressed
};

}  // namespace osgRoam
