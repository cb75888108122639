#include "view/status.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "cli/progress.h"
#include "text/number.h"
#include "text/printable.h"
#include "text/reference_system.h"
#include "words/measures.h"

namespace roam::app {
namespace {

using Phase = LoadState::Phase;

/// The finished shares of the collision's loading after reading, and after indexing; the search for a start follows.
constexpr double reading_share = 0.6;
constexpr double indexing_share = 0.95;

double share_of(const LoadState& state) {
  switch (state.phase) {
    case Phase::comparing:
      return 0.0;
    case Phase::reading:
      return reading_share * state.share;
    case Phase::indexing:
      return reading_share + (indexing_share - reading_share) * state.share;
    case Phase::looking:
      return indexing_share;
    default:
      return 1.0;
  }
}

std::string body_text(const Status& status) {
  const WalkerSettings& body = status.body;
  std::string text = body.height > 2.0 * body.radius
                         ? fmt::format("radius {:.2f} m, height {:.2f} m", body.radius, body.height)
                         : fmt::format("sphere, radius {:.2f} m", body.radius);
  if (body.support_radius > body.radius) text += fmt::format(", support disc {:.2f} m", body.support_radius);
  if (status.crouched) text += ", crouched";
  if (!status.size_reason.empty()) text += fmt::format(" ({})", status.size_reason);
  return text;
}

/// "64 MB, 512 tiles, ready 35 m, 3 failed"
std::string paging_text(const PagerStats& paging) {
  // MiB, the unit of --memory.
  constexpr double mebi = 1 << 20;
  std::string text = fmt::format("{:.0f} MiB, {} tiles", static_cast<double>(paging.memory) / mebi, paging.tiles);
  text += std::isfinite(paging.ready_radius) ? fmt::format(", ready {:.0f} m", paging.ready_radius)
                                             : std::string(", all ready");
  if (paging.failed > 0) text += fmt::format(", {} failed", paging.failed);
  return text;
}

std::string mode_text(const Status& status) {
  if (!status.camera.empty()) return status.camera + "  (1: back to the body)";
  if (!status.mode) return "loading";
  std::string text = fmt::format("{}  {:.1f} m/s", to_string(*status.mode), status.speed);
  if (*status.mode == Mode::walk && !status.grounded) text += "  in the air";
  return text;
}

/// "on the floor", "1.20 m above the floor"; empty if no floor is known below.
std::string height_text(const Status& status) {
  if (!status.around.above_floor) return {};
  constexpr double resting = 0.05;  // m: on foot, less is the unevenness of the floor
  const double height = *status.around.above_floor;
  if (status.grounded && height < resting) return "on the floor";
  return fmt::format("{:.2f} m above the floor", height);
}

/// "Door_12, 3.20 m"
std::string ahead_text(const Surroundings& around) {
  if (!around.ahead_m) return {};
  const std::string name = around.ahead.empty() ? std::string() : printable(around.ahead) + ", ";
  return fmt::format("{}{:.2f} m", name, *around.ahead_m);
}

}  // namespace

Bearing bearing_of(double yaw) {
  constexpr const char* winds[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  constexpr int circle = 360, sector = 45;
  const int degrees = static_cast<int>(std::lround(90.0 - std::remainder(yaw, double(circle))) + circle) % circle;
  return {degrees, winds[(degrees + sector / 2) / sector % 8]};
}

std::string heading_text(double yaw, double pitch) {
  const auto [bearing, wind] = bearing_of(yaw);
  const int up = static_cast<int>(std::lround(pitch));
  const std::string slope = up == 0 ? "level" : fmt::format("{}\u00b0 {}", std::abs(up), up > 0 ? "up" : "down");
  return fmt::format("{}\u00b0 {}, {}", bearing, wind, slope);
}

std::string load_text(const char* what, const LoadState& state) {
  if (state.phase == Phase::done) return {};
  if (state.phase == Phase::failed)
    return fmt::format("{} failed: {}", what, printable(state.error.what(), longest_sentence));
  if (state.phase == Phase::comparing) return fmt::format("{}: comparing the scene with its store", what);
  if (state.phase == Phase::looking) return fmt::format("{}: looking for a place to start", what);
  std::string text = fmt::format("{} {:.0f} %", what, 100.0 * share_of(state));
  if (state.triangles > 0) text += fmt::format(": {} triangles", short_count(static_cast<double>(state.triangles)));
  if (state.seconds_left >= 0.0) {
    text += fmt::format("{} {} left", state.triangles > 0 ? "," : ":", short_time(state.seconds_left));
  }
  return text;
}

double load_share(const LoadState& display, const LoadState& collision) {
  if (is_over(display) && is_over(collision)) return -1.0;
  // The body waits for the collision; the picture loads in parallel.
  return is_over(collision) ? display.share : share_of(collision);
}

std::string site_text(const Status& status, const Vec3& point) {
  if (!status.georeference) return {};
  const auto& [srs, origin] = *status.georeference;
  const auto rows = status.georeferenced.to_file();
  Vec3 site = origin;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) site[i] += rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] * point[k];
  }
  return fmt::format("{}, {}, {}{}{}", fixed_text(site.x, 2), fixed_text(site.y, 2), fixed_text(site.z, 2),
                     srs.empty() ? "" : " ", reference_name(srs));
}

