#!/usr/bin/env bash
# tests/long/arm.sh [FOLDER [CTEST OPTIONS...]]
# Builds the core for ARM64 in FOLDER (build-arm) and runs its tests under QEMU, with NEON: the oracle, brute force, and
# the digests of answers and walks that every processor must give (InstructionSets). Needs g++-aarch64-linux-gnu,
# qemu-user and a mirror of Debian 12: the libraries are unpacked into FOLDER, nothing is installed. Some hours.
set -euo pipefail
source_folder=$(realpath "$(dirname "$0")/../..")
folder=$(realpath -m "${1:-$source_folder/build-arm}")
shift $(($# ? 1 : 0))
for tool in aarch64-linux-gnu-g++ qemu-aarch64; do
  command -v "$tool" > /dev/null ||
    { echo "there is no $tool; as root: apt-get install g++-aarch64-linux-gnu qemu-user" >&2; exit 77; }
done
root=$folder/root libraries=$folder/root/usr/lib/aarch64-linux-gnu
if [[ ! -e $libraries/libhwy.so ]]; then
  mkdir -p "$folder"/apt/{lists,cache/archives}/partial "$folder/packages"
  apt=(apt-get -qq -o APT::Architectures::=arm64 -o "APT::Architectures::=$(dpkg --print-architecture)"
       -o Dir::State::lists="$folder/apt/lists" -o Dir::Cache="$folder/apt/cache" -o APT::Sandbox::User=root)
  "${apt[@]}" update
  (cd "$folder/packages" && "${apt[@]}" download libglm-dev lib{hwy-dev,hwy1,tbb-dev,tbb12,tbbmalloc2,tbbbind-2-5,gtest-dev}:arm64)
  for package in "$folder"/packages/*.deb; do dpkg-deb --extract "$package" "$root"; done
fi
export PKG_CONFIG_LIBDIR=$libraries/pkgconfig PKG_CONFIG_SYSROOT_DIR=$root
cmake -S "$source_folder" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DROAM_TOOLS=OFF -DROAM_WERROR=ON \
  -DROAM_TEST_TIMEOUT=3600 \
  -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_LIBRARY_ARCHITECTURE=aarch64-linux-gnu \
  -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
  -DCMAKE_FIND_ROOT_PATH="$root;/usr/aarch64-linux-gnu" -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER \
  -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY \
  -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY \
  "-DCMAKE_CROSSCOMPILING_EMULATOR=qemu-aarch64;-L;/usr/aarch64-linux-gnu;-E;LD_LIBRARY_PATH=$libraries"
cmake --build "$folder"
exec "$source_folder/tests/long/ctest.sh" "$folder" "$@"
