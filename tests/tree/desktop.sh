#!/usr/bin/env bash
# desktop.sh SOURCE PREFIX WORK: whether a desktop opens scenes and stores with the installed program: its entry, its icon,
# and the types of files.
set -euo pipefail
share=$2/share work=$3
export PATH=$2/bin:$PATH  # an entry whose program is not there counts as none
for tool in desktop-file-validate update-desktop-database update-mime-database gio; do
  command -v "$tool" > /dev/null || { echo "there is no $tool: not run"; exit 77; }
done
rm -rf "$work"
mkdir -p "$work/share"
fail() { echo "$1"; exit 1; }

said=$(desktop-file-validate "$share/applications/roam.desktop" 2>&1)
[[ -z $said ]] || fail "$said"
# Its folder of data first, then the system's types.
cp -r "$share"/{applications,mime,icons} "$work/share"
update-mime-database "$work/share/mime" 2> "$work/log" || { cat "$work/log"; exit 1; }
update-desktop-database "$work/share/applications"
export XDG_DATA_DIRS=$work/share:/usr/share XDG_DATA_HOME=$work/home XDG_CONFIG_HOME=$work/config
types=$(sed -n 's/^MimeType=//p' "$share/applications/roam.desktop")

# opens FILE TEXT: a file of that name and text has a type that roam.desktop is for.
opens() {
  local type
  printf "$2" > "$work/$1"
  type=$(gio info -a standard::content-type "$work/$1" | sed -n 's/.*content-type: //p')
  [[ ";$types" == *";$type;"* ]] || fail "$1 has the type '$type', which roam.desktop does not name"
  [[ $(gio mime "$type") == *roam.desktop* ]] || fail "roam is not offered for $type"
}
opens CURRENT "roam store 1\n$(printf '%064d' 0)\n"
opens hall.ply 'ply\nformat ascii 1.0\n'
opens hall.stl 'solid hall\n'
opens hall.obj 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'
opens hall.dae '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"/>'
opens hall.ifc 'ISO-10303-21;\n'
opens hall.off 'OFF\n3 1 0\n'
for name in hall.{glb,gltf,fbx,osg,osgb,osgt,ive,dxf,flt,ac}; do opens "$name" '\001\002\003'; done
opens hall.3ds 'MM\020\000\000\000\002\000'
# Folders stay with the file manager.
[[ ";$types" != *";inode/directory;"* ]] || fail 'roam.desktop takes all folders'
if command -v rsvg-convert > /dev/null; then
  rsvg-convert -w 48 "$share/icons/hicolor/scalable/apps/roam.svg" > "$work/icon.png"
fi
