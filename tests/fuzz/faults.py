#!/usr/bin/env python3
"""tests/fuzz/faults.py [--plant]: whether each fuzz target has a fault that fits the source; status 1 if not. --plant
plants them in the tree around this file, which must be a copy without .git."""

import pathlib
import re
import sys

TREE = pathlib.Path(__file__).resolve().parents[2]

# Target, file, what stands there once, what takes its place.
FAULTS = [
    ("walk", "src/motion/move.cpp", "rest = free.gap - away", "rest = free.gap - 0.5 * away"),
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

targets = {name for file in TREE.glob("tests/fuzz/*.cpp")
           for name in re.findall(r"^const Known ([a-z]+)_target", file.read_text(encoding="utf-8"), re.M)}
without = sorted(targets ^ {target for target, *_ in FAULTS})
if without:
    sys.exit(f"These have either no fault or no target: {', '.join(without)}.")
for target, name, good, _ in FAULTS:
    count = (TREE / name).read_text(encoding="utf-8").count(good)
    if count != 1:
        sys.exit(f"{target}: {name} has {count} of: {good}")
if sys.argv[1:] == ["--plant"]:
    if (TREE / ".git").exists():
        sys.exit(f"{TREE} is no copy: it has .git")
    for _, name, good, bad in FAULTS:
        file = TREE / name
        file.write_text(file.read_text(encoding="utf-8").replace(good, bad), encoding="utf-8")
