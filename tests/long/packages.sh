#!/usr/bin/env bash
# tests/long/packages.sh [FOLDER [SUITE]]
# Installs the Debian packages in FOLDER (those that ./check -R DebianPackages makes) into a fresh Debian SUITE (this
# system's), and uses all of them there: program, manual, Python module, C and C++ examples. Upgrades them to a later
# version, removes and purges them. Nothing may be left, and no step may warn. Takes 2 GB of disk; needs root, debootstrap
# and a mirror.
set -euo pipefail
source_folder=$(realpath "$(dirname "$0")/../..")
packages=$(realpath -m "${1:-$source_folder/build-check/tests/debian/packages}")
suite=${2:-$(. /etc/os-release && echo "$VERSION_CODENAME")}
for tool in debootstrap dpkg-deb; do
  command -v "$tool" > /dev/null || { echo "there is no $tool; as root: apt-get install debootstrap dpkg-dev"; exit 77; }
done
(($(id -u) == 0)) || { echo "a fresh Debian needs root"; exit 77; }
names='roam roam-reader libroam0 libroam-dev python3-roam roam-doc'
for name in $names; do
  compgen -G "$packages/${name}_*.deb" > /dev/null ||
    { echo "there is no $name in $packages: ./check -R DebianPackages"; exit 1; }
done
cd "$packages"
work=$(mktemp -d)
root=$work/root
end() {
  for mounted in "$root/dev/pts" "$root/proc"; do
    if mountpoint -q "$mounted"; then umount "$mounted"; fi
  done
  rm -rf --one-file-system "$work"
}
trap end EXIT
fail() { echo "$1"; exit 1; }
# inside COMMAND...: runs it in the fresh Debian.
inside() {
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive chroot "$root" "$@"
}
# step TITLE COMMAND...: quiet unless it fails or warns.
step() {
  echo "$1 ($SECONDS s)"
  "${@:2}" > "$work/log" 2>&1 || { cat "$work/log"; fail "$1: failed"; }
  ! grep -iE '^(W:|E:|dpkg: (warning|error))|SyntaxWarning' "$work/log" || fail "$1: warnings"
}
# expect TEXT COMMAND...: inside, the command succeeds and says TEXT.
expect() {
  local said
  said=$(inside "${@:2}" 2>&1) || { echo "$said"; fail "failed: ${*:2}"; }
  [[ $said == *"$1"* ]] || { echo "$said"; fail "expected: $1"; }
}
files() {
  (cd "$root" && find . -xdev \( -path ./proc -o -path ./dev -o -path ./var -o -path ./tmp -o -path ./packages \) \
    -prune -o -print) | sort
}

step "debootstrap $suite" debootstrap --variant=minbase "$suite" "$root"
mount -t proc proc "$root/proc"
mount -t devpts devpts "$root/dev/pts"
# Packages come from where this system's own come from, and from no other archive: its key would be missing.
apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' \
  "Origin: $(. /etc/os-release && echo "${ID^}")" | sort -u > "$root/etc/apt/sources.list"
[[ -s $root/etc/apt/sources.list ]] || fail 'apt knows no archive of this system: apt-get update'
cp /etc/apt/apt.conf.d/*proxy* "$root/etc/apt/apt.conf.d/" 2> /dev/null || true  # there may be none
cp /etc/resolv.conf "$root/etc/"
# As on a desktop: the manual, which minbase leaves out, and what keeps the menus.
rm -f "$root"/etc/dpkg/dpkg.cfg.d/*
step 'apt-get update' inside apt-get update
step 'a compiler, the manual, the menus' inside apt-get install -y --no-install-recommends \
  g++ cmake make man-db desktop-file-utils shared-mime-info libglib2.0-bin
# All that they need, so that afterwards only roam's own files differ.
mkdir "$root/packages"
cp $(for name in $names; do ls "$name"_*.deb; done) "$root/packages"
step 'what the packages need' inside bash -c \
  'apt-get install -y --no-install-recommends /packages/*.deb && dpkg --purge '"$names"' && dpkg --configure -a'
files > "$work/before"

step 'install' inside bash -c 'apt-get install -y --no-install-recommends /packages/*.deb'
[[ -z $(inside dpkg --audit) ]] || fail 'dpkg --audit complains'
printf 'v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n' > "$root/tmp/floor.obj"
printf '1 1 0.9\n8 8 0.9\n' > "$root/tmp/across.path"
use() {
  expect 'REACHED' roam walk /tmp/floor.obj --path /tmp/across.path --verify
  expect '2 triangles' python3 -c 'import roam; print(roam.World.open("/tmp/floor.obj").triangles, "triangles")'
  expect 'SYNOPSIS' man roam-walk
  printf 'roam store 1\n%064d\n' 0 > "$root/tmp/CURRENT"
  expect 'application/x-roam-store' gio info -a standard::content-type /tmp/CURRENT
  expect 'roam.desktop' gio mime application/x-roam-store
  expect 'reached after 9.9 m' bash -c 'cd /tmp && rm -rf build &&
    cmake -S /usr/share/doc/roam/examples/walk_a_path -B build > log && cmake --build build > log &&
    build/walk_a_path floor.obj across.path'
  expect 'stopped at x = 4.70 m' bash -c 'cd /tmp &&
    cc /usr/share/doc/roam/examples/walk_in_c/walk_in_c.c -o walk_in_c $(pkg-config --cflags --libs roam) &&
    ./walk_in_c'
}
echo "use ($SECONDS s)"
use

# The same files as the version after this one.
for file in "$root"/packages/*.deb; do
  dpkg-deb --raw-extract "$file" "$work/later"
  sed -i -E 's/^(Version: .*)$/\1+later/; s/(roam[^ ]*) \((=|>=) ([^)]*)\)/\1 (\2 \3+later)/g' \
    "$work/later/DEBIAN/control"
  name=$(basename "$file")
  dpkg-deb --build --root-owner-group "$work/later" "$work/${name%_*}+later_${name##*_}" > /dev/null
  rm -r "$work/later"
done
rm "$root"/packages/*.deb
mv "$work"/*.deb "$root/packages"
step 'upgrade' inside bash -c 'apt-get install -y --no-install-recommends /packages/*.deb'
[[ $(inside dpkg-query --show --showformat '${Version}' roam) == *+later ]] || fail 'was not upgraded'
use

step 'remove' inside apt-get remove -y $names
step 'purge' inside dpkg --purge libroam0  # the only one that is not gone, because it has a postrm
[[ -z $(inside dpkg-query --show '*roam*' 2> /dev/null) ]] || fail 'dpkg still knows a package'
rm "$root"/packages/*.deb
files > "$work/after"
diff "$work/before" "$work/after" || fail 'something is left, or missing'
echo "$(wc -w <<< "$names") packages installed in $suite, used, upgraded, removed: 0 files left; $SECONDS s"
