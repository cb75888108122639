#pragma once
/// \file
/// The settings file of `roam view`: a person's preferences for all scenes.
///
/// A JSON object; every entry may be left out:
///
///     {
///       "keys": {"forward": ["Z", "Up"], "jump": "Space"},
///       "mouse": {"sensitivity": 1.5, "invert_y": true},
///       "body": {"radius": 0.25, "height": 1.7, "eye": 1.5, "step": 0.3, "slope": 45},
///       "speed": 1.4,
///       "easing": 0.15,
///       "fov": 65,
///       "hud": "plain",
///       "quality": "auto",
///       "edges": true,
///       "picture_scale": 2,
///       "tile_error": 16
///     }

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace roam::app {

/// How much of the head-up display is shown. full: plain, and figures for programmers. minimal: one line.
enum class HudMode : std::uint8_t { plain, full, minimal, off };

/// "plain", "full", "minimal" or "off".
[[nodiscard]] const char* to_string(HudMode mode);
/// The mode of that name, if there is one.
[[nodiscard]] std::optional<HudMode> parse_hud_mode(const std::string& text);

struct ViewSettings {
  std::filesystem::path file;                            ///< the settings' source, for messages
  std::map<std::string, std::vector<std::string>> keys;  ///< key names for a command; other commands keep theirs
  std::optional<double> sensitivity;                     ///< of the mouse, > 0; default 1
  std::optional<bool> invert_y;                          ///< moving the mouse forward looks down
  std::optional<double> radius, height, eye, step;       ///< metres
  std::optional<double> slope;                           ///< degrees
  std::optional<double> speed;                           ///< metres per second
  std::optional<double> easing;                          ///< seconds to full speed and to rest, >= 0
  std::optional<double> fov;                             ///< degrees, vertical
  std::optional<HudMode> hud;
  std::optional<std::string> quality;   ///< see quality_names
  std::optional<bool> edges;            ///< thin lines along outlines
  std::optional<double> picture_scale;  ///< of the pictures of the key P, times the window
  std::optional<double> tile_error;     ///< pixels that 3D Tiles may be wrong by, >= 0
};

/// The qualities of drawing. auto: plain in a window without a graphics card, else full. The others as
/// graphics::Quality.
inline constexpr std::array<const char*, 4> quality_names{"auto", "full", "light", "plain"};

/// Range of the field of view, degrees.
inline constexpr double least_fov = 10.0;
inline constexpr double largest_fov = 150.0;
inline constexpr double largest_picture_scale = 16.0;
inline constexpr double largest_tile_error = 1e4;

/// The folder of settings and bookmarks: $XDG_CONFIG_HOME/roam, else ~/.config/roam. Empty if neither variable is set.
[[nodiscard]] std::filesystem::path settings_folder();

/// Reads a file. Throws roam::Error with file and entry for invalid JSON, an unknown entry, or a value out of range.
[[nodiscard]] ViewSettings read_settings(const std::filesystem::path& file);

/// The settings of the file `asked`, which must exist; else of settings.json in settings_folder(), if there is one;
/// else none.
[[nodiscard]] ViewSettings find_settings(const std::filesystem::path& asked);

}  // namespace roam::app
