// roam view: opens a window in which a person roams through a scene.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/standard_streams.h"
#include "cli/tell.h"
#include "graphics/display_hold.h"
#include "roam/error.h"
#include "scenes/beside_scene.h"
#include "scenes/frame.h"
#include "verbs.h"
#include "verify/verify_stored.h"
#include "view/gamepad.h"
#include "view/notices.h"
#include "view/session.h"

namespace roam::app {
namespace {

/// Reads the settings. Turns their errors into usage errors: the command line or this file must change.
ViewSettings read_settings_for(const ViewOptions& options) {
  try {
    return find_settings(options.settings);
  } catch (const Error& error) {
    throw UsageError(error);
  }
}

/// The table of keys. Throws UsageError for invalid keys in the settings.
std::string keys_of(const ViewSettings& settings) {
  const osg::ref_ptr<osgRoam::Manipulator> roamer = new osgRoam::Manipulator;
  try {
    set_up(roamer->controls(), settings);
  } catch (const Error& error) {
    throw UsageError(error);
  }
  return key_table(roamer->controls());
}

/// The scene's profile, unless the options describe a body.
std::optional<SceneProfile> profile_for(const ViewOptions& options, const std::optional<RecordedBody>& recorded) {
  if (options.scene.no_profile || options.body.describe_a_body()) return std::nullopt;
  return find_scene_profile(options.scene, options.mode.value_or(recorded ? recorded->mode : Mode::walk), recorded);
}

/// Verifies every move: against the scene as read, or the store as stored.
verification::Verification verified(const ViewReport& report, const ViewOptions& options,
                                    const std::function<bool(std::uint64_t)>& progress) {
  if (report.store.empty() || !report.meshes.empty()) return verify(report.meshes, report.pieces, progress);
  const std::uint64_t memory = options.scene.manifest_memory();
  const bool named = !options.store.empty() || options.scene.name_a_store();
  const auto store =
      named ? Store::open(report.store, memory, options.scene.web) : open_store_beside(report.store, memory);
  return verify(*store, report.pieces, progress);
}

/// One session, to its end, Ctrl-C or an error. The report is that of the sessions before, and goes on. Returns how the
/// person wants to go on.
std::optional<NextSession> run_session(const ViewOptions& options, const ViewPlan& plan, const ViewSettings& settings,
                                       ViewReport& report, Unwritten& unwritten, bool& cancelled) {
  Session session(options, plan, settings);
  bool failed = false;
  try {
    while (session.frame()) {
    }
  } catch (const Cancelled&) {
    // Write, verify and report what there is so far.
    cancelled = true;
    give_time_to_write(longest_writing);
  } catch (const Error&) {
    if (!session.roaming() && !report.roamed) throw;
    unwritten.attempt([] { throw; });  // raised after the report
    failed = true;
  }
  ViewReport earlier = std::exchange(report, session.finish(unwritten));
  add_earlier(report, std::move(earlier));
  return cancelled || failed ? std::nullopt : session.next();
}

ExitStatus view(ViewOptions options) {
  make_notices_printable();
  Gamepads::need_no_bus();
  const ViewSettings settings = read_settings_for(options);
  const std::string keys = keys_of(settings);
  if (options.keys) {
    print(keys);
    return done;
  }
  if (options.scene.scenes.empty()) throw UsageError("view", "which scene? Give it a file or a folder");
  take_kept_frame(options.scene);
  const RecordedPath path = load_recorded_path(options.path);
  if (path.frame) demand_frame(path, frame_of(options.scene), options.scene);
  ViewPlan plan = make_plan(options, settings, path.body, profile_for(options, path.body));
  plan.path = path.waypoints();
  std::optional<tbb::global_control> limit;
  if (options.scene.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.scene.threads));
  }
  ViewReport report;
  Unwritten unwritten;
  bool cancelled = false;
  const ViewOptions given = options;
  std::optional<graphics::DisplayHold> hold;
  if (!options.headless) hold.emplace();
  try {
    while (const std::optional<NextSession> next = run_session(options, plan, settings, report, unwritten, cancelled)) {
      const std::string note = go_on(options, *next, given);
      plan = make_plan(options, settings, std::nullopt, profile_for(options, std::nullopt));
      plan.note = note;
      plan.noted = report.noted;
      keep_view(plan, *next);
    }
  } catch (const Error&) {
    if (!report.roamed) throw;
    unwritten.attempt([] { throw; });  // another session does not begin; those before have a report
  }
  hold.reset();  // Xlib ends a program whose server goes away
  const std::string picture = options.screenshot.string();
  if (!picture.empty() && !unwritten.any() &&
      std::find(report.written.begin(), report.written.end(), picture) == report.written.end()) {
    report.notes.push_back(picture + " was not written: the session ended before its picture was drawn" +
                           earlier_stays(picture));
  }
  for (const std::string& note : report.notes) {
    if (std::find(report.noted.begin(), report.noted.end(), note) == report.noted.end()) tell("note: " + note);
  }
  if (options.verify && report.roamed) {
    Progress progress("verifying", "pieces");
    try {
      report.verified = verified(report, options, [&](std::uint64_t checked) {
        return progress.goes_on(checked, report.pieces.size()) || has_time();
      });
    } catch (const Cancelled&) {
      cancelled = true;
      tell(fmt::format("note: the {} moves were not all verified: Ctrl-C came before", report.pieces.size()));
    }
  }
  print_report(options.json, json_report(report), text_report(report) + kept_frame_line(options.scene), options.trace);
  unwritten.raise();
  if (cancelled || interrupted()) throw Cancelled();
  if (report.verified) verification::demand_all_read(*report.verified, report.store);
  const bool reached = report.path_ended && report.result->outcome == Outcome::reached;
  return report.result && !reached ? answer_no : done;
}

constexpr const char* view_help =
    R"(W A S D and the mouse move you, H shows all keys. Gravity pulls you down and walls stop you; the
display says what stops you. The window opens at once; you are held until the walls are loaded.

Positions are of the body's centre, in metres, with z up. The body is a person of radius 0.3 m and height 1.8 m,
or the one that `roam train` saved. A path that was recorded here names its body.

A collision store (`roam build`) beside the scene is used if you built it: then the walls are loaded at once, in little
memory, for scenes of any size.

A gamepad or a SpaceMouse moves you, too, if roam was built with SDL2 or libspnav: the left stick walks, the right one
looks, Start shows the menu.

Keys, mouse and body can be changed in roam/settings.json in $XDG_CONFIG_HOME or ~/.config. Bookmarks are kept beside
it. With --path, --screenshot, --turntable or --time the program ends by itself, and works with --headless. Exit status
3 if the body does not reach the end of its path.

Examples:
  roam view mine.dae
  roam view house.glb --mode fly --at 1,2,1.5,90
  roam view mine.dae --path tour.path --record tour.mp4
  roam view Data/ --store dam.roam --memory 256M
  roam view Terrain/ --headless --screenshot terrain.png --size 1920x1080
)";

}  // namespace

void add_view(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("view", "Open a window on a scene and roam in it");
  verb->footer(view_help);
  const auto options = std::make_shared<ViewOptions>();
  options->add_to(*verb);
  verb->callback([options, &run] { run = [options] { return view(*options); }; });
}

}  // namespace roam::app
