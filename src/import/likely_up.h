#pragma once
/// \file
/// The axis that the surface of a scene makes likely to point up.

#include <filesystem>
#include <optional>
#include <span>

#include "roam/import.h"

namespace roam {

/// Whether a format defines which axis is up, or its files state one: a folder of OSGB tiles, glTF, Collada, FBX, IFC,
/// 3MF, Blender. The standard of 3D Tiles says that z is up; many tilesets without a place on Earth do not follow it.
[[nodiscard]] bool states_up(const std::filesystem::path& path);

/// The axis of x, y, -x, -y to which most of the surface of a scene read with z up is square, if all of these hold;
/// else none.
///
/// - The mean square of the normals along it is 1.3 times that along either other axis. Floors, ceilings and tops of
///   things are square to the vertical, and walls are divided between the two other axes.
/// - The two other axes differ by at most a factor of two: in a narrow corridor the walls are larger than the floor.
/// - Its sign is clear. Either the surface is seen from one side, as a terrain is. Or the level faces between lowest
///   and highest lie towards one end, as things stand on floors.
///
/// -z is never returned. Reads each triangle once, in about 10 ns.
[[nodiscard]] std::optional<UpAxis> likely_up(std::span<const Mesh> meshes);

/// Whether most of a surface that is read with z up is square to z, by the measures of likely_up: it stands right.
[[nodiscard]] bool stands_upright(std::span<const Mesh> meshes);

}  // namespace roam
