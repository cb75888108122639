#pragma once
/// A session of roam view that a test drives frame by frame, without a screen.

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>

#include "view/session.h"
#include "view_scenes.h"

/// The input of a session with these `options`.
class DrivenSession {
 public:
  DrivenSession() {
    use_no_settings(folder);
    setenv("ROAM_READER", ROAM_READER_PROGRAM, 1);
    options.headless = true;
    options.size = "160x100";
    options.time_limit = 1e6;
  }
  ~DrivenSession() {
    session.reset();
    unsetenv("ROAM_READER");
  }

  std::string write_scene(const std::string& text = room_obj()) {
    const std::string file = folder.write("scene.obj", text);
    options.scene.scenes = {file};
    return file;
  }
  /// The report of the session, which is at its end.
  [[nodiscard]] roam::app::ViewReport finish() {
    roam::app::Unwritten unwritten;
    roam::app::ViewReport report = session->finish(unwritten);
    unwritten.raise();
    return report;
  }
  /// Runs frames until the session can roam.
  void begin(const roam::app::ViewSettings& settings = {}) {
    session.emplace(options, roam::app::make_plan(options, settings), settings);
    if (!until([this] { return session->roaming(); })) throw std::runtime_error("nothing was loaded");
  }
  /// Runs frames until a condition holds; false if it does not within five minutes: builds have a low priority.
  template <class Done>
  bool until(const Done& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    while (!done() && std::chrono::steady_clock::now() < end) {
      if (!session->frame()) return false;
    }
    return done();
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 60.0 + 0.5); ++i) ASSERT_TRUE(session->frame());
  }
  void press(int key) { events().keyPress(key); }
  void release(int key) { events().keyRelease(key); }
  void tap(int key) {
    press(key);
    release(key);
    run(1.0 / 60.0);
  }
  [[nodiscard]] const roam::Vec3& place() { return session->roamer().walker()->position(); }
  [[nodiscard]] std::string hud() {
    run(0.2);
    return session->stage().hud().text();
  }

  osgGA::EventQueue& events() { return *session->stage().viewer().getEventQueue(); }

  TestFolder folder;
  roam::app::ViewOptions options;
  std::optional<roam::app::Session> session;
};
