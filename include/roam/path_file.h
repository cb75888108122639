#pragma once
/// \file
/// Path files: waypoints for a body. Library target roam::files.
///
/// A line is a waypoint `x y z`, in metres in the scene's frame, or a line of osgViewer's animation path
/// `t x y z qx qy qz qw`, as its key Z records it. A file holds only one of the two kinds. `#` begins a comment, also
/// after numbers; empty lines are ignored.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "roam/math.h"
#include "roam/walker_settings.h"

namespace roam {

// Limits of a path file. Numbers are at most 1e9 in absolute value.
inline constexpr std::size_t most_waypoints = 1'000'000;
inline constexpr std::uint64_t longest_path_file = 128ull << 20;  ///< bytes
inline constexpr std::size_t longest_path_line = 4096;            ///< bytes

/// Time and view of a line of an animation path.
struct PathPose {
  double time = 0.0;                 ///< seconds, at least that of the line before
  std::array<double, 4> rotation{};  ///< the quaternion x, y, z, w as in the file
};

struct Waypoint {
  Vec3 position{0.0};            ///< metres, scene frame
  std::optional<PathPose> pose;  ///< of an animation path
  int line = 0;                  ///< of the file, from 1, for messages
};

/// Reads a path; messages call it `name`. Throws roam::Error, naming the line, for anything but finite numbers, a wrong
/// count of them, and a time that runs backwards. Also throws it for fewer than two waypoints, beyond the limits above,
/// and if reading fails. load_path() reads from a file or a pipe.
[[nodiscard]] std::vector<Waypoint> read_path(std::istream& in, const std::string& name);
[[nodiscard]] std::vector<Waypoint> load_path(const std::filesystem::path& file);

/// The comment that records the body in a path file, without an end of line; `roam walk --path` takes that body:
/// "# roam: mode walk radius 0.3 height 1.8 eye 1.6 step 0.3 slope 45", and " support 0.7" if there is a support disc.
[[nodiscard]] std::string body_line(const WalkerSettings& body, Mode mode);
/// Writes positions of the centre, after body_line() if `body` is given. load_path() reads them back to the last bit.
/// Replaces a file, or a link, only when the new file is complete. Throws roam::Error for positions that load_path()
/// would refuse, and if writing fails.
void save_path(const std::filesystem::path& file, std::span<const Vec3> path, const WalkerSettings* body = nullptr,
               Mode mode = Mode::walk);

[[nodiscard]] std::vector<Vec3> positions(const std::vector<Waypoint>& path);  ///< for Walker and Route

}  // namespace roam
