// Files that people write or exchange: what is accepted is within the limits, and stays the same when written again.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "files/json_text.h"
#include "fuzz.h"
#include "profile_made.h"
#include "roam/path_file.h"
#include "sweep/rows.h"
#include "view/bookmarks.h"
#include "view/settings.h"

namespace fuzz {
namespace {

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool finite(const roam::Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// --- paths

void run_path(Bytes input) {
  std::istringstream in{std::string(text_of(input))};
  std::vector<roam::Waypoint> path;
  if (!complaint([&] { path = roam::read_path(in, "p"); }).empty()) return;
  demand(path.size() >= 2 && path.size() <= roam::most_waypoints, "a path of no length");
  for (std::size_t i = 0; i < path.size(); ++i) {
    const roam::Waypoint& w = path[i];
    for (int k = 0; k < 3; ++k) demand(std::abs(w.position[k]) <= 1e9, "a waypoint that is nowhere");
    demand(w.pose.has_value() == path[0].pose.has_value(), "two kinds of lines");
    if (w.pose && i > 0) demand(w.pose->time >= path[i - 1].pose->time, "a time that runs backwards");
  }
  const std::vector<roam::Vec3> places = roam::positions(path);
  const std::string file = folder() + "/written.path";
  const std::string said = complaint([&] {
    roam::save_path(file, places);
    demand(roam::positions(roam::load_path(file)) == places, "a path that changes when it is written");
  });
  if (!said.empty()) fail("a path that is read and cannot be written: " + said);
}

std::vector<std::string> path_seeds() {
  const std::vector<roam::Vec3> places{{1.5, -2.25, 1e-9}, {-13739, 253, 182}, {1e9, 0, -1e9}};
  const std::string file = folder() + "/seed.path";
  const roam::WalkerSettings person;
  roam::save_path(file, places, &person);
  return {content_of(file), "0 1 2 3 0 0 0 1\r\n0.5 1 2 3 0 0.7 0 0.7 # turn\r\n", "\xEF\xBB\xBF+1 2 3\n\n1 2 4"};
}

// --- rows of sweeps

void run_rows(Bytes input) {
  std::istringstream in{std::string(text_of(input))};
  for (std::string row; std::getline(in, row);) {
    (void)complaint([&] {
      if (roam::app::is_blank(row) || roam::app::is_query_header(row)) return;
      const roam::app::SweepQuery query = roam::app::parse_query(row);
      demand(finite(query.from) && finite(query.motion), "a query that is nowhere");
      demand(query.body.radius >= 0.0 && std::isfinite(query.body.radius) && query.body.half_height >= 0.0 &&
                 std::isfinite(query.body.half_height),
             "a body that is none");
    });
  }
}

std::vector<std::string> rows_seeds() {
  return {"x,y,z,dx,dy,dz,radius\n1,2,3,4,5,6,0.3\n",
          "1 , +2,3e5,-4,5,6,0.3,0.6\r\n \n1,2,3,4,5,6,-1\nnan,0,0,0,0,0,1"};
}

// --- JSON

using Json = nlohmann::ordered_json;

int depth_of(const Json& json) {
  int deepest = 0;
  if (json.is_structured()) {
    for (const Json& child : json) deepest = std::max(deepest, depth_of(child));
    ++deepest;
  }
  return deepest;
}

void run_json(Bytes input) {
  Json json;
  if (!complaint([&] { json = roam::files::parse_json(std::string(text_of(input))); }).empty()) return;
  constexpr int most_depth = 16;
  demand(depth_of(json) <= most_depth, "it is nested too deeply");
  const std::string text = json.dump();
  const std::string said =
      complaint([&] { demand(roam::files::parse_json(text).dump() == text, "JSON that changes when it is written"); });
  demand(said.empty(), "JSON that is read and cannot be read again");
}

std::vector<std::string> json_seeds() {
  return {R"({"a": [1, -2.5e3, true, null, "\u00e9\n"], "b": {"c": {}}} // comment)",
          "[[[[[[[[[[[[[[[[[[0]]]]]]]]]]]]]]]]]]",
          R"([18446744073709551615, -9223372036854775808, 1e400, "\ud83d\ude00"])"};
}

// --- profiles, settings and bookmarks

void run_profile(Bytes input) {
  const std::string file = write("p.roam.json", text_of(input));
  roam::Profile profile;
  if (!complaint([&] { profile = roam::load_profile(file); }).empty()) return;
  const std::string said = complaint([&] {
    roam::check(profile);
    roam::check(roam::apply(profile, roam::WalkerSettings()));
    roam::save_profile(profile, file);
    const std::string text = content_of(file);
    roam::save_profile(roam::load_profile(file), file);
    demand(content_of(file) == text, "a profile that changes when it is written");
  });
  if (!said.empty()) fail("a profile that is read and cannot be used: " + said);
}

std::vector<std::string> profile_seeds() {
  const std::string file = folder() + "/seed.roam.json";
  std::vector<std::string> all;
  roam::Profile profile = made::full_profile();
  roam::save_profile(profile, file);
  all.push_back(content_of(file));
  profile.mode = roam::Mode::fly;
  profile.height = 2.0 * profile.radius;
  profile.support_radius = 0.0;
  profile.largest.reset();
  profile.regions.clear();
  profile.frame = roam::SceneFrame{};
  roam::save_profile(profile, file);
  all.push_back(content_of(file));
  return all;
}

void run_settings(Bytes input) {
  const std::string file = write("settings.json", text_of(input));
  roam::app::ViewSettings settings;
  if (!complaint([&] { settings = roam::app::read_settings(file); }).empty()) return;
  const auto within = [](const std::optional<double>& value, double most) {
    demand(!value || (*value >= 0.0 && *value <= most), "a setting out of range");
  };
  for (const auto& metres : {settings.radius, settings.height, settings.eye, settings.step}) within(metres, 1000.0);
  within(settings.sensitivity, 100.0);
  within(settings.slope, 89.0);
  within(settings.easing, 2.0);
  within(settings.fov, roam::app::largest_fov);
  within(settings.picture_scale, roam::app::largest_picture_scale);
  for (const auto& value : {settings.speed, settings.tile_error}) within(value, roam::app::largest_tile_error);
}

std::vector<std::string> settings_seeds() {
  return {R"({"keys": {"forward": ["Z", "Up"], "jump": "Space"}, "mouse": {"sensitivity": 1.5, "invert_y": true},
"body": {"radius": 0.25, "height": 1.7, "eye": 1.5, "step": 0.3, "slope": 45}, "speed": 1.4, "easing": 0.15, "fov": 65,
"hud": "plain", "quality": "auto", "edges": true, "picture_scale": 2, "tile_error": 16})",
          "{}"};
}

void run_bookmarks(Bytes input) {
  const std::string file = write("bookmarks.json", text_of(input));
  (void)complaint([&] {
    roam::app::Bookmarks bookmarks(file, {"/scene.ply"}, {});
    const std::size_t count = bookmarks.all().size();
    for (const roam::app::Bookmark& bookmark : bookmarks.all())
      demand(finite(bookmark.pose.position), "a bookmark nowhere");
    (void)bookmarks.names();
    bookmarks.add({});
    demand(roam::app::Bookmarks(file, {"/scene.ply"}, {}).all().size() == count + 1, "bookmarks that are lost");
  });
}

std::vector<std::string> bookmarks_seeds() {
  return {R"([{"scene": ["/scene.ply"], "up": "", "unit": "m", "bookmarks": [{"name": "shaft", "position": [1, 2, 3],
"yaw": 90, "pitch": 0}, {"name": "7", "position": [1, 2, 3]}]}, {"scene": [], "up": "-y", "unit": "ft"}])",
          "[]"};
}

