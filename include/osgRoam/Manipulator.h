#pragma once
/// \file
/// Manipulator: a camera that is a body. It walks and flies through a scene and never passes through a wall.
///
///     viewer.setCameraManipulator(new osgRoam::Manipulator(scene));  // flies
///
/// To walk, in any roam::Space (World, Patchwork, Pager):
///
///     osg::ref_ptr<osgRoam::Manipulator> roamer = new osgRoam::Manipulator;
///     roamer->setMode(roam::Mode::walk);
///     roamer->setSpace(space);
///     roamer->setHomePose(eye, yaw, pitch);  // else a standing position near the middle of the space
///     viewer.setCameraManipulator(roamer);
///
/// Coordinates: those of roam::Vec3 are the scene's. Those of matrices, osg::Vec3d and home positions are the graph's:
/// the scene's minus origin(). Metres, z up. A CoordinateFrameCallback with another up is not used; home() warns once.
/// Angles are radians: yaw is 0 along +x and grows to the left, pitch is 0 at the horizon and grows upwards, in [-pi/2,
/// pi/2]. There is no roll.
///
/// Time: the body moves on FRAME events by the time between them (GUIEventAdapter::getTime), in steps of at most
/// longest_step. A longer time than longest_frame counts as longest_frame. Keys count for as long as they are down.
///
/// Input: keys are those of controls(). The mouse looks while a button is dragged, or always with setMouseGrab(). The
/// wheel changes the speed, a double click goes to the clicked point. Events that another handler has taken are
/// ignored: osgViewer::StatsHandler takes S, osgGA::StateSetManipulator takes W. StatusHandler (StatusHandler.h), added
/// before them, keeps the keys for the body. All keys are released if the window loses the keyboard.
///
/// Errors inside the viewer's loop do not throw: see problem(). Callbacks may call any member; their report is invalid
/// once space or settings change. All members belong to the thread that calls Viewer::frame(), in every threading
/// model.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <osg/Vec3d>
#include <osgGA/CameraManipulator>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "osgRoam/Controls.h"
#include "roam/patchwork.h"
#include "roam/space.h"
#include "roam/walker.h"
#include "roam/world.h"

namespace osgRoam {

class Manipulator : public osgGA::CameraManipulator {
 public:
  static constexpr double longest_frame = 0.25;       ///< seconds
  static constexpr double longest_step = 1.0 / 60.0;  ///< seconds
  static constexpr double slow_factor = 0.25;         ///< of the speed, with Ctrl
  static constexpr double least_speed = 0.01;         ///< metres per second
  static constexpr double greatest_speed = 1000.0;    ///< metres per second

  /// Without a space: the body is held until setSpace.
  Manipulator();
  /// Copies the triangles of `scene` (collectMeshes) and indexes them in another thread. The body is held until that is
  /// done. For `origin` see setOrigin(). Throws roam::Error as setSettings() and setOrigin() do.
  explicit Manipulator(osg::Node* scene, const roam::WalkerSettings& settings = {}, roam::Mode mode = roam::Mode::fly,
                       const osg::Vec3d& origin = osg::Vec3d());
  /// Copies settings, regions, controls, space and its update, pose and home; not the other callbacks, the pilot, keys
  /// that are down, or a world that is being built.
  Manipulator(const Manipulator& other, const osg::CopyOp& copy = osg::CopyOp::SHALLOW_COPY);
  META_Object(osgRoam, Manipulator);

  // --- the body and its space

  /// Moves the body into another space; null: none, the body is held. If the body does not fit, it is put to the
  /// nearest safe position. A walking body that has not moved since a computed home goes home() again. Cancels
  /// buildSpace. Call between two frames. A LiveSpace (Patchwork, Pager) passed as const must be updated by the caller.
  void setSpace(std::shared_ptr<const roam::Space> space);
  /// As above, and updates a LiveSpace before the steps of each frame and before a placement.
  template <std::derived_from<roam::Space> Space>
  requires(!std::is_const_v<Space>) void setSpace(std::shared_ptr<Space> space) { setGrowingSpace(std::move(space)); }
  void setSpace(std::nullptr_t) { setSpace(std::shared_ptr<const roam::Space>()); }
  /// A callback before the steps of each frame and before a placement, with the body and its centre. setSpace and the
  /// end of buildSpace remove it.
  void setSpaceUpdate(std::function<void(const roam::Body&, const roam::Vec3&)> update);
  [[nodiscard]] const std::shared_ptr<const roam::Space>& space() const;
  /// Copies and indexes the triangles of `scene` as the constructor does. When it is done, the world becomes the space.
  void buildSpace(osg::Node& scene);
  [[nodiscard]] bool building() const;
  /// Fraction of buildSpace that is done, in [0, 1]; 1: nothing is being built.
  [[nodiscard]] double buildProgress() const;

