#pragma once
/// \file
/// The settings file of `roam view`: what a person likes, for all scenes.
///
/// A JSON object; every entry may be left out:
///
///     {
///       "keys": {"forward": ["Z", "Up"], "jump": "Space"},
///       "mouse": {"sensitivity": 1.5, "invert_y": true},
///       "body": {"radius": 0.25, "height": 1.7, "eye": 1.5, "step": 0.3, "slope": 45},
///       "speed": 1.4,
///       "fov": 65,
///       "hud": "full"
///     }

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace roam::app {

/// How much of the head-up display is shown.
enum class HudMode : std::uint8_t { full, minimal, off };

/// "full", "minimal" or "off".
[[nodiscard]] const char* to_string(HudMode mode);
/// The mode of that name, if there is one.
[[nodiscard]] std::optional<HudMode> parse_hud_mode(const std::string& text);

struct ViewSettings {
  std::filesystem::path file;                            ///< they come from; for messages
  std::map<std::string, std::vector<std::string>> keys;  ///< names of keys for a command; the others keep theirs
  std::optional<double> sensitivity;                     ///< of the mouse, > 0; 1 is the usual
  std::optional<bool> invert_y;                          ///< pushing the mouse forward looks down
  std::optional<double> radius, height, eye, step;       ///< metres
  std::optional<double> slope;                           ///< degrees
  std::optional<double> speed;                           ///< metres per second
  std::optional<double> fov;                             ///< degrees, of the height of the picture
  std::optional<HudMode> hud;
};

/// The field of view may be in [min, max] degrees.
inline constexpr double least_fov = 10.0;
inline constexpr double largest_fov = 150.0;

/// The folder of settings and bookmarks: $XDG_CONFIG_HOME/roam, else ~/.config/roam. Empty when neither variable is
/// set.
[[nodiscard]] std::filesystem::path settings_folder();

/// Reads a file. Throws roam::Error naming file and entry for what is no JSON, no entry of the list above or out of
/// range.
[[nodiscard]] ViewSettings read_settings(const std::filesystem::path& file);

/// The file that was asked for, which must exist; else settings.json in settings_folder(), if there is one; else
/// nothing is set.
[[nodiscard]] ViewSettings find_settings(const std::filesystem::path& asked);

}  // namespace roam::app
