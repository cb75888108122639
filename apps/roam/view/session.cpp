#include "view/session.h"

#include <map>
#include <memory>
#include <thread>

#include "cli/interrupt.h"
#include "roam/error.h"
#include "view/body.h"
#include "view/session_handler.h"

namespace roam::app {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double headless_frame = 1.0 / 60.0;  // s
// Where nothing else keeps the frames from running free: no screen shows more.
constexpr auto shortest_frame = std::chrono::microseconds(6900);

ViewOptions with_scene(ViewOptions options, const SceneAndStore& what) {
  options.scene = what.scene;
  return options;
}

ViewPlan with_bookmark(ViewPlan plan, const std::string& bookmark, Records& records) {
  if (!bookmark.empty()) plan.at = records.named(bookmark);
  return plan;
}

void look_along(Replay& replay, double seconds, osgRoam::Manipulator& roamer) {
  if (replay.done()) return;
  const Replay::Gaze gaze = replay.gaze(seconds);
  roamer.look(gaze.yaw, gaze.pitch);
}

std::unique_ptr<DisplayLoader> load_picture(const SceneAndStore& what, CollisionLoader& collision, const Stage& stage) {
  return what.store_only ? std::make_unique<DisplayLoader>(what.store, collision.place())
                         : std::make_unique<DisplayLoader>(what.scene, stage.texture_quality());
}

}  // namespace

// Collision and picture are read from the same files at the same time, each by a process that can only fail alone.
Session::Session(const ViewOptions& options, const ViewPlan& plan, const ViewSettings& settings)
    : what_(scene_and_store(options.scene, options.store)),
      options_(with_scene(options, what_)),
      roamer_(make_roamer(plan, settings)),
      news_(what_.scene.scenes),
      records_(what_.scene, *roamer_, news_),
      plan_(with_bookmark(plan, options.bookmark, records_)),
      log_(options.trace, options.verify),
      stage_(options_, plan_),
      cameras_(new Cameras(*roamer_)),
      arrival_(options_, plan_, what_, *roamer_, news_),
      scene_(stage_.viewer(), *stage_.frame().space(), load_picture(what_, arrival_.loader(), stage_),
             stage_.headless() ? SceneGraph::Arrival::at_once : SceneGraph::Arrival::smooth),
      display_(stage_, scene_, *roamer_, news_, plan_.fov),
      building_(what_, options.program, *roamer_, news_) {
  for (const std::string& note : {plan_.note, link_beside(what_)}) {
    if (!note.empty()) news_.note(note);
  }
  roamer_->setCommandCallback([this](const std::string& name) { run(parse_command(name)); });
  stage_.viewer().addEventHandler(new SessionHandler(*this));
  // The handler does it: the viewer would end on Escape before anybody could take it for something else.
  stage_.viewer().setKeyEventSetsDone(0);
  show_keys();
}

Session::~Session() {
  // All at once: each takes a moment to end.
  building_.cancel();
  scene_.cancel();
  arrival_.loader().cancel();
}

bool Session::frame() {
  if (interrupted()) throw Cancelled();
  const auto begin = Clock::now();
  const bool headless = stage_.headless();
  const double before = now_;
  if (!headless) now_ = std::chrono::duration<double>(begin - begin_).count();
  news_.set_time(now_);
  scene_.update();
  if (!roaming() && arrival_.receive({scene_.state(), scene_.has_pieces(), scene_.origin(), display_.overview()})) {
    enter();
  }
  see_to_store();
  if (headless && roaming() && !(replay_ && replay_->done())) now_ += headless_frame;
  const double passed = now_ - before;

  arrival_.fly_without_ground();
  stage_.see_events(now_);
  // Headless frames run faster than real time: they wait for tiles that would have loaded meanwhile.
  if (headless && roaming()) arrival_.wait_for_tiles(passed);
  arrival_.fly_without_ground();
  if (learning_) learning_->update();
  if (quits_ || stage_.viewer().done()) return false;
  if (roaming()) {
    if (replay_) look_along(*replay_, passed, *roamer_);
    if (roamer_->steps() > 0) log_.take_frame(roamer_->collisionNanoseconds(), roamer_->collisionOwnNanoseconds());
    records_.add_frame(now_);
  } else {
    display_.look_from_above();
  }
  display_.tell_news();
  const bool last = is_at_its_end() && (options_.screenshot.empty() || scene_.is_complete());
  show(last);
  draw(last);
  if (!last && !headless) std::this_thread::sleep_until(begin + shortest_frame);
  return !last;
}

void Session::enter() {
  if (const SceneIdentity* const scene = arrival_.identity()) {
    learning_.emplace(options_, plan_, *scene, *roamer_, news_);
  }
  arrival_.enter();
  show_keys();
  placed_at_ = now_;
  // The way that led here is none of the session's.
  roamer_->setStepCallback([this](const StepReport& report, double seconds) { step_taken(report, seconds); });
  if (plan_.path.empty()) step_taken(roamer_->report(), 0.0);
  cameras_->setNode(stage_.frame().root());
  stage_.viewer().setCameraManipulator(cameras_, false);
  if (!options_.record_path.empty()) records_.record(options_.record_path);
  if (plan_.path.empty()) return;
  replay_.emplace(*roamer_->walker(), plan_.path, RouteOptions{.speed = plan_.walker.speed, .dt = options_.dt});
  // The pilot first: whether there is something to stand on is the path's to find out, as in `roam walk`.
  roamer_->setPilot([this](Walker&, double) { return replay_->advance(); });
  roamer_->placed();
  look_along(*replay_, 0.0, *roamer_);
}