const Known path_target(
    {"path", run_path, path_seeds, {"# roam:", "1e9", "1e-320", "\xEF\xBB\xBF", "inf", "nan", "0x1p3"}});
const Known rows_target(
    {"rows", run_rows, rows_seeds, {"half_height", "radius", "1e309", "1e-320", "nan", "inf", ",,"}});
const Known json_target(
    {"json", run_json, json_seeds, {"\\u0000", "\\ud800", "//", "/*", "1e999", "-0", "null", "true"}});
const Known profile_target({"profile",
                            run_profile,
                            profile_seeds,
                            {"\"frame\"", "\"unit\"", "\"up\"", "\"interval\"", "\"regions\"", "\"max\"", "null",
                             "\"fly\"", "1e-320", "1e308", "\\u0000", "[]", "{}"}});
const Known settings_target({"settings",
                             run_settings,
                             settings_seeds,
                             {"\"keys\"", "\"mouse\"", "\"body\"", "\"hud\"", "\"quality\"", "null", "1e308", "[]",
                              "{}"}});
const Known bookmarks_target({"bookmarks",
                              run_bookmarks,
                              bookmarks_seeds,
                              {"\"scene\"", "\"/scene.ply\"", "\"bookmarks\"", "\"position\"", "\"yaw\"", "null",
                               "1e308", "{}"}});

}  // namespace
}  // namespace fuzz
