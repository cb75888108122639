#include "view/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <osgGA/DriveManipulator>
#include <osgGA/FirstPersonManipulator>
#include <osgGA/FlightManipulator>
#include <osgGA/OrbitManipulator>
#include <osgGA/SphericalManipulator>
#include <osgGA/TerrainManipulator>
#include <osgGA/TrackballManipulator>
#include <thread>
#include <utility>

#include "cli/exit_status.h"
#include "cli/interrupt.h"
#include "roam/error.h"
#include "view/session_handler.h"

namespace roam::app {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double headless_frame = 1.0 / 60.0;  // s
// Where nothing else keeps the frames from running free: no screen shows more.
constexpr auto shortest_frame = std::chrono::microseconds(6900);

CollisionWish wish_of(const ViewOptions& options, const ViewPlan& plan, std::uint64_t store_memory) {
  CollisionWish wish;
  wish.keep_meshes = options.verify;
  if (plan.at) {
    wish.place = plan.at->position;
  } else if (!plan.path.empty()) {
    wish.place = plan.path.front().position;
  }
  wish.memory = store_memory;
  wish.walker = plan.walker;
  wish.mode = plan.mode;
  return wish;
}

}  // namespace

Session::Session(const ViewOptions& options, const ViewPlan& plan, const ViewSettings& settings)
    : what_(scene_and_store(options.scene, options.store)),
      options_(options),
      plan_(plan),
      roamer_(new osgRoam::Manipulator),
      log_(options.trace, options.verify),
      begin_(Clock::now()) {
  options_.scene = what_.scene;
  const std::filesystem::path folder = settings_folder();
  try {
    bookmarks_.emplace(folder.empty() ? folder : folder / "bookmarks.json", options_.scene.scenes, options_.scene.up,
                       options_.scene.unit);
  } catch (const Error& error) {
    bookmark_problem_ = error.what();
  }
  if (!options_.bookmark.empty()) {
    if (!bookmarks_) throw Error(bookmark_problem_);
    const std::optional<Bookmark> found = bookmarks_->find(options_.bookmark);
    if (!found) {
      throw UsageError(fmt::format(
          "--bookmark {}: this scene has {}", options_.bookmark,
          bookmarks_->all().empty() ? "no bookmarks; the key B keeps one" : "these: " + bookmarks_->names()));
    }
    plan_.at = found->pose;
  }
  set_up(roamer_->controls(), settings);
  roamer_->setSettings(plan_.walker);
  roamer_->setSpeed(plan_.walker.speed);
  roamer_->setLookSpeed(roamer_->lookSpeed() * plan_.sensitivity);
  roamer_->setLookInverted(plan_.invert_y);
  stage_.emplace(options_, plan_);
  if (!bookmark_problem_.empty()) note(bookmark_problem_);
  if (!plan_.note.empty()) note(plan_.note);
  if (!options_.record.empty()) stage_->start_film(options_.record);
  set_up_cameras();
  stage_->hud().set_help(key_lines(roamer_->controls()));
  // Both read the same files, at the same time: each in a process of its own that can only fail alone.
  collision_.emplace(what_, wish_of(options_, plan_, what_.store_memory));
  auto display = what_.store_only ? std::make_unique<DisplayLoader>(what_.store, collision_->place())
                                  : std::make_unique<DisplayLoader>(what_.scene, stage_->texture_quality());
  scene_.emplace(stage_->viewer(), *stage_->frame().space(), std::move(display),
                 stage_->headless() ? SceneGraph::Arrival::at_once : SceneGraph::Arrival::smooth);
}

Session::~Session() {
  // All at once: each takes a moment to end.
  if (builder_) builder_->cancel();
  scene_->cancel();
  collision_->cancel();
}

void Session::set_up_cameras() {
  cameras_ = new Cameras;
  osgGA::CameraManipulator* const others[] = {
      new osgGA::TrackballManipulator, new osgGA::FlightManipulator, new osgGA::DriveManipulator,
      new osgGA::TerrainManipulator,   new osgGA::OrbitManipulator,  new osgGA::FirstPersonManipulator,
      new osgGA::SphericalManipulator,
  };
  int key = '1';
  cameras_->addMatrixManipulator(key, "roam", roamer_);
  for (osgGA::CameraManipulator* other : others) {
    ++key;
    cameras_->addMatrixManipulator(key, camera_names()[static_cast<std::size_t>(key - '1')], other);
  }
  roamer_->setCommandCallback([this](const std::string& name) { run(parse_command(name)); });
  stage_->viewer().addEventHandler(new SessionHandler(*this));
  // The handler does it: the viewer would end on Escape before anybody could take it for something else.
  stage_->viewer().setKeyEventSetsDone(0);
}