  /// Sets the graph's frame: graph = scene - origin, metres. The body keeps its position in the scene. Throws
  /// roam::Error if `origin` is not finite, or if the space was built from the graph with another origin. With a space
  /// from osgRoam::buildWorld (Triangles.h) the origin may change at any time.
  void setOrigin(const osg::Vec3d& origin);
  [[nodiscard]] const osg::Vec3d& origin() const;

  /// Keeps the feet. If the new body does not fit, it is put to the nearest safe position. The speed is clamped to
  /// [least_speed, greatest_speed]. Throws roam::Error, and changes nothing, if settings are out of range or do not
  /// suit the regions. A lower body needs a lower eye: see WalkerSettings::person.
  void setSettings(const roam::WalkerSettings& settings);
  [[nodiscard]] const roam::WalkerSettings& settings() const;  ///< with the present speed

  /// Walker::set_regions for this and all later walkers. Throws roam::Error, and changes nothing, if they do not suit
  /// the settings.
  void setRegions(std::span<const roam::SizeRegion> regions);
  [[nodiscard]] std::span<const roam::SizeRegion> regions() const;

  void setMode(roam::Mode mode);
  [[nodiscard]] roam::Mode mode() const;
  /// Metres per second without Shift and Ctrl, clamped to [least_speed, greatest_speed]. Throws roam::Error for NaN.
  void setSpeed(double speed);
  [[nodiscard]] double speed() const;

  /// The walker, or null without a space. Do not keep it: setSpace, setSettings and the end of buildSpace replace it.
  /// Call placed() after moving it.
  [[nodiscard]] roam::Walker* walker();
  [[nodiscard]] const roam::Walker* walker() const;
  /// Takes over a new position of walker(), and calls the step callback.
  void placed();
  /// The report of the last step or placement.
  [[nodiscard]] const roam::StepReport& report() const;
  /// Whether the body cannot move: no space, Walker::held(), or a problem().
  [[nodiscard]] bool held() const;
  /// Message of an error inside the viewer's loop; empty: none. It holds the body until it is placed or gets another
  /// space.
  [[nodiscard]] const std::string& problem() const;

  // --- the pose

  /// Places the standing body by its eye. If it does not fit, it is put to the nearest safe position (Walker::place).
  /// Throws roam::Error if an angle is not finite, or the eye not within roam::coordinate_limit.
  ///
  /// Viewer::setCameraManipulator and setSceneData go home() and so undo an earlier setPose. Use setHomePose, or pass
  /// false as second argument of setCameraManipulator.
  void setPose(const roam::Vec3& eye, double yaw, double pitch);
  /// As above, by the lowest point of the body.
  void setFeet(const roam::Vec3& feet, double yaw, double pitch);
  void look(double yaw, double pitch);
  [[nodiscard]] double yaw() const;
  [[nodiscard]] double pitch() const;
  /// The camera. It follows steps and stairs smoothly, at least a quarter of the radius inside the body.
  [[nodiscard]] roam::Vec3 eye() const;
  /// Metres, > 0: every triangle is at least so far from eye(), up to 1e-6 m and the space's own error. Not while the
  /// body is held or a ghost. A near plane that cuts nothing is at most this divided by
  /// sqrt(1 + tan^2(half width) + tan^2(half height)).
  [[nodiscard]] double leastEyeDistance() const;
  /// On by default: keeps computed near planes (CullSettings::setComputeNearFarMode) from cutting walls open in large
  /// scenes. Sets a ClampProjectionMatrixCallback on the camera, unless it has another one.
  void setAdjustNearFarRatio(bool on);
  [[nodiscard]] bool adjustNearFarRatio() const;
  /// Sets the pose of home(), in which a viewer begins. setHomePosition does so in the graph's frame.
  void setHomePose(const roam::Vec3& eye, double yaw, double pitch);

  // --- going without keys

  /// Goes straight to `point`, with collision, as a double click does, and rests beside the surface there. `normal` is
  /// the unit normal of that surface towards the body. Walking counts only horizontal distance. Ends on arrival, when
  /// the body gets no nearer, or at the first key that moves it. Does nothing without a space, with a pilot, or after a
  /// problem(). Throws roam::Error if `point` is not within coordinate_limit or `normal` not of length 1 +- 1e-3.
  void goTo(const roam::Vec3& point, const roam::Vec3& normal);
  [[nodiscard]] bool going() const;
  void stopGoing();

