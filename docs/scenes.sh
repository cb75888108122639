#!/usr/bin/env bash
# scenes.sh FOLDER: draws docs/scenes.jpg, in the order of its pictures, from scenes of others below FOLDER.
set -euo pipefail
sheet=$(dirname "$(realpath "$0")")/scenes.jpg
cd "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
number=10
draw() { roam view "$@" --no-profile --headless --size 960x540 --screenshot "$work/$((++number)).png"; }
draw building/small_house.glb
draw underground/subt_tunnel_practice_1.osgb
draw underground/pittsburgh_mine.dae --mode fly --at 30,-310,40,60,-20
draw city/delft.obj --mode fly --at 330,70,45,75,-22
draw pit_3dtiles/tileset.json --up y --mode fly --at 214,-232,110,90,-30
draw contextcapture_tiles/Tile_+010_+005_L22_000020t4.osgb --mode fly --at 99,33,94,90,-12
draw scan/icl_nuim_living_room_kt2.ply --up=-y
draw recast/dungeon.obj --up y
draw building/willowgarage_visual.dae --unit in --section 'z<2.4' --mode fly --at 29,-10,25,90,-42
draw bim/Duplex_A_20110907.ifc --section 'z<5.2' --mode fly --at 12,-25,14,110,-42
draw recast/undulating.obj --up y --mode fly --at 5030,-5108,14,75,-18
draw building/parking_garage.dae --unit in
montage "$work"/*.png -tile 3x -geometry 480x270+3+3 -quality 85 "$sheet"
