#include "view/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "cli/user_folder.h"
#include "files/json_text.h"
#include "files/whole_file.h"
#include "roam/error.h"
#include "text/printable.h"

namespace roam::app {
namespace {

using json = nlohmann::ordered_json;

/// An object of the file. Reading removes its entries; the remaining ones are unknown.
class SettingsObject {
 public:
  SettingsObject(const std::filesystem::path& file, std::string where, json object)
      : file_(file), where_(std::move(where)), object_(std::move(object)) {
    if (object_.is_object()) return;
    fail("", where_.empty() ? "the file must hold one JSON object, { ... }" : "must be an object, { ... }");
  }

  [[noreturn]] void fail(const std::string& entry, const std::string& what) const {
    const std::string path = (where_.empty() || entry.empty() ? where_ : where_ + ".") + excerpt(entry);
    throw Error(file_.string(), path.empty() ? what : fmt::format("the entry \"{}\" {}", path, what));
  }

  [[nodiscard]] std::optional<json> take(const std::string& entry) {
    known_ += (known_.empty() ? "" : ", ") + entry;
    const auto found = object_.find(entry);
    if (found == object_.end()) return std::nullopt;
    json value = *found;
    object_.erase(found);
    return value;
  }

  std::optional<double> number(const std::string& entry, double least, double most) {
    const std::optional<json> value = take(entry);
    if (!value) return std::nullopt;
    const double x = value->is_number() ? value->get<double>() : std::nan("");
    if (!(x >= least && x <= most)) fail(entry, fmt::format("must be a number from {:g} to {:g}", least, most));
    return x;
  }

  std::optional<bool> flag(const std::string& entry) {
    const std::optional<json> value = take(entry);
    if (!value) return std::nullopt;
    if (!value->is_boolean()) fail(entry, "must be true or false");
    return value->get<bool>();
  }

  std::optional<SettingsObject> section(const std::string& entry) {
    std::optional<json> value = take(entry);
    if (!value) return std::nullopt;
    return SettingsObject(file_, where_.empty() ? entry : where_ + "." + entry, std::move(*value));
  }

  void end() const {
    if (!object_.empty()) fail(object_.begin().key(), "is not known; there are: " + known_);
  }

  [[nodiscard]] const json& object() const { return object_; }

 private:
  const std::filesystem::path& file_;
  std::string where_;
  json object_;
  std::string known_;
};

std::map<std::string, std::vector<std::string>> keys_of(const SettingsObject& section) {
  constexpr const char* what = "must be the name of a key, or a list of them: [\"W\", \"Up\"]";
  std::map<std::string, std::vector<std::string>> keys;
  for (const auto& [command, value] : section.object().items()) {
    std::vector<std::string>& names = keys[command];
    if (value.is_string()) {
      names.push_back(value.get<std::string>());
      continue;
    }
    if (!value.is_array()) section.fail(command, what);
    for (const json& key : value) {
      if (!key.is_string()) section.fail(command, what);
      names.push_back(key.get<std::string>());
    }
  }
  return keys;
}

}  // namespace

const char* to_string(HudMode mode) {
  switch (mode) {
    case HudMode::plain:
      return "plain";
    case HudMode::full:
      return "full";
    case HudMode::minimal:
      return "minimal";
    case HudMode::off:
      return "off";
  }
  return "";
}

std::optional<HudMode> parse_hud_mode(const std::string& text) {
  for (const HudMode mode : {HudMode::plain, HudMode::full, HudMode::minimal, HudMode::off}) {
    if (text == to_string(mode)) return mode;
  }
  return std::nullopt;
}

std::filesystem::path settings_folder() { return user_folder("XDG_CONFIG_HOME", ".config"); }

ViewSettings read_settings(const std::filesystem::path& file) {
  const std::string text = files::read_named(file, files::longest_json);
  json document;
  try {
    document = files::parse_json(text);
  } catch (const Error& error) {
    throw Error(file.string(), error.what());
  }
  // Wide limits against nonsense; the users of the values check exactly.
  constexpr double metres = 1000.0;
  constexpr double least = 1e-3;
  ViewSettings settings;
  settings.file = file;
  SettingsObject all(file, "", std::move(document));
  if (const auto keys = all.section("keys")) settings.keys = keys_of(*keys);
  if (auto mouse = all.section("mouse")) {
    settings.sensitivity = mouse->number("sensitivity", 0.01, 100.0);
    settings.invert_y = mouse->flag("invert_y");
    mouse->end();
  }
  if (auto body = all.section("body")) {
    settings.radius = body->number("radius", least, metres);
    settings.height = body->number("height", least, metres);
    settings.eye = body->number("eye", 0.0, metres);
    settings.step = body->number("step", 0.0, metres);
    settings.slope = body->number("slope", 0.0, 89.0);
    body->end();
  }
  settings.speed = all.number("speed", least, 1e4);
  settings.easing = all.number("easing", 0.0, 2.0);
  settings.fov = all.number("fov", least_fov, largest_fov);
  if (const auto hud = all.take("hud")) {
    settings.hud = hud->is_string() ? parse_hud_mode(hud->get<std::string>()) : std::nullopt;
    if (!settings.hud) all.fail("hud", "must be \"plain\", \"full\", \"minimal\" or \"off\"");
  }
  if (const auto quality = all.take("quality")) {
    const std::string name = quality->is_string() ? quality->get<std::string>() : "";
    if (std::count(quality_names.begin(), quality_names.end(), name) == 0) {
      all.fail("quality", fmt::format("must be \"{}\"", fmt::join(quality_names, "\", \"")));
    }
    settings.quality = name;
  }
  settings.edges = all.flag("edges");
  settings.picture_scale = all.number("picture_scale", 1.0, largest_picture_scale);
  settings.tile_error = all.number("tile_error", 0.0, largest_tile_error);
  all.end();
  return settings;
}

ViewSettings find_settings(const std::filesystem::path& asked) {
  if (!asked.empty()) return read_settings(asked);
  const std::filesystem::path folder = settings_folder();
  std::error_code none;
  if (folder.empty() || !std::filesystem::exists(folder / "settings.json", none)) return {};
  return read_settings(folder / "settings.json");
}

}  // namespace roam::app