bool Session::frame() {
  if (interrupted()) throw Cancelled();
  const auto frame_begin = Clock::now();
  const bool headless = stage_->headless();
  const double before = now_;
  now_ = headless ? now_ : std::chrono::duration<double>(frame_begin - begin_).count();
  // Before the pieces are taken: where it says that all have been read, all are in the graph after that.
  status_.display = scene_->state();
  status_.collision = collision_->state();
  scene_->update();
  if (!placed_) receive_collision();
  see_to_store();
  if (headless && placed_ && !replay_is_over()) now_ += headless_frame;
  frame_time_ = now_ - before;

  fly_without_ground();
  see_events();
  if (headless && placed_ && pager_) {
    // Whoever walks faster than a person waits for what that person would have had.
    const Walker& walker = *roamer_->walker();
    pager_->wait(walker.body(), walker.position(), walker.velocity(), frame_time_);
  }
  fly_without_ground();
  take_lesson();
  if (quits_ || stage_->viewer().done()) return false;
  if (placed_) {
    if (replay_) look_along_path(frame_time_);
    if (roamer_->steps() > 0) log_.take_frame(roamer_->collisionNanoseconds(), roamer_->collisionOwnNanoseconds());
    record_way();
  } else {
    show_overview();
  }
  tell_of_loading();
  const bool last = wants_end();
  update_status(last);
  update_marks();
  update_near();
  if (last) {
    if (!options_.screenshot.empty()) {
      stage_->draw_picture(options_.screenshot, now_);
      picture_taken_ = true;
      ++frames_;
    }
    return false;
  }
  if (is_watched()) {
    stage_->draw(now_);
    ++frames_;
  } else if (!placed_) {
    // Nothing to see and nothing to do but wait for those who load.
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  for (const Picture& picture : stage_->poll_pictures()) {
    if (picture.problem.empty()) {
      written(picture.file);
    } else {
      note(picture.problem);
    }
  }
  if (!headless) std::this_thread::sleep_until(frame_begin + shortest_frame);
  return true;
}

bool Session::replay_is_over() const { return replay_ && replay_->done(); }

/// Whether a frame must be drawn: someone sees it, a film takes it, or pages are asked for by drawing.
bool Session::is_watched() const {
  if (!stage_->headless()) return true;
  if (!placed_) return false;
  if (stage_->film() && stage_->film()->is_due(now_)) return true;
  return is_at_its_end();
}

bool Session::is_at_its_end() const {
  if (!placed_) return false;
  if (replay_) return replay_->done();
  if (options_.time_limit > 0.0) return now_ - placed_at_ >= options_.time_limit;
  return !options_.screenshot.empty();
}

/// Whether this frame is the last.
bool Session::wants_end() {
  if (!is_at_its_end()) return false;
  return options_.screenshot.empty() || scene_->is_complete();
}

void Session::see_events() {
  osgViewer::Viewer& viewer = stage_->viewer();
  if (!stage_->headless()) {
    viewer.advance();
    viewer.eventTraversal();
    return;
  }
  // Without a screen time is what frame() says, so that a session is the same on every machine.
  viewer.advance(now_);
  osgGA::EventQueue::Events events;
  viewer.getEventQueue()->takeEvents(events);
  osg::ref_ptr<osgGA::GUIEventAdapter> tick =
      new osgGA::GUIEventAdapter(*viewer.getEventQueue()->getCurrentEventState());
  tick->setEventType(osgGA::GUIEventAdapter::FRAME);
  tick->setTime(now_);
  events.push_back(tick);
  for (const auto& event : events) {
    for (const auto& handler : viewer.getEventHandlers()) handler->handle(event, nullptr, viewer.getEventVisitor());
    if (viewer.getCameraManipulator() != nullptr) {
      viewer.getCameraManipulator()->handle(event, nullptr, viewer.getEventVisitor());
    }
  }
}

void Session::show_overview() {
  const double aspect = static_cast<double>(stage_->frame().width()) / std::max(stage_->frame().height(), 1);
  const double down = plan_.fov;
  constexpr double degree = std::numbers::pi / 180.0;
  const double across = 2.0 * std::atan(std::tan(0.5 * down * degree) * aspect) / degree;
  const Pose pose = overview(scene_->bounds(), std::min(down, across));
  const Vec3 eye = pose.position - scene_->origin();
  const double yaw = pose.yaw * degree, pitch = pose.pitch * degree;
  const osg::Vec3d from(eye.x, eye.y, eye.z);
  const osg::Vec3d ahead(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch));
  stage_->viewer().getCamera()->setViewMatrixAsLookAt(from, from + ahead, osg::Vec3d(0, 0, 1));
}

void Session::update_near() {
  graphics::Frame& frame = stage_->frame();
  const double aspect = static_cast<double>(frame.width()) / std::max(frame.height(), 1);
  // Off the body's axis there is a little less room than the radius.
  const double room = placed_ && !ghost_only_ ? roamer_->leastEyeDistance() : plan_.walker.radius;
  const double near = graphics::near_limit(room, frame.vertical_fov(), aspect);
  if (near != frame.near()) frame.set_near(near);
}

ViewReport Session::finish() {
  ViewReport told = report();
  stage_->finish();
  if (recorder_) {
    told.written.push_back(recorder_->close().string());
    recorder_.reset();
  }
  log_.finish();
  for (const auto& file : {options_.trace, options_.record}) {
    if (!file.empty()) told.written.push_back(file.string());
  }
  if (picture_taken_) told.written.push_back(options_.screenshot.string());
  return told;
}

}  // namespace roam::app
