#include "view/stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "graphics/large_picture.h"
#include "graphics/lettering.h"
#include "osg_plugins/plugins.h"
#include "text/stream_of.h"

namespace roam::app {
namespace {

constexpr double headless_frame = 1.0 / 60.0;  // s
// Limits the frame rate if nothing else does: few screens are faster.
constexpr auto shortest_frame = std::chrono::microseconds(6900);

/// Loads fonts, and OpenSceneGraph's plugins for pictures. Later it loads no other library, whatever a file requests.
void load_plugins() {
  for (const char* plugin : {"png", "jpeg"}) osg_plugins::load(plugin);
  osg_plugins::close_door([](const std::string& name, const osgDB::Options*) {
    std::error_code none;
    const std::filesystem::path file(name);
    return file.is_absolute() && std::filesystem::is_regular_file(file, none) ? name : std::string();
  });
  graphics::load_fonts();
}

/// The size of a screenshot that is drawn in tiles; the window has its shape and is smaller.
std::optional<std::array<int, 2>> large_size(const ViewOptions& options, const ViewPlan& plan) {
  const bool alone = !options.screenshot.empty() && options.record.empty() && !options.hud;
  if (!alone || graphics::is_drawn_at_once(plan.width, plan.height)) return std::nullopt;
  return std::array{plan.width, plan.height};
}

/// The size of the screenshot, which the window may not have; none if it is to be that of the window.
std::optional<std::array<int, 2>> screenshot_size(const ViewOptions& options, const ViewPlan& plan) {
  const bool fills_screen = options.fullscreen && !options.headless && !large_size(options, plan);
  if (options.screenshot.empty() || options.hud || fills_screen) return std::nullopt;
  return std::array{plan.width, plan.height};
}

graphics::Context open(const ViewOptions& options, const ViewPlan& plan) {
  load_plugins();
  int width = plan.width, height = plan.height;
  if (large_size(options, plan)) {
    constexpr double side = 1280.0;  // pixels
    const double scale = side / std::max(width, height);
    const auto scaled = [&](int length) { return std::max(1, static_cast<int>(std::lround(scale * length))); };
    width = scaled(width);
    height = scaled(height);
  }
  if (options.headless) return graphics::open_headless(width, height);
  // A mark in the picture would be in the film.
  const std::string film = options.record.empty() ? "" : "recording " + options.record.filename().string() + ": ";
  return graphics::open_window("roam: " + film + options.scene.names(), width, height);
}

graphics::Quality quality(const std::string& name, const graphics::Context& context) {
  if (name == "light") return graphics::Quality::light;
  if (name == "plain") return graphics::Quality::plain;
  // Without a screen, all that is drawn is a still or part of a film.
  const bool interactive_software = context.abilities.software && !context.headless;
  return name == "auto" && interactive_software ? graphics::Quality::plain : graphics::Quality::full;
}

graphics::Detail detail(HudMode mode) {
  switch (mode) {
    case HudMode::full:
    case HudMode::plain:
      return graphics::Detail::full;
    case HudMode::minimal:
      return graphics::Detail::minimal;
    case HudMode::off:
      break;
  }
  return graphics::Detail::off;
}

/// The modes in the order of the key, and their names for the person.
constexpr std::pair<HudMode, const char*> hud_modes[] = {{HudMode::plain, "display: usual"},
                                                         {HudMode::full, "display: all figures"},
                                                         {HudMode::minimal, "display: one line"},
                                                         {HudMode::off, "display: none"}};

}  // namespace

Stage::Stage(const ViewOptions& options, const ViewPlan& plan)
    : context_(open(options, plan)),
      viewer_(new osgViewer::Viewer),
      screenshot_(screenshot_size(options, plan)),
      picture_scale_(plan.picture_scale) {
  // One thread: events, steps and drawing follow each other, and the picture is at most one frame old.
  viewer_->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  graphics::FrameSettings settings;
  settings.vertical_fov = plan.fov;
  settings.near = graphics::near_limit(plan.walker.radius, plan.fov, static_cast<double>(plan.width) / plan.height);
  settings.quality = quality(plan.quality, context_);
  frame_.emplace(*viewer_, context_, settings);
  is_plain_by_itself_ = plan.quality == "auto" && settings.quality == graphics::Quality::plain;
  if (plan.quality == "auto" && !context_.headless && options.record.empty()) thrift_.emplace();
  if (options.json) frame_->count_draw_calls();
  frame_->set_edges(plan.edges);
  frame_->space()->addChild(graphics::make_sky());
  hud_.emplace(*frame_);
  overlay_.emplace(*frame_);
  set_hud(plan.hud);
  viewer_->realize();
  if (options.fullscreen && !context_.headless) toggle_fullscreen();
  if (options.record.empty()) return;
  film_.emplace(*frame_, options.record, plan.film_rate);
  written_.push_back(options.record.string());
}

TextureQuality texture_quality(const graphics::Abilities& abilities) {
  return abilities.software ? TextureQuality{1.0f} : TextureQuality{};
}

std::string Stage::quality_note() const {
  if (!drawn_less_.empty()) return drawn_less_;
  return context_.abilities.software && frame_->quality() == graphics::Quality::plain ? "plain: no graphics card" : "";
}

std::string Stage::plainness() const {
  if (!is_plain_by_itself_) return {};
  return "no graphics card: drawn plain, without shadows, gloss, ambient occlusion, lines and smoothing; --quality "
         "light "
         "or full draws more";
}

void Stage::show(const Status& status) {
  constexpr int roomy = 480;  // pixels: the usual lines and those of a tool leave half of the picture free
  std::vector<graphics::StatusLine> lines;
  for (const StatusText& line : status_lines(status)) {
    if (line.figures && hud_mode_ != HudMode::full) continue;
    if (line.yields && !status.tool.empty() && frame_->height() < roomy) continue;
    lines.push_back({line.label, line.value, line.warning ? graphics::Tone::warning : graphics::Tone::info});
  }
  hud_->set_status(std::move(lines));
  hud_->set_recording(status.recording);
  const Told message = status_message(status);
  hud_->set_message(message.text, message.warning ? graphics::Tone::warning : graphics::Tone::info);
  double share = load_share(status.display, status.collision);
  if (share < 0.0 && status.building) share = load_share(status.display, *status.building);
  hud_->set_progress(share);
  hud_->set_crosshair(status.mode.has_value() && status.camera.empty());
}

void Stage::set_hud(HudMode mode) {
  hud_mode_ = mode;
  hud_->set_detail(detail(mode));
}

void Stage::add_to(Commands& commands) {
  constexpr double busy_seconds = 3.0;
  commands.add("help", [this] {
    if (hud_->help_goes_on()) {
      hud_->turn_help(1);
    } else {
      hud_->show_help(!hud_->help_shown());
    }
    end_hint(0.0);  // it would lie over the help
  });
  commands.add("hud", [this] { cycle_hud(); });
  commands.add("edges", [this] { frame_->set_edges(!frame_->edges()); });
  commands.add("fullscreen", [this] { toggle_fullscreen(); });
  for (const auto& [name, with_display] : {std::pair("picture", false), std::pair("picture_with_display", true)}) {
    commands.add(name, [this, with_display = with_display] {
      if (is_writing_much()) return hint("Earlier pictures are still being written.", busy_seconds);
      if (!with_display && picture_scale_ > 1.0) {
        enlarged_in_ = 2;
        hint(fmt::format("Writing {} x {} ...", enlarged_size()[0], enlarged_size()[1]));
        return;
      }
      (with_display ? picture_wanted_ : still_wanted_) = true;
      pictures_.emplace_back(*frame_, "roam.png", with_display, files::Naming::numbered);
    });
  }
}

void Stage::cycle_hud() {
  constexpr double name_seconds = 1.5;
  const auto* const now = std::find_if(std::begin(hud_modes), std::end(hud_modes),
                                       [this](const auto& mode) { return mode.first == hud_mode_; });
  const auto& [mode, name] = hud_modes[static_cast<std::size_t>(now - hud_modes + 1) % std::size(hud_modes)];
  set_hud(mode);
  hint(name, name_seconds);
}

void Stage::hint(const std::string& text, double seconds) {
  hint_ = text;
  hint_end_ = now_ + seconds;
}

void Stage::fade_hint() {
  constexpr double fading = 1.0;   // s
  constexpr double shades = 10.0;  // each is laid out anew
  const double opacity = std::clamp(std::ceil(shades * (hint_end_ - now_) / fading) / shades, 0.0, 1.0);
  if (opacity <= 0.0) hint_.clear();
  if (question_.empty()) {
    hud_->set_hint(hint_, opacity);
  } else {
    hud_->set_hint(question_);
  }
}

void Stage::toggle_fullscreen() {
  if (context_.headless) return;
  osgViewer::GraphicsWindow& window = *context_.window;
  auto* screens = osg::GraphicsContext::getWindowingSystemInterface();
  if (screens == nullptr) return;
  unsigned int screen_width = 0, screen_height = 0;
  screens->getScreenResolution(*window.getTraits(), screen_width, screen_height);
  const int across = static_cast<int>(screen_width), down = static_cast<int>(screen_height);
  if (fullscreen_) {
    window.setWindowDecoration(true);
    // Centre the window: without a window manager, OpenSceneGraph reports twice its true position.
    window.setWindowRectangle((across - width_) / 2, (down - height_) / 2, width_, height_);
  } else {
    width_ = frame_->width();
    height_ = frame_->height();
    window.setWindowDecoration(false);
    window.setWindowRectangle(0, 0, across, down);
  }
  fullscreen_ = !fullscreen_;
}

double Stage::advance(bool runs) {
  const double before = now_;
  runs_ = runs;
  frame_begin_ = Clock::now();
  if (!headless()) {
    now_ = std::chrono::duration<double>(frame_begin_ - begin_).count();
  } else if (runs) {
    now_ += headless_frame;
  }
  fade_hint();
  return now_ - before;
}

void Stage::see_events() {
  if (!headless()) {
    viewer_->advance();
    viewer_->eventTraversal();
    return;
  }
  viewer_->advance(now_);
  osgGA::EventQueue::Events events;
  viewer_->getEventQueue()->takeEvents(events);
  osg::ref_ptr<osgGA::GUIEventAdapter> tick =
      new osgGA::GUIEventAdapter(*viewer_->getEventQueue()->getCurrentEventState());
  tick->setEventType(osgGA::GUIEventAdapter::FRAME);
  tick->setTime(now_);
  events.push_back(tick);
  for (const auto& event : events) {
    for (const auto& handler : viewer_->getEventHandlers()) handler->handle(event, nullptr, viewer_->getEventVisitor());
    if (auto* const camera = viewer_->getCameraManipulator())
      camera->handle(event, nullptr, viewer_->getEventVisitor());
  }
}

void Stage::draw() {
  if (is_filmed()) film_->before_frame(now_);
  const auto begin = Clock::now();
  if (thrift_) frame_->set_timed(thrift_->doubts());
  // Pages are loaded in the detail of the picture that they are for.
  if (screenshot_) {
    const double detail = static_cast<double>(frame_->height()) / (*screenshot_)[1];
    viewer_->getCamera()->setLODScale(static_cast<float>(std::min(detail, 1.0)));
  }
  viewer_->updateTraversal();
  viewer_->renderingTraversals();
  const double ns = std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
  if (times_.count() > 0) last_ms_ = ns * 1e-6;
  times_.add(ns);
  draw_calls_.add(frame_->draw_calls());
  if (thrift_ && runs_) draw_less_if_slow(begin, ns * 1e-6);
  still_wanted_ = picture_wanted_ = false;
  if (enlarged_in_ > 0 && --enlarged_in_ == 0) take_enlarged();
}

/// On a slow card. It stays so: a picture that changes back and forth is worse.
void Stage::draw_less_if_slow(Clock::time_point begin, double ms) {
  constexpr double seconds = 5.0;
  using graphics::Quality;
  const graphics::FrameTimes& times = frame_->times();
  const double drawn_ms = std::chrono::duration<double, std::milli>(times.drawn - times.waited - begin).count();
  const std::optional<double> median = thrift_->take(ms, drawn_ms);
  if (!median || frame_->quality() == Quality::plain) return;
  const bool light = frame_->quality() == Quality::full;
  frame_->set_quality(light ? Quality::light : Quality::plain);
  drawn_less_ = fmt::format("{}: frames took {:.0f} ms", light ? "light" : "plain", *median);
  hint("Drawing is now " + drawn_less_, seconds);
}

void Stage::draw_if_seen(bool wanted) {
  if (!headless()) {
    draw();
    std::this_thread::sleep_until(frame_begin_ + shortest_frame);
  } else if (wanted || (runs_ && is_filmed())) {
    draw();
  } else if (!runs_) {
    // Nothing to draw: leave the processor to the loaders.
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

void Stage::fill(ViewReport& report) const {
  constexpr double ns_in_ms = 1e-6;
  report.frames = times_.count();
  report.frame_ms = times(times_, ns_in_ms);
  report.draw_calls = times(draw_calls_, 1.0);
  for (double* calls : {&report.draw_calls.median, &report.draw_calls.p99}) *calls = std::round(*calls);
  report.renderer = frame_->describe();
  report.hud = parts_of(hud_->text(), '\n');
  report.written.insert(report.written.end(), written_.begin(), written_.end());
}

}  // namespace roam::app
