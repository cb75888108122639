#include "view/session.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "cli/interrupt.h"
#include "cli/standard_streams.h"
#include "scenes/frame.h"
#include "view/body.h"
#include "view/menu.h"
#include "view/session_handler.h"
#include "view/turntable.h"

namespace roam::app {
namespace {

/// s: how long the first hint stays when the body can walk.
constexpr double hint_seconds = 8.0;

ViewOptions with_scene(ViewOptions options, const SceneAndStore& what) {
  options.scene = what.scene;
  return options;
}

ViewPlan with_bookmark(ViewPlan plan, const std::string& bookmark, Records& records) {
  if (!bookmark.empty()) plan.at = records.named(bookmark);
  return plan;
}

std::unique_ptr<DisplayLoader> load_picture(const SceneAndStore& what, CollisionLoader& collision, const Stage& stage,
                                            std::shared_ptr<SceneObjects> objects, const PageSettings& pages) {
  return what.store_only
             ? std::make_unique<DisplayLoader>(collision.place())
             : std::make_unique<DisplayLoader>(what.scene, stage.texture_quality(), std::move(objects), pages);
}

}  // namespace

// Collision and picture are read from the same files at the same time, by separate processes that fail separately.
Session::Session(const ViewOptions& options, const ViewPlan& plan, const ViewSettings& settings)
    : what_(scene_and_store(options.scene, options.store)),
      options_(with_scene(options, what_)),
      roamer_(make_roamer(plan, settings)),
      news_(what_.scene.scenes, plan.noted),
      commands_(news_),
      records_(what_.scene, *roamer_, news_),
      plan_(with_bookmark(plan, options.bookmark, records_)),
      log_(options.trace, options.verify),
      stage_(options_, plan_),
      cameras_(new Cameras(stage_, *roamer_)),
      arrival_(options_, plan_, what_, *roamer_, news_),
      objects_(std::make_shared<SceneObjects>(options.hide, plan_.hidden)),
      scene_(stage_.viewer(), *stage_.frame().space(),
             load_picture(what_, arrival_.loader(), stage_, objects_, plan_.pages), objects_,
             stage_.headless() ? SceneGraph::Arrival::at_once : SceneGraph::Arrival::smooth),
      display_(stage_, scene_, *roamer_, news_, plan_.fov),
      prompt_(new Prompt(stage_)),
      hidden_(scene_, arrival_, *roamer_, news_, plan_.path.empty() && !options.verify),
      layers_(new Layers(stage_, scene_, hidden_, *roamer_, news_)),
      bookmark_list_(new BookmarkList(stage_, *roamer_, records_, news_)),
      tools_(new Tools(stage_, scene_, *roamer_, *cameras_, hidden_, what_, options.program, plan_.section)),
      controllers_(*this, *prompt_, plan_.sensitivity),
      building_(what_, options.program, *roamer_, news_),
      rereading_(what_, options_, arrival_, *roamer_, display_, records_, building_, news_) {
  if (!plan_.note.empty()) {  // shown each time that it is true again
    news_.tell(plan_.note, true);
    news_.note(plan_.note, {});
  }
  if (const std::string note = link_beside(what_); !note.empty()) news_.note(note);
  stage_.add_to(commands_);
  display_.add_to(commands_);
  layers_->add_to(commands_, *bookmark_list_);
  hidden_.add_to(commands_);
  if (options.pass_hidden) hidden_.pass_through(true);
  commands_.add("store", [this] { building_.toggle(arrival_.pager().get(), place(), arrival_.triangles()); });
  commands_.add("name_bookmark", [this] { records_.ask_name(*prompt_); });
  rereading_.add_to(commands_);
  commands_.add("quit", [this] { quits_ = true; });
  roamer_->setCommandCallback([this](const std::string& name) { run(name, roamer_->down("fast")); });
  stage_.viewer().addEventHandler(prompt_);
  stage_.viewer().addEventHandler(new Menu(*this));
  stage_.viewer().addEventHandler(layers_);
  stage_.viewer().addEventHandler(bookmark_list_);
  stage_.viewer().addEventHandler(tools_);
  stage_.viewer().addEventHandler(new SessionHandler(*this));  // after the list: letters search it
  tells_results_ = !options_.json && !options_.headless;
  // SessionHandler handles Escape; the viewer would end before any other use of the key.
  stage_.viewer().setKeyEventSetsDone(0);
  show_keys();
  stage_.hold_film(options_.turntable.has_value());
  const bool led = stage_.headless() || !plan_.path.empty() || options_.turntable;
  if (!led && options_.record.empty()) stage_.hint(first_hint(roamer_->controls()));
}

Session::~Session() {
  // Cancel all first: each takes a moment to end.
  building_.cancel();
  scene_.cancel();
  arrival_.loader().cancel();
}

bool Session::frame() {
  if (interrupted()) throw Cancelled();
  scene_.update();
  if (!roaming() && arrival_.receive({scene_.state(), scene_.has_pieces(), scene_.origin(), display_.overview()})) {
    enter();
  }
  see_to_store();
  const double passed = stage_.advance(runs());
  news_.set_time(stage_.now());

  arrival_.fly_without_ground();
  if (controllers_.update()) show_keys();
  // Headless frames are not in real time: no step depends on the time that loading takes.
  if (stage_.headless() && roaming()) arrival_.wait_for_tiles(passed);
  stage_.see_events();
  arrival_.fly_without_ground();
  if (learning_ && learning_->update() && replay_) replay_->go_on_here();
  if (quits_ || rereading_.next() || stage_.viewer().done()) return false;
  if (roaming()) {
    if (replay_) replay_->look(*roamer_, passed);
    if (roamer_->steps() > 0) log_.take_frame(roamer_->collisionNanoseconds(), roamer_->collisionOwnNanoseconds());
    records_.add_frame(stage_.now());
  }
  if (options_.turntable) {
    turn_around();
  } else if (!roaming()) {
    display_.look_from_above();
  }
  display_.tell_news();
  const bool at_end = is_at_its_end();
  const bool last = at_end && (options_.screenshot.empty() || scene_.is_complete());
  show(last);
  tell_results();
  if (!last) {
    load_pages_of_film();
    stage_.draw_if_seen(at_end || (options_.turntable && !turning_at_));
  } else if (!options_.screenshot.empty()) {
    picture_.attempt([&] { stage_.draw_picture(options_.screenshot, options_.hud.has_value()); });
  }
  return !last;
}

void Session::enter() {
  if (const SceneIdentity* const scene = arrival_.identity()) {
    learning_.emplace(options_, plan_, *scene, *roamer_, news_);
    learning_->add_to(commands_);
  }
  records_.add_to(commands_, *cameras_);
  bookmark_list_->add_to(commands_, *layers_);
  tools_->add_to(commands_);
  arrival_.enter();
  display_.hurry();  // no film begins with the loading
  show_keys();
  stage_.end_hint(hint_seconds);
  if (const std::string note = stage_.plainness(); !note.empty()) news_.note(note);
  placed_at_ = stage_.now();
  // Placement is not part of the session's path.
  roamer_->setStepCallback([this](const StepReport& report, double seconds) { step_taken(report, seconds); });
  if (plan_.path.empty()) step_taken(roamer_->report(), 0.0);
  cameras_->setNode(stage_.frame().root());
  if (!options_.turntable) stage_.viewer().setCameraManipulator(cameras_, false);
  if (!options_.record_path.empty()) records_.record(options_.record_path);
  if (plan_.path.empty()) return;
  // The path leads at once, and finds missing ground itself, as in `roam walk`.
  replay_.emplace(*roamer_->walker(), plan_.path, RouteOptions{.speed = plan_.walker.speed, .dt = options_.dt});
  replay_->lead(*roamer_);
}

/// Whether time goes on for what the session is for.
bool Session::runs() const {
  if (options_.turntable) return turning_at_.has_value();
  return roaming() && (!replay_ || is_replaying());
}

/// Turns the camera, as soon as everything is to be seen.
void Session::turn_around() {
  if (!turning_at_ && roaming() && scene_.is_complete()) {
    turning_at_ = stage_.now();
    stage_.hold_film(false);
  }
  const double share = turning_at_ ? (stage_.now() - *turning_at_) / *options_.turntable : 0.0;
  display_.look_from(on_turntable(scene_.bounds(), plan_.fov, display_.aspect(), share));
}

/// A film without a screen is made faster or slower than time goes by, so pages are waited for.
void Session::load_pages_of_film() {
  if (!stage_.headless() || !stage_.is_filmed() || !runs() || !scene_.report() || !scene_.report()->paged) return;
  // Over full memory, pages that take each other's place would come for ever.
  constexpr auto longest_full = std::chrono::seconds(60);
  auto full_at = std::chrono::steady_clock::time_point::max();
  stage_.hold_film(true);
  do {
    stop_if_interrupted();
    // Pages grow old by the viewer's time.
    stage_.viewer().advance(stage_.now());
    stage_.draw_if_seen(true);
    scene_.update();
    if (scene_.pages().is_full()) full_at = std::min(full_at, std::chrono::steady_clock::now());
  } while (!scene_.is_complete() && std::chrono::steady_clock::now() - longest_full < full_at);
  stage_.hold_film(false);
}

void Session::step_taken(const StepReport& report, double seconds) {
  log_.take(report, roamer_->mode(), seconds);
  if (seconds <= 0.0 || report.put_back) tools_->jump();
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
  // A replay keeps its walker, and the walker its space.
  if (!roaming() || is_replaying()) return;
  if (std::shared_ptr<Pager> pager = building_.take()) {
    arrival_.change_to(std::move(pager));
    if (learning_) learning_->resize();
    show_keys();
  }
}

/// The body's position, or the expected one.
Vec3 Session::place() const {
  if (roaming()) return roamer_->walker()->position();
  return scene_.bounds().empty() ? Vec3(0.0) : scene_.bounds().center();
}

void Session::show_keys() {
  const std::string key = key_of(roamer_->controls(), "help");
  stage_.hud().set_help(key_lines(roamer_->controls(), controllers_.has_gamepad()));
  if (!stage_.headless()) stage_.hud().set_button(key.empty() ? "Menu" : "Menu: " + key);
}

bool Session::is_at_its_end() const {
  if (!roaming()) return false;
  if (replay_) return replay_->done();
  if (options_.turntable) {
    constexpr double rounding = 1e-6;  // s
    return turning_at_ && stage_.now() - *turning_at_ >= *options_.turntable - rounding;
  }
  if (options_.time_limit > 0.0) return stage_.now() - placed_at_ >= options_.time_limit;
  return !options_.screenshot.empty();
}

void Session::show(bool at_once) {
  graphics::Marks marks;
  if (!stage_.is_still_next()) tools_->add_to(marks);
  hidden_.update(tools_->section());
  layers_->update();
  ListPanel* const list = shown_list();
  if (list != nullptr) {
    list->draw();
  } else {
    stage_.hud().set_list(std::nullopt);
  }
  // The list takes the plan's place.
  tools_->update(roaming(), list == nullptr, records_.places());
  display_.update(roaming(), roaming() && !arrival_.is_ghost_only() ? roamer_->leastEyeDistance() : plan_.walker.radius,
                  std::move(marks));
  if (!at_once && !display_.is_due()) return;
  arrival_.note_failures(stage_.now());
  Status status = display_.status(roaming());
  if (roaming()) {
    const Space* const visible = hidden_.visible();
    status.around = surroundings(*roamer_, visible != nullptr ? *visible : roamer_->walker()->space(),
                                 display_.middle(), tools_->section().hidden());
  }
  if (roaming() && !roamer_leads()) status.camera = cameras_->present();
  if (!options_.origin.empty()) {
    status.georeference = Georeference{{}, {options_.origin[0], options_.origin[1], options_.origin[2]}};
  } else if (scene_.report() && scene_.report()->import.georeference) {
    if (const auto frame = frame_of(what_.scene)) {
      status.georeference = scene_.report()->import.georeference;
      status.georeferenced = *frame;
    }
  }
  arrival_.fill(status);
  building_.fill(status);
  records_.fill(status);
  hidden_.fill(status);
  tools_->fill(status);
  if (learning_) learning_->fill(status);
  display_.show(std::move(status));
}

/// Tells on the terminal what was measured and written, as it happens.
void Session::tell_results() {
  if (!tells_results_) return;
  const auto& measured = tools_->measurements();
  std::string text;
  std::size_t measurements = measurements_told_, files = written_told_;
  // The last one may get its second point.
  for (; measurements < measured.size() && (measured[measurements].b || measurements + 1 < measured.size());
       ++measurements) {
    text += measured_line(measured[measurements]);
  }
  for (; files < news_.files().size(); ++files) text += written_line(news_.files()[files]);
  if (text.empty()) return;
  try {
    print_report(false, {}, text, options_.trace);
    measurements_told_ = measurements;
    written_told_ = files;
  } catch (const std::exception&) {
    tells_results_ = false;  // the report at the end fails
  }
}

std::optional<NextSession> Session::next() const {
  std::optional<NextSession> next = rereading_.next();
  if (!next) return next;
  next->section = tools_->section();
  next->speed = roamer_->speed();
  next->hidden = objects_->decisions();
  next->passes = hidden_.passes();
  next->hud = stage_.hud_mode();
  next->edges = stage_.edges();
  return next;
}

ListPanel* Session::shown_list() {
  if (layers_->is_shown()) return layers_.get();
  return bookmark_list_->is_shown() ? bookmark_list_.get() : nullptr;
}

bool Session::run(const std::string& command, bool shift) {
  using graphics::Detail;
  display_.hurry();
  // The results of these are parts of the display, which a person who gives them wants to see.
  struct Part {
    std::string_view command;
    Detail least;  ///< that shows it
    bool is_on;
  };
  const Part parts[] = {{"help", Detail::minimal, false},
                        {"layers", Detail::minimal, false},
                        {"bookmarks", Detail::minimal, false},
                        {"plan", Detail::minimal, tools_->plan().size() != graphics::PlanSize::none},
                        {"measure", Detail::full, tools_->is_measuring()},
                        {"probe", Detail::full, false}};
  const auto* const part =
      std::find_if(std::begin(parts), std::end(parts), [&](const Part& one) { return one.command == command; });
  if (part != std::end(parts) && stage_.hud().detail() > part->least) {
    stage_.set_hud(HudMode::plain);
    if (part->is_on) return true;
  }
  const bool known = commands_.run(command, shift);
  if (stage_.hud().detail() == Detail::off) {
    // They would take keys and clicks.
    stage_.hud().show_help(false);
    layers_->close();
    bookmark_list_->close();
  }
  return known;
}

void Session::press(const std::string& command, bool shift) {
  if (is_camera(command)) return cameras_->choose(command);
  const osgRoam::Controls::Command* const known = roamer_->controls().find(command);
  if (known == nullptr || known->keys.empty()) return;
  if (roamer_leads()) {
    roamer_->run(command);
  } else {
    run(command, shift);
  }
}

ViewReport Session::finish(Unwritten& unwritten) {
  layers_->finish();
  unwritten.attempt([&] { picture_.raise(); });
  ViewReport report;
  report.scene = options_.scene.names();
  report.noted = report.notes = news_.notes();
  if (replay_) replay_->fill(report);
  if (learning_) report.learned = learning_->taken();
  building_.fill(report);
  arrival_.fill(report);
  display_.fill(report);
  hidden_.fill(report);
  tools_->fill(report);
  unwritten.attempt([&] { records_.finish(); });
  records_.fill(report);
  report.written = news_.files();
  unwritten.attempt([&] { log_.finish(); });
  log_.fill(report);
  stage_.finish(unwritten);
  stage_.fill(report);
  for (std::size_t i = measurements_told_; i < report.measurements.size(); ++i) {
    report.untold += measured_line(report.measurements[i]);
  }
  for (std::size_t i = written_told_; i < report.written.size(); ++i) report.untold += written_line(report.written[i]);
  return report;
}

}  // namespace roam::app