std::vector<StatusText> status_lines(const Status& status) {
  std::vector<StatusText> lines;
  lines.push_back({"", mode_text(status), false});
  if (status.mode && status.camera.empty()) {
    const Vec3& p = status.around.feet;
    const auto add = [&](const char* label, std::string value) {
      if (!value.empty()) lines.push_back({label, std::move(value), false, false, true});
    };
    add("feet", fmt::format("{}, {}, {}", fixed_text(p.x, 2), fixed_text(p.y, 2), fixed_text(p.z, 2)));
    add("site", site_text(status, p));
    add("height", height_text(status));
    add("heading", heading_text(status.yaw, status.pitch));
    add("ahead", ahead_text(status.around));
    add("body", body_text(status));
    lines.push_back({"keys", fmt::format("{:.3g} m/s", status.pace), false, true});
  }
  if (!status.hidden.empty()) lines.push_back({"hidden", status.hidden});
  if (!status.section.empty()) lines.push_back({"section", status.section});
  lines.insert(lines.end(), status.tool.begin(), status.tool.end());
  if (status.triangles > 0) {
    lines.push_back({"triangles", short_count(static_cast<double>(status.triangles)), false, true});
  }
  std::string memory = byte_text(status.resident);
  if (status.world_bytes > 0 && !status.paging) memory += fmt::format(", collision {}", byte_text(status.world_bytes));
  lines.push_back({"memory", memory, false, true});
  if (status.paging) {
    const bool failed = status.paging->failed > 0;
    lines.push_back({"collision", paging_text(*status.paging), failed, !failed});
  }
  if (status.building) {
    const bool failed = status.building->phase == Phase::failed;
    lines.push_back({"", failed ? "store failed" : load_text("store", *status.building), failed});
  } else if (!status.store_key.empty()) {
    lines.push_back({"store", "none; " + status.store_key + " builds it", false});
  }
  std::string frame;
  if (status.frame_ms > 0.0) frame = fmt::format("{:.1f} ms", status.frame_ms);
  if (status.mode) {
    frame += fmt::format("{}collision {:.0f} \u00b5s", frame.empty() ? "" : ", ", status.collision_us);
  }
  if (!frame.empty()) lines.push_back({"frame", frame, false, true});
  if (!status.quality.empty()) lines.push_back({"drawing", status.quality, false, true});
  for (const auto& [what, state] : {std::pair("scene", &status.display), std::pair("collision", &status.collision)}) {
    const bool failed = state->phase == Phase::failed;
    // A store has replaced it.
    if (failed && state == &status.collision && status.paging) continue;
    // The reason is too long for a line; status_message shows it.
    const std::string text = failed ? std::string(what) + " failed" : load_text(what, *state);
    if (!text.empty()) lines.push_back({"", text, failed});
  }
  return lines;
}

Told status_message(const Status& status) {
  Told message;
  if (status.collision.phase == Phase::failed && !status.paging) {
    message = {"The collision could not be loaded: this is a ghost that passes through walls.", true};
  } else if (!status.mode) {
    message = {fmt::format("Loading the walls; then you can walk.\n{}", load_text("walls", status.collision)), false};
  } else if (status.camera.empty()) {
    message = status.hold;
  }
  for (const Told& news : status.news) {
    message.text += (message.text.empty() ? "" : "\n") + news.text;
    message.warning |= news.warning;
  }
  return message;
}

std::string coming_text(std::uint64_t tiles, std::string_view server) {
  if (tiles == 0 || server.empty()) return {};
  return fmt::format("{} to come from {}", words::counted(tiles, "tile"), server);
}

std::string byte_text(std::uint64_t bytes) {
  constexpr double mega = 1e6;
  const double count = static_cast<double>(bytes) / mega;
  return count < 1000.0 ? fmt::format("{:.0f} MB", count) : fmt::format("{:.2f} GB", count / 1000.0);
}

std::uint64_t resident_bytes() {
  // The second number of statm: pages in RAM.
  std::ifstream in("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  in >> all >> resident;
  return in ? resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

}  // namespace roam::app