void Session::step_taken(const StepReport& report, double seconds) {
  log_.take(report, roamer_->mode(), seconds);
  const bool has_body = roamer_->walker() != nullptr;
  const Vec3 wish = !has_body ? Vec3(0.0) : replay_ && !replay_->left() ? replay_->wish() : wish_of(*roamer_);
  display_.watch(report, wish);
  if (!has_body) return;
  if (learning_) learning_->watch(wish, report.elapsed);
  arrival_.watch_footing(report, seconds);
}

void Session::see_to_store() {
  if (const auto choice = arrival_.loader().take_choice()) building_.consider(*choice);
  if (arrival_.loader().wants_store()) building_.recommend();
  building_.follow(place());
  // A path that is being replayed keeps its walker, and that its space.
  if (!roaming() || (replay_ && !replay_->done())) return;
  if (std::shared_ptr<Pager> pager = building_.take()) {
    arrival_.change_to(std::move(pager));
    if (learning_) learning_->resize();
    show_keys();
  }
}

/// Where the body is, or probably will be.
Vec3 Session::place() const {
  if (roaming()) return roamer_->walker()->position();
  return scene_.bounds().empty() ? Vec3(0.0) : scene_.bounds().center();
}

void Session::show_keys() { stage_.hud().set_help(key_lines(roamer_->controls())); }

bool Session::is_at_its_end() const {
  if (!roaming()) return false;
  if (replay_) return replay_->done();
  if (options_.time_limit > 0.0) return now_ - placed_at_ >= options_.time_limit;
  return !options_.screenshot.empty();
}

/// Whether a frame must be drawn: someone sees it, a film takes it, or drawing asks for pages.
bool Session::is_watched() const {
  if (!stage_.headless()) return true;
  return roaming() && ((stage_.film() && stage_.film()->is_due(now_)) || is_at_its_end());
}

void Session::show(bool at_once) {
  display_.update(roaming(),
                  roaming() && !arrival_.is_ghost_only() ? roamer_->leastEyeDistance() : plan_.walker.radius);
  if (!at_once && !display_.is_due(now_)) return;
  arrival_.note_failures(now_);
  Status status = display_.status(roaming());
  if (roaming() && !roamer_leads()) status.camera = cameras_->present();
  arrival_.fill(status);
  building_.fill(status);
  records_.fill(status);
  if (learning_) learning_->fill(status);
  display_.show(std::move(status), now_);
}

void Session::draw(bool last) {
  if (last && !options_.screenshot.empty()) {
    stage_.draw_picture(options_.screenshot, now_);
    picture_taken_ = true;
  } else if (!last && is_watched()) {
    stage_.draw(now_);
  } else if (!roaming()) {
    // Nothing to see and nothing to do but wait for those who load.
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

void Session::run(Command command) {
  static const std::map<Command, void (*)(Session&)> deeds = {
      {Command::help, [](Session& s) { s.stage_.hud().show_help(!s.stage_.hud().help_shown()); }},
      {Command::hud, [](Session& s) { s.stage_.cycle_hud(); }},
      {Command::fullscreen, [](Session& s) { s.stage_.toggle_fullscreen(); }},
      {Command::marks, [](Session& s) { s.display_.toggle_marks(); }},
      {Command::picture, [](Session& s) { s.stage_.take_picture("roam.png"); }},
      {Command::store, [](Session& s) { s.building_.toggle(s.arrival_.pager(), s.place()); }},
      {Command::quit, [](Session& s) { s.quits_ = true; }},
  };
  static const std::map<Command, void (*)(Session&)> deeds_of_a_body = {
      {Command::record, [](Session& s) { s.records_.toggle_recording(); }},
      {Command::bookmark, [](Session& s) { s.records_.add_bookmark(); }},
      {Command::next_bookmark, [](Session& s) { s.records_.go_to_next_bookmark(s.roamer_->down("fast")); }},
      {Command::adapt,
       [](Session& s) {
         if (s.learning_) s.learning_->accept();
       }},
  };
  try {
    if (const auto deed = deeds.find(command); deed != deeds.end()) deed->second(*this);
    if (const auto deed = deeds_of_a_body.find(command); roaming() && deed != deeds_of_a_body.end()) {
      deed->second(*this);
    }
  } catch (const Error& error) {
    news_.note(error.what());
  }
  display_.hurry();
}

bool Session::escape() {
  if (stage_.hud().help_shown()) {
    stage_.hud().show_help(false);
  } else if (roamer_->mouseGrab()) {
    roamer_->setMouseGrab(false);
  } else {
    return false;
  }
  return true;
}

ViewReport Session::finish() {
  ViewReport report;
  report.scene = options_.scene.names();
  report.notes = news_.notes();
  if (replay_) replay_->fill(report);
  if (learning_) report.learned = learning_->taken();
  building_.fill(report);
  arrival_.fill(report);
  display_.fill(report);
  add_steps(report, log_);
  stage_.finish();
  records_.finish();
  log_.finish();
  report.written = news_.files();
  if (!options_.trace.empty()) report.written.push_back(options_.trace.string());
  if (!options_.record.empty()) report.written.push_back(options_.record.string());
  if (picture_taken_) report.written.push_back(options_.screenshot.string());
  return report;
}

}  // namespace roam::app
