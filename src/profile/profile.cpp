#include "roam/profile.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "files/descriptor.h"
#include "files/json_text.h"
#include "files/whole_file.h"
#include "profile/write_profile.h"
#include "text/byte_order_mark.h"
#include "text/printable.h"

namespace roam {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* suffix = ".roam";
constexpr const char* extension = ".json";
/// Characters of a file name. File systems allow 255; the rest is for the suffixes.
constexpr std::size_t name_limit = 200;
constexpr std::array<const char*, 3> methods{"paper", "interval", "roaming"};
constexpr std::array<Mode, 2> modes{Mode::walk, Mode::fly};

bool is_digits(const std::string& text, std::size_t count) {
  return text.size() == count && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

[[noreturn]] void refuse(const std::string& member, const std::string& what) {
  throw Error(fmt::format("\"{}\" {}", member, what));
}

void demand_box(const std::string& member, const Box& box) {
  if (box.empty() || !is_finite(box.lower) || !is_finite(box.upper)) {
    refuse(member, "must be a box of finite numbers whose min is nowhere above its max");
  }
}

void demand_support_radius(const std::string& member, double radius) {
  constexpr double most = Space::reach_limit / 4.0;
  if (!(radius >= 0.0 && radius <= most)) {
    refuse(member, fmt::format("is {} m; it must be at least 0 and at most {:g} m", radius, most));
  }
}

/// Throws the error that a Walker would throw for such a body.
void demand_body(const std::string& member, const Profile& profile, double radius) {
  WalkerSettings body;
  body.radius = radius;
  body.height = profile.height;
  body.eye = 0.0;
  body.step = profile.step;
  body.slope_degrees = profile.slope_degrees;
  try {
    check(body);
  } catch (const Error& error) {
    throw Error(fmt::format("\"{}\": {}", member, error.what()));
  }
}

/// Members of a JSON object, read with errors that name the member.
class Members {
 public:
  Members(const Json& json, std::string path) : json_(json), path_(std::move(path)) {
    if (!json.is_object()) refuse(path_.empty() ? "{" : path_, "must be an object, { ... }");
  }

  [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }
  [[nodiscard]] std::string path(const char* key) const { return path_.empty() ? key : path_ + "." + key; }
  [[nodiscard]] const Json& at(const char* key) const {
    const auto it = json_.find(key);
    if (it == json_.end()) refuse(path(key), "is missing");
    return *it;
  }
  [[nodiscard]] double number(const char* key) const {
    const Json& value = at(key);
    if (!value.is_number()) refuse(path(key), "must be a number, not " + shown(value));
    return value.get<double>();
  }
  [[nodiscard]] std::optional<double> number_or_null(const char* key) const {
    if (at(key).is_null()) return std::nullopt;
    return number(key);
  }
  [[nodiscard]] std::uint64_t count(const char* key) const {
    const Json& value = at(key);
    if (!value.is_number_unsigned()) refuse(path(key), "must be a whole number, not " + shown(value));
    return value.get<std::uint64_t>();
  }
  [[nodiscard]] std::string text(const char* key) const {
    const Json& value = at(key);
    if (!value.is_string()) refuse(path(key), "must be a text, not " + shown(value));
    return value.get<std::string>();
  }
  [[nodiscard]] std::string text_or_null(const char* key) const {
    return at(key).is_null() ? std::string() : text(key);
  }
  [[nodiscard]] bool truth(const char* key) const {
    const Json& value = at(key);
    if (!value.is_boolean()) refuse(path(key), "must be true or false, not " + shown(value));
    return value.get<bool>();
  }
  [[nodiscard]] const Json& list(const char* key) const {
    const Json& value = at(key);
    if (!value.is_array()) refuse(path(key), "must be a list, [ ... ]");
    return value;
  }
  [[nodiscard]] Box box(const char* key) const {
    const Members ends(at(key), path(key));
    return {ends.place("min"), ends.place("max")};
  }

 private:
  [[nodiscard]] Vec3 place(const char* key) const {
    const Json& value = list(key);
    Vec3 place(0.0);
    if (value.size() != 3) refuse(path(key), "must hold three numbers, [x, y, z]");
    for (std::size_t k = 0; k < 3; ++k) {
      if (!value[k].is_number()) refuse(path(key), "must hold three numbers, [x, y, z]");
      place[static_cast<int>(k)] = value[k].get<double>();
    }
    return place;
  }
  /// A value for a message: long text is cut, lists and objects are only named.
  static std::string shown(const Json& value) {
    constexpr std::size_t most = 40;
    if (value.is_structured()) return value.is_array() ? "a list" : "an object";
    std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    return text.size() > most ? text.substr(0, most) + "..." : text;
  }

  const Json& json_;
  std::string path_;
};

Json json_of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
Json json_of(const Box& box) { return {{"min", json_of(box.lower)}, {"max", json_of(box.upper)}}; }
Json json_of(const SceneFrame& frame) { return {{"up", to_string(frame.up)}, {"unit", to_string(frame.unit)}}; }
Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json json_of(const Profile& p) {
  Json regions = Json::array();
  for (const SizeRegion& region : p.regions) {
    regions.push_back({{"bounds", json_of(region.bounds)},
                       {"radius", region.radius},
                       {"support_radius", region.support_radius},
                       {"why", region.why}});
  }
  Json json = {{"roam_profile", Profile::version}};
  if (p.frame) json["frame"] = json_of(*p.frame);
  json.update({{"scene",
                {{"hash", text_or_null(p.scene.hash)},
                 {"geometry_hash", text_or_null(p.scene.geometry_hash)},
                 {"triangles", p.scene.triangles},
                 {"bounds", json_of(p.scene.bounds)}}},
               {"mode", to_string(p.mode)},
               {"radius", p.radius},
               {"height", p.height},
               {"support_radius", p.support_radius},
               {"step", p.step},
               {"slope", p.slope_degrees},
               {"interval", {{"min", p.smallest}, {"max", p.largest ? Json(*p.largest) : Json(nullptr)}}},
               {"regions", std::move(regions)},
               {"method", p.method},
               {"complete", p.complete}});
  return json;
}

/// A profile file: a body, a frame, or both.
struct Contents {
  std::optional<Profile> profile;  ///< with the frame
  std::optional<SceneFrame> frame;
};

std::optional<SceneFrame> frame_in(const Members& all) {
  if (!all.has("frame")) return std::nullopt;
  const Members frame(all.at("frame"), "frame");
  SceneFrame read;
  const auto parse = [&](const char* key, const auto& parser) {
    const std::string text = frame.text(key);
    try {
      return parser(text);
    } catch (const Error& error) {
      refuse(frame.path(key), printable(error.what()));
    }
  };
  read.up = parse("up", [](const std::string& text) { return parse_up_axis(text); });
  read.unit = parse("unit", [](const std::string& text) { return parse_length_unit(text); });
  return read;
}

Contents parsed(const Json& json) {
  const Members all(json, {});
  const std::uint64_t version = all.count("roam_profile");
  if (version > Profile::version) {
    throw Error(fmt::format("it is of version {}, and this roam reads version {}; take a newer roam", version,
                            Profile::version));
  }
  if (version == 0) refuse("roam_profile", "must be at least 1");
  Profile p;
  p.frame = frame_in(all);
  if (p.frame && !all.has("scene")) return {std::nullopt, p.frame};
  const Members scene(all.at("scene"), "scene");
  p.scene = {scene.text_or_null("hash"), scene.text_or_null("geometry_hash"), scene.count("triangles"),
             scene.box("bounds")};
  const std::string mode = all.text("mode");
  const auto is_mode = [&](Mode m) { return mode == to_string(m); };
  const auto found = std::find_if(modes.begin(), modes.end(), is_mode);
  if (found == modes.end()) refuse("mode", fmt::format("must be \"walk\" or \"fly\", not \"{}\"", excerpt(mode)));
  p.mode = *found;
  p.radius = all.number("radius");
  p.height = all.number("height");
  p.support_radius = all.number("support_radius");
  p.step = all.number("step");
  p.slope_degrees = all.number("slope");
  const Members interval(all.at("interval"), "interval");
  p.smallest = interval.number("min");
  p.largest = interval.number_or_null("max");
  for (const Json& one : all.list("regions")) {
    const Members region(one, fmt::format("regions[{}]", p.regions.size()));
    p.regions.push_back(
        {region.box("bounds"), region.number("radius"), region.number("support_radius"), region.text("why")});
  }
  p.method = all.text("method");
  p.complete = all.truth("complete");
  check(p);
  const std::optional<SceneFrame> frame = p.frame;
  return {std::move(p), frame};
}

Contents load(const std::filesystem::path& file) {
  const std::string text = files::read_whole(file, files::longest_json);
  try {
    return parsed(files::parse_json(text));
  } catch (const Error& error) {
    throw Error(file.string(), fmt::format("{}; correct the file, or delete it and train again", error.what()));
  }
}

/// The contents of the profile of a scene; empty if there is no file.
Contents contents_of(std::span<const std::filesystem::path> scenes) {
  const std::filesystem::path file = profile_path(scenes);
  std::error_code none;
  const auto status = std::filesystem::symlink_status(file, none);
  // A file that exists but cannot be read is an error, which load throws.
  return status.type() == std::filesystem::file_type::not_found ? Contents{} : load(file);
}

std::filesystem::path trimmed(const std::filesystem::path& path) {
  const std::filesystem::path normal = path.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

/// The same path from the root.
std::filesystem::path whole(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path found = std::filesystem::absolute(path, error);
  if (error)
    throw Error::at(path.string(),
                    fmt::format("cannot tell where {} is: {}; name the scene", path.string(), error.message()));
  return trimmed(found);
}

/// The scene's path without a trailing slash, changed as little as possible.
std::filesystem::path named(const std::filesystem::path& scene) {
  if (scene.empty()) throw Error("the path of the scene whose profile is meant is empty; name its file or folder");
  const std::filesystem::path path = trimmed(scene);
  const std::string last = path.filename().string();
  return !last.empty() && last != "." && last != ".." ? path : whole(path);
}

/// A hash of where the files lie, seen from the folder of the first.
std::string places_hash(const std::vector<std::filesystem::path>& files) {
  std::string places;
  for (const auto& file : files) places += file.lexically_relative(files.front().parent_path()).generic_string() + '\0';
  constexpr int shorter = 32;  // bits
  return fmt::format("{:08x}", XXH3_64bits(places.data(), places.size()) >> shorter);
}

}  // namespace

void check(const Profile& p) {
  if (p.scene.hash.empty() && p.scene.geometry_hash.empty()) {
    refuse("scene", "must have a \"hash\" or a \"geometry_hash\"");
  }
  if (!p.scene.hash.empty() && !is_digits(p.scene.hash, 32)) {
    refuse("scene.hash",
           fmt::format("must be 32 hexadecimal digits in lower case, or null, not \"{}\"", printable(p.scene.hash)));
  }
  if (!p.scene.geometry_hash.empty() && !is_digits(p.scene.geometry_hash, 16)) {
    refuse("scene.geometry_hash", fmt::format("must be 16 hexadecimal digits in lower case, or null, not \"{}\"",
                                              printable(p.scene.geometry_hash)));
  }
  demand_box("scene.bounds", p.scene.bounds);
  if (std::find(modes.begin(), modes.end(), p.mode) == modes.end()) {
    refuse("mode", fmt::format("must be \"walk\" or \"fly\", not \"{}\"", to_string(p.mode)));
  }
  demand_body("radius, height, step or slope", p, p.radius);
  demand_support_radius("support_radius", p.support_radius);
  if (!(p.smallest >= 0.0 && std::isfinite(p.smallest))) {
    refuse("interval.min", fmt::format("must be a number of at least 0, not {}", p.smallest));
  }
  if (p.largest && !(*p.largest > 0.0 && std::isfinite(*p.largest))) {
    refuse("interval.max", fmt::format("must be a number greater than 0, or null, not {}", *p.largest));
  }
  for (std::size_t i = 0; i < p.regions.size(); ++i) {
    const std::string path = fmt::format("regions[{}].", i);
    demand_box(path + "bounds", p.regions[i].bounds);
    demand_body(path + "radius", p, p.regions[i].radius);
    demand_support_radius(path + "support_radius", p.regions[i].support_radius);
  }
  if (std::find(methods.begin(), methods.end(), p.method) == methods.end()) {
    refuse("method", fmt::format("must be \"paper\", \"interval\" or \"roaming\", not \"{}\"", printable(p.method)));
  }
}

std::filesystem::path profile_path(const std::filesystem::path& scene) {
  std::filesystem::path path = named(scene);
  if (path.extension() != suffix) path += suffix;
  return path += extension;
}

std::filesystem::path profile_path(std::span<const std::filesystem::path> scenes) {
  if (scenes.empty()) throw Error("there is no scene whose profile could be meant");
  if (scenes.size() == 1) return profile_path(scenes.front());
  const std::filesystem::path first = named(scenes.front());
  std::vector<std::filesystem::path> files;
  std::string name;
  for (const auto& scene : scenes) {
    const std::filesystem::path file = named(scene);
    files.push_back(whole(file));
    name.append(name.empty() ? "" : "+").append(file.filename().string());
  }
  const bool is_cut = name.size() > name_limit;
  if (is_cut) name = fmt::format("{}+{}", first.filename().string(), scenes.size() - 1);
  const bool is_apart = std::any_of(files.begin(), files.end(), [&](const std::filesystem::path& file) {
    return file.parent_path() != files.front().parent_path();
  });
  if (is_cut || is_apart) name += "-" + places_hash(files);
  return first.parent_path() / (name + suffix + extension);
}

Profile load_profile(const std::filesystem::path& file) {
  Contents contents = load(file);
  if (!contents.profile) throw Error(file.string(), "it has a frame, but no body; train again");
  return std::move(*contents.profile);
}

files::FileKind profiles() {
  return {"profile", [](int file) {
            std::string text(256, '\0');
            errno = 0;
            text.resize(files::read_fully(file, 0, std::as_writable_bytes(std::span(text))));
            if (text.empty()) return errno == 0;
            // Programs that edit JSON write other spaces.
            std::string dense(without_byte_order_mark(text)), start(profile_start);
            for (std::string* some : {&dense, &start})
              std::erase_if(*some,
                            [](char c) { return std::string_view(" \t\r\n").find(c) != std::string_view::npos; });
            return dense.starts_with(start);
          }};
}

void save_profile(const Profile& profile, const std::filesystem::path& file) {
  write_profile(profile, file, files::Naming::beside, profiles());
}

void write_profile(const Profile& profile, const std::filesystem::path& file, files::Naming naming,
                   files::FileKind replaced) {
  try {
    check(profile);
  } catch (const Error& error) {
    const bool unknown = profile.scene.hash.empty() && profile.scene.geometry_hash.empty();
    throw Error::at(file.string(),
                    fmt::format("cannot write {}: {}; {}", file.string(), error.what(),
                                unknown ? "set Profile::scene to identity_of the meshes or the store it was trained on"
                                        : "correct the profile"));
  }
  // Names of objects come from files and may hold any bytes.
  files::write_whole(file, json_of(profile).dump(2, ' ', false, Json::error_handler_t::replace) + "\n", naming,
                     std::move(replaced));
}

std::optional<SceneFrame> find_frame(std::span<const std::filesystem::path> scenes) {
  return contents_of(scenes).frame;
}

bool save_frame(const SceneFrame& frame, const std::filesystem::path& file) {
  std::error_code none;
  const auto status = std::filesystem::symlink_status(file, none);
  const bool is_new = status.type() == std::filesystem::file_type::not_found;
  const Contents before = is_new ? Contents{} : load(file);
  if (before.profile) return before.frame == frame;
  const Json json = {{"roam_profile", Profile::version}, {"frame", json_of(frame)}};
  files::write_whole(file, json.dump(2) + "\n", files::Naming::beside);
  return true;
}

std::optional<Profile> find_profile(const std::filesystem::path& scene, const std::optional<SceneIdentity>& identity) {
  return find_profile({&scene, 1}, identity);
}

std::optional<Profile> find_profile(std::span<const std::filesystem::path> scenes,
                                    const std::optional<SceneIdentity>& identity) {
  std::optional<Profile> profile = contents_of(scenes).profile;
  if (profile && identity && !profile->belongs_to(*identity)) {
    throw Error::at(
        profile_path(scenes).string(),
        fmt::format("{} is of another scene, or of this one before it changed or read in another way (up, unit "
                    "or ignore): train again, or delete the file",
                    profile_path(scenes).string()));
  }
  return profile;
}

WalkerSettings apply(const Profile& profile, const WalkerSettings& settings) {
  WalkerSettings applied = settings;
  applied.radius = profile.radius;
  applied.height = profile.height;
  const bool is_sphere = profile.height <= 2.0 * profile.radius;
  applied.eye = is_sphere ? profile.radius : std::min(settings.eye, profile.height);
  applied.step = profile.step;
  applied.slope_degrees = profile.slope_degrees;
  applied.support_radius = profile.support_radius;
  return applied;
}

}  // namespace roam
