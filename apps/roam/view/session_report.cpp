// What a session tells of itself.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "view/session.h"

namespace roam::app {
namespace {

Times times(const Histogram& histogram, double scale) {
  return {scale * histogram.quantile(0.5), scale * histogram.quantile(0.99), scale * histogram.largest()};
}

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const std::string& one : more) {
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  }
}

}  // namespace

std::string Session::camera_name() const {
  for (const auto& [key, named] : cameras_->getKeyManipMap()) {
    if (named.second.get() == cameras_->getCurrentMatrixManipulator()) return named.first;
  }
  return {};
}

void Session::tell_of_loading() {
  if (!display_told_ && status_.display.phase == LoadState::Phase::failed) {
    display_told_ = true;
    note(fmt::format("{} of the scene can be seen, its walls are there all the same: {}",
                     scene_->has_pieces() ? "not all" : "nothing", status_.display.error));
  }
  if (!display_told_ && scene_->report()) {
    display_told_ = true;
    const DisplayReport& report = *scene_->report();
    for (const auto& sentence : report.notes) note(sentence);
    for (const auto& sentence : report.import.notes) note(sentence);
  }
  if (scene_->missing_pages() > pages_told_) {
    pages_told_ = scene_->missing_pages();
    note(fmt::format("{} page{} of the scene could not be read: coarser ones are shown there ({})", pages_told_,
                     pages_told_ == 1 ? "" : "s", scene_->page_problem()));
  }
}

ViewReport Session::report() {
  ViewReport report;
  report.scene = options_.scene.names();
  report.triangles = status_.triangles;
  report.settings = roamer_->settings();
  report.mode = roamer_->mode();
  if (learning_) report.learned = learning_->taken();
  if (plan_.profile) report.profile = plan_.profile->file.string();
  report.roamed = placed_;
  report.start = start_;
  if (placed_) {
    report.end = pose();
    report.eye = roamer_->eye();
  }
  if (replay_) {
    report.result = replay_->result();
    report.path_ended = replay_->ended();
    report.waypoints = replay_->waypoints();
  }
  const Tally& tally = log_.tally();
  report.steps = tally.steps;
  report.simulated = tally.simulated;
  report.length = tally.length;
  report.throttled = tally.throttled;
  if (tally.least_axis_clearance > 0.0) report.least_axis_clearance = tally.least_axis_clearance;
  report.frames = frames_;
  constexpr double ns_in_ms = 1e-6;
  report.frame_ms = times(stage_->frame_times(), ns_in_ms);
  report.collision_ns = times(log_.collision_times(), 1.0);
  report.collision_own_ns = times(log_.own_collision_times(), 1.0);
  report.resident_bytes = resident_bytes();
  report.world_bytes = status_.world_bytes;
  if (pager_) {
    report.store = pager_->store().name();
    report.paging = pager_->stats();
  }
  report.renderer = stage_->frame().describe();
  std::istringstream hud(stage_->hud().text());
  for (std::string line; std::getline(hud, line);) report.hud.push_back(line);
  report.written = written_;
  report.notes = notes_;
  if (builder_ && builder_->state().phase != LoadState::Phase::done) {
    report.notes.push_back(fmt::format("{} is not finished; what is done is kept, and `roam build` goes on from there",
                                       builder_->output().string()));
  }
  if (report.result && report.result->blocked_at) name_blockage(report);
  if (loaded_) append(report.notes, loaded_->report.notes);
  if (scene_->report()) {
    const DisplayReport& display = *scene_->report();
    append(report.notes, display.notes);
    append(report.notes, display.import.notes);
    report.missing_textures = display.missing_textures;
    report.missing_texture_files = display.missing_texture_files;
    report.missing_pages = display.import.missing_pages;
  }
  report.missing_pages += scene_->missing_pages();
  if (loaded_) report.meshes = std::move(loaded_->meshes);
  report.pieces = log_.take_pieces();
  return report;
}

}  // namespace roam::app
