#pragma once
/// \file
/// Path files: the places that a body is sent along.
///
/// A line is a waypoint `x y z`, in metres in the scene's frame, or a line of osgViewer's animation path
/// `t x y z qx qy qz qw`, as its key Z records it. `#` begins a comment, also behind numbers; empty lines mean nothing.
/// One file holds one of the two kinds. Library target roam::files.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/walker_settings.h"

namespace roam {

/// What a path file holds at most.
inline constexpr std::size_t most_waypoints = 1'000'000;
inline constexpr std::uint64_t longest_path_file = 128ull << 20;  ///< bytes
inline constexpr std::size_t longest_path_line = 4096;            ///< bytes

/// Where the camera of an animation path was at its moment, and how it looked.
struct PathPose {
  double time = 0.0;                 ///< seconds, never less than that of the line before
  std::array<double, 4> rotation{};  ///< the quaternion x, y, z, w as the file gives it
};

/// One line of a path file.
struct Waypoint {
  Vec3 position{0.0};            ///< metres, scene frame
  std::optional<PathPose> pose;  ///< of an animation path
  int line = 0;                  ///< of the file, from 1, for messages
};

/// Reads a path. `name` stands for the file in messages. Throws roam::Error naming the line for anything but numbers,
/// for a wrong count of them, for numbers that are not finite or a time that runs backwards; for a path of fewer than
/// two waypoints, and for what is beyond the limits above.
[[nodiscard]] std::vector<Waypoint> read_path(std::istream& in, const std::string& name);

/// The same from a file, or from a pipe. Throws roam::Error also when it cannot be read.
[[nodiscard]] std::vector<Waypoint> load_path(const std::filesystem::path& file);

/// The comment by which a path file says whose centre went there, without an end of line:
/// "# roam: mode walk radius 0.3 height 1.8 eye 1.6 step 0.3 slope 45". `roam walk --path` takes that body.
[[nodiscard]] std::string body_line(const WalkerSettings& body, Mode mode);

/// Writes a path that load_path reads back to the last bit: places of the centre of `body`, which is told in a comment
/// where it is given. Throws roam::Error for fewer than two places, for places that load_path would refuse, and when
/// the file cannot be written.
void save_path(const std::filesystem::path& file, std::span<const Vec3> path, const WalkerSettings* body = nullptr,
               Mode mode = Mode::walk);

/// The places alone, as Walker and Route take them.
[[nodiscard]] std::vector<Vec3> positions(const std::vector<Waypoint>& path);

}  // namespace roam
