#!/usr/bin/env bash
# debian.sh SOURCE BUILD WORK: makes the Debian packages of a build, and checks what is in them.
set -euo pipefail
source=$1 build=$2 work=$3
for tool in dpkg-deb dpkg-shlibdeps cpack; do
  command -v "$tool" > /dev/null || { echo "there is no $tool"; exit 77; }
done
[[ -e $build/CPackConfig.cmake ]] || { echo "this build makes no packages"; exit 77; }
rm -rf "$work"
mkdir -p "$work"
fail() { echo "$1"; exit 1; }

# Compressed quickly: the test looks at what is in them.
cpack --config "$build/CPackConfig.cmake" -B "$work/packages" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip > "$work/log" 2>&1 ||
  { cat "$work/log"; exit 1; }
version=$(sed -n 's/^#define ROAM_VERSION_STRING "\(.*\)"$/\1/p' "$source/include/roam/version.h")-1
triplet=$(dpkg-architecture -qDEB_HOST_MULTIARCH)
names='roam roam-reader libroam0 libroam-dev roam-doc'
[[ ! -e $build/debian/python3-roam ]] || names+=' python3-roam'  # a system without Python has none
cd "$work/packages"
for name in $names; do
  files=("${name}_${version}"_*.deb)
  [[ -e ${files[0]} ]] || fail "there is no package $name of version $version"
  dpkg-deb --extract "${files[0]}" "$work/$name"
  dpkg-deb --extract "${files[0]}" "$work/root"
  dpkg-deb --control "${files[0]}" "$work/$name.control"
done
cd "$work"

# has PACKAGE FILE...
has() {
  for file in "${@:2}"; do [[ -e $1/$file || -L $1/$file ]] || fail "$1 has no $file"; done
}
has roam usr/bin/roam usr/share/man/man1/{roam,roam-walk,roam-make-city}.1.gz \
  usr/share/{bash-completion/completions/roam,zsh/vendor-completions/_roam,fish/vendor_completions.d/roam.fish} \
  usr/share/{applications/roam.desktop,mime/packages/roam.xml,icons/hicolor/scalable/apps/roam.svg}
has roam-reader usr/libexec/roam/roam-reader
has libroam0 "usr/lib/$triplet/libroam.so.0" "usr/lib/$triplet/libroam.so.${version%-*}"
has libroam-dev "usr/lib/$triplet"/{libroam.so,libroam.a,cmake/roam/roamConfig.cmake,pkgconfig/roam.pc} \
  usr/include/{roam/world.h,osgRoam/Manipulator.h}
[[ $names != *python3* ]] || has python3-roam usr/lib/python3/dist-packages/roam/__init__.py
has roam-doc usr/share/doc/roam/{README.md,docs/walking.md,examples/walk_a_path/CMakeLists.txt}
for name in $names; do
  has "$name" "usr/share/doc/$name"/{copyright,changelog.Debian.gz}
  for file in "$name"/usr/local "$name"/usr/lib/*.so* "$name"/usr/lib/cmake; do
    [[ ! -e $file ]] || fail "there is a $file"
  done
done
# No file is in two packages.
twice=$(for name in $names; do (cd "$name" && find . -not -type d); done | sort | uniq -d)
[[ -z $twice ]] || fail "in two packages: $twice"

# says PACKAGE FIELD TEXT
says() {
  local value
  value=$(sed -n "s/^$2: //p" "$1.control/control")
  [[ $value == *"$3"* ]] || fail "$1 has the $2 '$value', without '$3'"
}
says roam Depends "roam-reader (= $version)"
says roam Depends 'libopenscenegraph161'
says roam-reader Depends 'libassimp'
says libroam0 Depends "roam-reader (= $version)"
says libroam0 Depends 'libtbb'
says libroam-dev Depends "libroam0 (= $version)"
says libroam-dev Depends 'libglm-dev'
if [[ $names == *python3* ]]; then
  says python3-roam Depends 'python3-numpy'
  says python3-roam Depends 'libroam0 (>='
  says python3-roam Architecture all
fi
says roam-doc Architecture all
grep -q '^libroam 0 libroam0 (>= ' libroam0.control/shlibs || fail "libroam0 has no shlibs"
grep -q ldconfig libroam0.control/triggers || fail "libroam0 does not trigger ldconfig"
[[ $(zcat roam/usr/share/doc/roam/changelog.Debian.gz | head -1) == "roam ($version)"* ]] || fail "changelog.Debian"

# They work from where they were extracted.
printf 'v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n' > floor.obj
root/usr/bin/roam info floor.obj --json | grep -q '"triangles": 2' || fail "the program does not read a scene"
if [[ $names == *python3* ]] && /usr/bin/python3 -c 'import numpy' 2> /dev/null; then
  PYTHONPATH=root/usr/lib/python3/dist-packages /usr/bin/python3 -B -c \
    'import roam; assert roam.World.open("floor.obj").triangles == 2' || fail "the Python module does not work"
fi
cc -std=c99 "$source/examples/walk_in_c/walk_in_c.c" -o walk_in_c \
  $(PKG_CONFIG_PATH=root/usr/lib/$triplet/pkgconfig pkg-config --cflags --libs roam)
LD_LIBRARY_PATH=root/usr/lib/$triplet ./walk_in_c | grep -q 'stopped at x = 4.70 m' || fail "libroam.so does not work"

if command -v lintian > /dev/null; then
  lintian --allow-root --fail-on error --no-tag-display-limit packages/*.deb > lintian 2>&1 || { cat lintian; exit 1; }
fi
echo "packages of $version: $(du -ch packages/*.deb | tail -1 | cut -f 1)"
