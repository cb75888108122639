#!/usr/bin/env bash
# tests/long/fuzz_faults.sh [MINUTES]: plants a fault for each fuzz target, all in a copy of the source in build-fuzz,
# and runs each target until it finds its own, at most so many minutes (default 10). Prints a table; fails if a target
# finds nothing.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/../.."
root=$PWD copy=$PWD/build-fuzz/planted
rm -rf "$copy"
mkdir -p "$copy"
git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -t "$copy"
cd "$copy"
python3 - << 'FAULTS'
# Target, file, what stands there once, what takes its place.
faults = [
    ("walk", "src/motion/move.cpp", "rest = ball.gap - away", "rest = ball.gap - 0.5 * away"),
    ("tile", "src/store/codec/tile_decoder.cpp", "if (done != triangles) return \"it has another number of triangles\";",
     ""),
    ("numbers", "src/store/codec/source_numbers.cpp", "part >= part_bytes / bytes_of_part || ", ""),
    ("page", "src/store/page.cpp", " || node.first_node > count - inner", ""),
    ("part", "src/store/part.cpp", "step >= header.triangles - first || ", ""),
    ("manifest", "src/store/json_reader.cpp", "if (!is_digits(found, count)) bad(name);", ""),
    ("path", "src/files/path_file.cpp", "largest_number = 1e9", "largest_number = 1e12"),
    ("rows", "apps/roam/sweep/rows.cpp", " || !std::isfinite(value)", ""),
    ("json", "src/files/json_text.cpp", "most_depth = 16", "most_depth = 17"),
    ("profile", "src/profile/profile.cpp", 'demand_body("radius, height, step or slope", p, p.radius);', ""),
    ("settings", "apps/roam/view/settings.cpp", "x >= least && x <= most", "x >= least"),
    ("bookmarks", "apps/roam/view/bookmarks.cpp", ' && item["position"].size() == 3', ""),
    ("protocol", "src/import/mesh_receiver.cpp", "largest >= object_vertices_", "largest > object_vertices_"),
    ("obj", "src/import/reader/obj.cpp", " || index < -count", ""),
    ("stl", "src/import/reader/mesh_sink.cpp", "is_bad(corners_[0]) || ", ""),
    ("ply", "src/import/reader/ply.cpp", "std::min<std::uint64_t>(window.size() / bytes, most)", "most"),
    ("gltf", "src/import/reader/gltf/elements.cpp", "/ stride >= count - 1", "/ stride >= (count - 1) / 2"),
    ("osg", "src/import/reader/osg_geometry.cpp", "if (i >= vertices_.size())", "if (i > vertices_.size())"),
    ("foreign", "src/import/reader/assimp_scene.cpp",
     "i < count ? index_[i] : std::numeric_limits<std::uint32_t>::max()", "index_[i]"),
]
for target, file, good, bad in faults:
    text = open(file).read()
    assert text.count(good) == 1, f"{target}: {file} has {text.count(good)} of: {good}"
    open(file, "w").write(text.replace(good, bad))
FAULTS
if tests/long/fuzz.sh "${1:-10}" > "$root/build-fuzz/planted.table"; then
  echo "no target finds its fault" >&2
  exit 1
fi
cat "$root/build-fuzz/planted.table"
# A line for each fault, each with findings.
(($(grep -c '| [1-9][0-9]* |$' "$root/build-fuzz/planted.table") == $(grep -c '^    ("' "$root/tests/long/fuzz_faults.sh")))
