#pragma once
/// \file
/// A camera that is a body: it walks and flies through the scene and never passes through a wall. In a program that
/// has an osgViewer::Viewer, one line:
///
///     viewer.setCameraManipulator(new osgRoam::Manipulator(scene));
///
/// or, with a roam::Space of one's own (a World, a Patchwork, a Pager):
///
///     osg::ref_ptr<osgRoam::Manipulator> roamer = new osgRoam::Manipulator;
///     roamer->setSettings({.radius = 0.25});
///     roamer->setMode(roam::Mode::walk);
///     roamer->setSpace(space);
///     viewer.setCameraManipulator(roamer);
///
/// Two frames. Everything that is a roam::Vec3 is in the scene's own frame, in double metres, z up; everything that is
/// OpenSceneGraph's (matrices, osg::Vec3d, home positions) is in the frame of the graph, which is the scene minus
/// origin(). The frame that a CoordinateFrameCallback names is not used, because up is +z for every body of roam: a
/// scene with another up has to be turned first. home() says so, once, with OSG_WARN.
///
/// Angles are radians. Yaw is 0 along +x and grows to the left, seen from above; pitch is 0 at the horizon and grows
/// upwards, in [-pi/2, pi/2]. There is no roll.
///
/// The body moves on FRAME events, by the time between two of them, as the events tell it (GUIEventAdapter::getTime),
/// and never by key repeat: for how long each key was down counts, not how many frames there were. Frames longer than
/// longest_frame are cut short, and every frame is cut into steps of at most longest_step, to within the rounding of
/// the clock. Time that stands still or runs backwards moves nothing.
///
/// Keys are those of controls(). The mouse looks while a button is dragged, or, with setMouseGrab(), whenever it moves;
/// the wheel changes the speed; a double click goes to what was clicked. Events that another handler has taken
/// (osgViewer::StatsHandler takes S) are left to it; keys that are let go are noticed all the same.
///
/// Keys that were down when the window lost the keyboard are let go: OpenSceneGraph's X11 windows say KEYUP then,
/// except where a window manager holds the keyboard to switch windows; Alt, Meta and Super therefore let go of all
/// keys, and of the mouse.
///
/// A camera whose near and far planes OpenSceneGraph computes, which is what it does unless told otherwise, cuts walls
/// open in scenes of more than some 300 m, because its near plane is at least 1/2000 as far as its far plane is.
/// updateCamera sees to it that the near plane stays before the walls: see setAdjustNearFarRatio.
///
/// Never throws from what a viewer calls (handle, home, setByMatrix, updateCamera, ...): see problem(). Callbacks may
/// call anything here, also what replaces them; a report that they were given means nothing once the space or the
/// settings have changed. All of it belongs to the thread that calls Viewer::frame(), in every threading model.

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
  static constexpr double slow_factor = 0.25;         ///< on the speed, with Ctrl
  static constexpr double least_speed = 0.01;         ///< metres per second: setSpeed and the wheel stop here
  static constexpr double greatest_speed = 1000.0;    ///< metres per second

  /// A body without a space: one can look around, and it is held until setSpace.
  Manipulator();
  /// A body in the triangles of `scene`, as they are now: taken from it here, in this thread, and indexed in another
  /// while the viewer runs; until that is done the body is held. Takes the finest level of detail that is in memory.
  /// `origin` is what the graph was moved by, see setOrigin(). Throws roam::Error for bad settings, which setSettings()
  /// explains, and for an origin that is not finite.
  explicit Manipulator(osg::Node* scene, const roam::WalkerSettings& settings = {}, roam::Mode mode = roam::Mode::fly,
                       const osg::Vec3d& origin = osg::Vec3d());
  /// Settings, regions, controls, the space and its update, pose and home; not the other callbacks, the pilot, keys
  /// that are down, a world that is being built.
  Manipulator(const Manipulator& other, const osg::CopyOp& copy = osg::CopyOp::SHALLOW_COPY);
  META_Object(osgRoam, Manipulator);

  // --- the body and what it moves in

  /// Puts the body, where it is, into another space (null: into none, it is held). Where it does not fit it is put to
  /// the nearest safe place. In walk mode a body that is still where a computed home has put it, with nobody having
  /// moved or placed it since, goes home() again: now there may be a floor to stand on. Ends a building that is under
  /// way, and waits until that is noticed. Call between two frames.
  ///
  /// A roam::LiveSpace, such as a Patchwork or a Pager, that is passed as const is the caller's to update, between two
  /// frames.
  void setSpace(std::shared_ptr<const roam::Space> space);
  /// The same; and if it is a LiveSpace, whichever type the pointer has, what has come is taken into use before
  /// the steps of each frame and before a placement.
  template <std::derived_from<roam::Space> Space>
  requires(!std::is_const_v<Space>) void setSpace(std::shared_ptr<Space> space) { setGrowingSpace(std::move(space)); }
  void setSpace(std::nullptr_t) { setSpace(std::shared_ptr<const roam::Space>()); }
  /// What the present space needs before the steps of each frame and before a placement: called with the body and its
  /// centre. Call it after setSpace, which forgets it, as does a space that buildSpace has made, when it is taken.
  void setSpaceUpdate(std::function<void(const roam::Body&, const roam::Vec3&)> update);
  [[nodiscard]] const std::shared_ptr<const roam::Space>& space() const;
  /// Builds a world of the triangles of `scene` as the constructor does. When it is ready, in a frame, it becomes the
  /// space, as by setSpace; until then the present one stays. Ends a building that is under way, as setSpace does.
  void buildSpace(osg::Node& scene);
  [[nodiscard]] bool building() const;
  /// The fraction done of buildSpace, in [0, 1]; 1 when nothing is being built.
  [[nodiscard]] double buildProgress() const;

  /// The graph is the scene minus `origin`, metres. The body stays where it is in the scene. Before buildSpace, or the
  /// constructor has it: throws roam::Error, and changes nothing, when the origin is another one than that with which a
  /// space was, or is being, built from the graph. Where it is the graph that has been moved, build the space with
  /// osgRoam::buildWorld (Triangles.h) and pass it to setSpace; then the origin may change at any time. Throws
  /// roam::Error when it is not finite.
  void setOrigin(const osg::Vec3d& origin);
  [[nodiscard]] const osg::Vec3d& origin() const;

  /// The feet stay where they are; where the new body does not fit it is put to the nearest safe place. Throws
  /// roam::Error for settings out of range, and changes nothing then: a lower body needs a lower eye, see
  /// WalkerSettings::person. A speed that is in its own range (roam::check),
  /// but not in [least_speed, greatest_speed], is brought into that, as by setSpeed.
  void setSettings(const roam::WalkerSettings& settings);
  [[nodiscard]] const roam::WalkerSettings& settings() const;  ///< with the speed as it is now

  /// Where the body has another size: Walker::set_regions, for this walker and for each that follows it after setSpace,
  /// setSettings and buildSpace. Copied. A body that stands in a region takes its size with the next step. Throws
  /// roam::Error for regions that the settings do not allow, and changes nothing then; so does setSettings where the
  /// regions do not allow the settings.
  void setRegions(std::span<const roam::SizeRegion> regions);
  [[nodiscard]] std::span<const roam::SizeRegion> regions() const;

  void setMode(roam::Mode mode);
  [[nodiscard]] roam::Mode mode() const;
  /// Metres per second without Shift and Ctrl; brought into [least_speed, greatest_speed]. Throws roam::Error when it
  /// is not a number.
  void setSpeed(double speed);
  [[nodiscard]] double speed() const;

  /// Null until there is a space, and another one after setSpace, setSettings and when buildSpace is done: do not keep
  /// it. Whoever moves it outside a pilot calls placed() after.
  [[nodiscard]] roam::Walker* walker();
  [[nodiscard]] const roam::Walker* walker() const;
  /// Tells the manipulator, and the step callback, that walker() has been put somewhere.
  void placed();
  /// Of the last step or placement; an empty one before.
  [[nodiscard]] const roam::StepReport& report() const;
  /// Cannot move: there is no space yet, Walker::held() says so, or there was a problem().
  [[nodiscard]] bool held() const;
  /// What went wrong inside the viewer's loop, for people; empty when nothing did. The body is held from then on until
  /// it is placed, or gets another space.
  [[nodiscard]] const std::string& problem() const;

  // --- the pose

  /// Puts the eye of the standing body to `eye`, metres, and looks. Throws roam::Error when anything is not finite.
  /// Where the body does not fit it is put to the nearest safe place: by a way that is checked, where there is one
  /// (Walker::place), else to the nearest place found in any direction.
  ///
  /// Viewer::setCameraManipulator and setSceneData go home(), as with every manipulator of osgGA: a pose that was set
  /// before them is lost. Where the viewer is to begin there, use setHomePose, or pass false as the second argument of
  /// setCameraManipulator.
  void setPose(const roam::Vec3& eye, double yaw, double pitch);
  /// The same for the lowest point of the body, and as short-lived before the viewer goes home().
  void setFeet(const roam::Vec3& feet, double yaw, double pitch);
  void look(double yaw, double pitch);
  [[nodiscard]] double yaw() const;
  [[nodiscard]] double pitch() const;
  /// The camera, metres. Follows steps and stairs softly, and stays at least leastEyeDistance() from everything: so it
  /// is not Walker::eye(), which may lie on the body's surface, but a quarter of the radius inside it or more.
  [[nodiscard]] roam::Vec3 eye() const;
  /// What the body guarantees, metres, > 0: no triangle is nearer to eye() than this, but for 1e-6 m and for the
  /// space's own error, in fly and walk mode and not held. A near plane that cuts nothing is at most this divided by
  /// sqrt(1 + tan^2(half width) + tan^2(half height)).
  [[nodiscard]] double leastEyeDistance() const;
  /// On, as it is at first: of a camera that updateCamera gets and that computes its near and far planes
  /// (CullSettings::setComputeNearFarMode), the ratio of the two that each picture is made with is taken so small,
  /// where the camera's own is not, that the near plane cuts nothing. No smaller: the resolution of depth is that of a
  /// near plane there. Done by a ClampProjectionMatrixCallback; a camera that has one of somebody else's is left alone,
  /// and so is one with DO_NOT_COMPUTE_NEAR_FAR. The camera's own ratio is not changed, and is what counts again as
  /// soon as another manipulator moves the camera. Off: from the next updateCamera on the callback is gone.
  void setAdjustNearFarRatio(bool on);
  [[nodiscard]] bool adjustNearFarRatio() const;
  /// home() goes there, and so a viewer begins there: see setPose. See setHomePosition for the same in the graph's
  /// frame.
  void setHomePose(const roam::Vec3& eye, double yaw, double pitch);

  // --- going without keys

  /// Goes to `point`, metres, as a double click on it does: straight, with collision, hurrying. `normal` is that of the
  /// surface there, of length 1, on the side from which one comes: the body comes to rest beside the plane that it
  /// stands on, with a gap of two skins (Walker::skin). On foot only the horizontal part of the way counts. Ends when
  /// it is there, when it no longer comes nearer, and at the first key that moves. Does nothing without a space, while
  /// a pilot moves the body, and after a problem(). Throws roam::Error for a point that is not finite and for a normal
  /// whose length is not 1 to within 1e-3.
  void goTo(const roam::Vec3& point, const roam::Vec3& normal);
  [[nodiscard]] bool going() const;
  void stopGoing();

  /// Something else than the person moves the body; the person may still look. Called for each step instead of
  /// Walker::step: it moves the walker for about `seconds` and returns its report, or null when it is at its end and
  /// the person takes over. What it simulated counts (StepReport::elapsed), so that it keeps real time with steps of
  /// its own. An empty function ends it.
  using Pilot = std::function<const roam::StepReport*(roam::Walker& walker, double seconds)>;
  void setPilot(Pilot pilot);
  [[nodiscard]] bool piloted() const;

  // --- keys and mouse

  [[nodiscard]] Controls& controls();
  [[nodiscard]] const Controls& controls() const;
  /// Called with the name of each command of controls() of Kind::pressed, when its key goes down, that is not the
  /// manipulator's own.
  void setCommandCallback(std::function<void(const std::string& name)> callback);
  /// Whether a key of the command is down.
  [[nodiscard]] bool down(std::string_view command) const;
  void releaseKeys();

  /// On: the mouse looks whenever it moves, its pointer is hidden and stays in the window. Escape (the command
  /// "release") leaves that, and does not close the viewer meanwhile.
  void setMouseGrab(bool on);
  [[nodiscard]] bool mouseGrab() const;
  /// How far a movement of the mouse by the height of the window turns the eye, radians; default pi / 2.
  void setLookSpeed(double angle);
  [[nodiscard]] double lookSpeed() const;
  /// On: moving the mouse forwards looks down.
  void setLookInverted(bool on);
  [[nodiscard]] bool lookInverted() const;

  // --- watching

  /// Called after every step with its report and the seconds that were asked of it, and after every placement with 0.
  void setStepCallback(std::function<void(const roam::StepReport& report, double seconds)> callback);
  /// Time that the steps of the last frame took, nanoseconds; callbacks not counted, pilots counted.
  [[nodiscard]] std::int64_t collisionNanoseconds() const;
  /// Of that time, what the thread itself used: without the slices that the system gave to others meanwhile.
  [[nodiscard]] std::int64_t collisionOwnNanoseconds() const;
  /// Steps of the last frame.
  [[nodiscard]] int steps() const;

  // --- osgGA::CameraManipulator

  /// The eye becomes the camera, roll is dropped. See setPose. A matrix that is no camera (not finite) changes nothing.
  void setByMatrix(const osg::Matrixd& matrix) override;
  void setByInverseMatrix(const osg::Matrixd& matrix) override;
  [[nodiscard]] osg::Matrixd getMatrix() const override;
  [[nodiscard]] osg::Matrixd getInverseMatrix() const override;
  void updateCamera(osg::Camera& camera) override;

  /// Only home() asks it, for its size.
  void setNode(osg::Node* node) override;
  [[nodiscard]] const osg::Node* getNode() const override;
  [[nodiscard]] osg::Node* getNode() override;

  /// Goes to the home position. Computed (setAutoComputeHomePosition), that is outside, from where all of the node is
  /// seen, as with every manipulator of osgGA; in walk mode it is a place to stand near the middle of the space.
  void home(double time) override;
  void home(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer) override;
  void init(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer) override;
  /// Ends goTo() where the body is.
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