  /// Called for each step instead of Walker::step. It moves the walker for about `seconds` and returns its report, or
  /// null at its end. Time is counted by StepReport::elapsed. The user can still look. An empty function ends it.
  using Pilot = std::function<const roam::StepReport*(roam::Walker& walker, double seconds)>;
  void setPilot(Pilot pilot);
  [[nodiscard]] bool piloted() const;

  // --- keys and mouse

  [[nodiscard]] Controls& controls();
  [[nodiscard]] const Controls& controls() const;
  /// Called with the name of a command of Kind::pressed that is not the manipulator's own, when its key goes down.
  void setCommandCallback(std::function<void(const std::string& name)> callback);
  /// Does what a press of its key does, for menus and buttons. False if it is no command of Kind::pressed, or nothing
  /// is done.
  bool run(std::string_view command);
  /// Whether a key of the command is down.
  [[nodiscard]] bool down(std::string_view command) const;
  void releaseKeys();

  /// The wishes of a device with axes, such as a gamepad. They add to those of the keys.
  struct Axes {
    double forward = 0.0, right = 0.0, up = 0.0;      ///< shares of the speed, in [-1, 1]
    double turn_left = 0.0, look_up = 0.0;            ///< radians a second
    bool fast = false, slow = false, crouch = false;  ///< as the keys
    bool operator==(const Axes&) const = default;
  };
  /// Valid until the next call. Numbers that are not finite count as 0.
  void setAxes(const Axes& axes);
  [[nodiscard]] const Axes& axes() const;

  /// On: the mouse looks whenever it moves; its pointer is hidden. Escape (the command "release") turns it off.
  void setMouseGrab(bool on);
  [[nodiscard]] bool mouseGrab() const;
  /// Radians per movement of the mouse by the height of the window; default pi / 2.
  void setLookSpeed(double angle);
  [[nodiscard]] double lookSpeed() const;
  /// On: moving the mouse forwards looks down.
  void setLookInverted(bool on);
  [[nodiscard]] bool lookInverted() const;
  /// Seconds, >= 0, in which keys and axes bring the body to full speed and to rest, and axes the gaze to its rate of
  /// turning; default 0: at once. Walls stop the body at once. Pilots, goTo() and the mouse are not eased. Throws
  /// roam::Error if it is negative or not finite.
  void setEasing(double seconds);
  [[nodiscard]] double easing() const;

  // --- watching

  /// Called after each step with its report and its seconds, and after each placement with 0.
  void setStepCallback(std::function<void(const roam::StepReport& report, double seconds)> callback);
  /// Time of the last frame's steps, with pilots, without callbacks.
  [[nodiscard]] std::int64_t collisionNanoseconds() const;
  /// As above, processor time of this thread.
  [[nodiscard]] std::int64_t collisionOwnNanoseconds() const;
  /// Steps of the last frame.
  [[nodiscard]] int steps() const;

  // --- osgGA::CameraManipulator

  /// Places the eye at the camera without roll. Ignores a matrix that setPose would refuse. A walking body that
  /// is held there, or that would fall far, stands on a floor instead, looking level: below it, else where the camera
  /// looks, else near the middle of the space. So it walks after a trackball has looked at the scene from outside.
  void setByMatrix(const osg::Matrixd& matrix) override;
  void setByInverseMatrix(const osg::Matrixd& matrix) override;
  [[nodiscard]] osg::Matrixd getMatrix() const override;
  [[nodiscard]] osg::Matrixd getInverseMatrix() const override;
  void updateCamera(osg::Camera& camera) override;

  /// home() uses the node's size.
  void setNode(osg::Node* node) override;
  [[nodiscard]] const osg::Node* getNode() const override;
  [[nodiscard]] osg::Node* getNode() override;

  /// Goes to the home position. If computed (setAutoComputeHomePosition), it is outside with a view of the whole node;
  /// in walk mode, a standing position near the middle of the space.
  void home(double time) override;
  void home(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer) override;
  void init(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer) override;
  /// Ends goTo().
  void finishAnimation() override;
  using osgGA::CameraManipulator::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer) override;
  void getUsage(osg::ApplicationUsage& usage) const override;

 protected:
  ~Manipulator() override;

 private:
  void setGrowingSpace(std::shared_ptr<roam::Space> space);

  struct State;
  const std::unique_ptr<State> _state;
};

}  // namespace osgRoam
