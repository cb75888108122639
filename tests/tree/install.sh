#!/usr/bin/env bash
# What ctest runs against a fresh prefix into which roam was installed:
#   install.sh c       SOURCE PREFIX WORK CXX   builds examples/walk_in_c with CMake and with pkg-config and runs it
#   install.sh csharp  SOURCE PREFIX WORK CXX   compiles examples/walk_in_csharp with mono's compiler and runs it
#   install.sh wheel   SOURCE PREFIX WORK CXX   makes a wheel of the Python module and installs it in a venv
#   install.sh python  SOURCE PREFIX WORK CXX   imports the installed Python module and reads a file with it
#   install.sh example SOURCE PREFIX WORK CXX   builds examples/sweep_a_sphere outside the tree and runs it
#   install.sh moving  SOURCE PREFIX WORK CXX   builds examples/swinging_door and moving_platform and runs them
#   install.sh loading SOURCE PREFIX WORK CXX   builds examples/walk_while_loading outside the tree and runs it
#   install.sh way     SOURCE PREFIX WORK CXX   builds examples/find_a_way outside the tree and finds one through a door
#   install.sh import  SOURCE PREFIX WORK CXX   builds examples/walk_a_path outside the tree and walks with it
#   install.sh store   SOURCE PREFIX WORK CXX   builds examples/walk_a_store outside the tree, makes a store and walks in it
#   install.sh training SOURCE PREFIX WORK CXX   builds examples/train_a_scene outside the tree and trains a room with it
#   install.sh profile SOURCE PREFIX WORK CXX   builds a program that only keeps and applies a profile: it links the core
#   install.sh osg_one_line SOURCE PREFIX WORK CXX   builds that example outside the tree and drives into a wall with it
#   install.sh osg_paged_scene SOURCE PREFIX WORK CXX   builds that example outside the tree and looks at a paged scene
#   install.sh osg_intersector SOURCE PREFIX WORK CXX   builds that example outside the tree and runs it
#   install.sh package SOURCE PREFIX WORK CXX   asks find_package for versions and components that are there and that are not
#   install.sh readme  SOURCE PREFIX WORK CXX   does the same with the C++ program that README.md shows
set -euo pipefail
what=$1 source=$2 prefix=$3 work=$4 compiler=$5
rm -rf "$work"
mkdir -p "$work"

# build EXAMPLE [CMAKE ARGUMENTS...]: against the installed package only, with ordinary warnings as errors.
build() {
  cp -r "$source/examples/$1" "$work/example"
  cmake -S "$work/example" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" "${@:2}" > "$work/log" || { cat "$work/log"; exit 1; }
  cmake --build "$work/build" >> "$work/log" || { cat "$work/log"; exit 1; }
}

# expect TEXT COMMAND...: the command succeeds and says TEXT somewhere.
expect() {
  local text=$1 said
  shift
  said=$("$@") || { echo "failed with status $?: $*"; exit 1; }
  echo "$said"
  [[ $said == *"$text"* ]] || { echo "expected: $text"; exit 1; }
}

# start_screen: a display for the programs that follow.
start_screen() {
  mkfifo "$work/ready"
  exec {ready}<> "$work/ready"
  # -noreset: else the server starts anew, and refuses the next client, when the first has looked and left.
  Xvfb -noreset -displayfd "$ready" -screen 0 800x600x24 2> "$work/xvfb.log" &
  screen=$!
  trap 'kill "$screen"' EXIT
  read -r -t 60 -u "$ready" display || { cat "$work/xvfb.log"; exit 1; }
  export DISPLAY=":$display" LIBGL_ALWAYS_SOFTWARE=1 OSG_WINDOW="20 20 400 300"
}

case $what in
  example)
    build sweep_a_sphere
    expect 'stops at x = 19.' "$work/build/sweep_a_sphere"
    ;;
  c)
    build walk_in_c
    expect 'stopped at x = 4.70 m' "$work/build/walk_in_c"
    expect 'the wall is 5.00 m away' "$work/build/walk_in_c"
    export PKG_CONFIG_PATH
    PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name roam.pc)")
    flags=$(pkg-config --cflags --libs roam)
    cc -std=c99 -Wall -Wextra -Wpedantic -Werror "$work/example/walk_in_c.c" $flags -o "$work/walk_in_c"
    expect 'stopped at x = 4.70 m' env LD_LIBRARY_PATH="$PKG_CONFIG_PATH/.." "$work/walk_in_c"
    ;;
  csharp)
    for tool in mcs mono; do
      command -v "$tool" > /dev/null || { echo "there is no $tool: not run"; exit 77; }
    done
    mcs -warnaserror "$source/examples/walk_in_csharp/walk.cs" -out:"$work/walk.exe"
    export LD_LIBRARY_PATH
    LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name libroam.so.0)")
    expect 'the wall is 5.00 m away' mono "$work/walk.exe"
    expect 'stopped at x = 4.70 m' mono "$work/walk.exe"
    ;;
  wheel)
    /usr/bin/python3 -c 'import build, setuptools, venv, ensurepip' 2> /dev/null ||
      { echo "there is no python3-build or python3-venv: not run"; exit 77; }
    # Of the files that are installed.
    mkdir "$work/module"
    cp -r "$(find "$prefix" -path '*/dist-packages/roam')" "$work/module"
    version=$(sed -n 's/^#define ROAM_VERSION_STRING "\(.*\)"$/\1/p' "$prefix/include/roam/version.h")
    sed "s/@PROJECT_VERSION@/$version/" "$source/python/pyproject.toml.in" > "$work/module/pyproject.toml"
    /usr/bin/python3 -m build --no-isolation --wheel --outdir "$work" "$work/module" > "$work/log" 2>&1 ||
      { cat "$work/log"; exit 1; }
    /usr/bin/python3 -m venv --system-site-packages "$work/venv"
    "$work/venv/bin/pip" install --no-index --no-deps "$work/roam-$version-py3-none-any.whl" > "$work/log" 2>&1 ||
      { cat "$work/log"; exit 1; }
    export LD_LIBRARY_PATH
    LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name libroam.so.0)")
    printf 'v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n' > "$work/floor.obj"
    expect "2 triangles, $version from $work/venv" "$work/venv/bin/python" -c "
import importlib.metadata, roam
print(roam.World.open('$work/floor.obj').triangles, 'triangles,', importlib.metadata.version('roam'), 'from', roam.__file__)"
    ;;
  python)
    printf 'v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n' > "$work/floor.obj"
    export PYTHONPATH
    PYTHONPATH=$(dirname "$(find "$prefix" -path '*/dist-packages/roam')")
    # The reader of the package is found from its libroam.so.
    expect '2 triangles, 2.7 m up' env -C "$work" /usr/bin/python3 -B -c "
import roam
world = roam.World.open('floor.obj')
print(f'{world.triangles} triangles, {3 * world.sweep(0.3, [1, 1, 3], [0, 0, -3]).time:.1f} m up')"
    ;;
  moving)
    build swinging_door
    expect 'shut: the person is stopped by the door at x = -0.3' "$work/build/swinging_door"
    expect 'shut again: the person was moved to x = -0.3' "$work/build/swinging_door"
    rm -r "$work/example" "$work/build"
    build moving_platform
    expect 'carried to x = 18.' "$work/build/moving_platform"
    ;;
  loading)
    build walk_while_loading
    expect 'reached after 18.0 m, over 4 of 4 tiles' "$work/build/walk_while_loading"
    ;;
  way)
    build find_a_way
    # A floor, and across it a wall with a door 0.9 m wide.
    printf 'v %s\n' '0 0 0' '9 0 0' '9 9 0' '0 9 0' > "$work/door.obj"
    printf 'v 5 %s\n' '0 0' '4 0' '4 3' '0 3' '4.9 0' '9 0' '9 3' '4.9 3' >> "$work/door.obj"
    printf 'f 1 2 3 4\nf 5 6 7 8\nf 9 10 11 12\n' >> "$work/door.obj"
    said=$("$work/build/find_a_way" "$work/door.obj" 1 1 0 8 1 0)
    echo "$said"
    [[ $said == *'radius of at most 0.45'*'because of a door 0.90'*'reached after'* ]] || exit 1
    ;;
  import)
    build walk_a_path
    printf 'v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n' > "$work/floor.obj"
    printf '1 1 0.9\n8 8 0.9\n' > "$work/across.path"
    # The package was configured for another prefix than this: it tells its programs where its reader is.
    expect 'reached after 9.9 m' "$work/build/walk_a_path" "$work/floor.obj" "$work/across.path"
    ;;
  store)
    build walk_a_store
    printf 'v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n' > "$work/floor.obj"
    printf '1 1 0.9\n8 8 0.9\n' > "$work/across.path"
    expect 'built' "$work/build/walk_a_store" "$work/floor.obj" "$work/floor.roam" "$work/across.path"
    expect 'up to date' "$work/build/walk_a_store" "$work/floor.obj" "$work/floor.roam" "$work/across.path"
    expect 'reached after 9.9 m, 16 MB' "$work/build/walk_a_store" "$work/floor.obj" "$work/floor.roam" "$work/across.path"
    ;;
  training)
    build train_a_scene
    # A room of 9 m by 5 m by 3 m.
    printf 'v 0 0 0\nv 9 0 0\nv 9 5 0\nv 0 5 0\nv 0 0 3\nv 9 0 3\nv 9 5 3\nv 0 5 3\n' > "$work/room.obj"
    printf 'f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n' >> "$work/room.obj"
    expect 'radius of 0.300 m' "$work/build/train_a_scene" "$work/room.obj"
    [[ -s $work/room.obj.roam.json ]]
    ;;
  profile)
    mkdir "$work/example"
    cat > "$work/example/CMakeLists.txt" << 'END'
cmake_minimum_required(VERSION 3.22)
project(apply_a_profile LANGUAGES CXX)
find_package(roam REQUIRED COMPONENTS profile)
foreach(other IN ITEMS store import ways training)
  if(TARGET roam::${other})
    message(FATAL_ERROR "roam::profile brings roam::${other}")
  endif()
endforeach()
add_executable(apply_a_profile main.cpp)
target_link_libraries(apply_a_profile PRIVATE roam::profile)
END
    cat > "$work/example/main.cpp" << 'END'
#include <cstdio>
#include <roam/profile.h>
#include <roam/size_learner.h>

int main(int, char** argv) {
  const roam::Mesh floor{"floor", {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}, {{0, 1, 2}}};
  roam::Profile profile;
  profile.scene = roam::identity_of({&floor, 1});
  profile.radius = 0.25;
  profile.height = 1.7;
  roam::save_profile(profile, argv[1]);
  const roam::SizeLearner learner(roam::load_profile(argv[1]));
  const roam::WalkerSettings body = roam::apply(learner.profile(), {});
  std::printf("a body of %.2f m, %.1f m high\n", body.radius, body.height);
}
END
    cmake -S "$work/example" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
      -DCMAKE_CXX_FLAGS="-std=c++20 -Wall -Wextra -Werror" > "$work/log" || { cat "$work/log"; exit 1; }
    cmake --build "$work/build" >> "$work/log" || { cat "$work/log"; exit 1; }
    expect 'a body of 0.25 m, 1.7 m high' "$work/build/apply_a_profile" "$work/floor.json"
    ;;
  osg_one_line)
    build osg_one_line
    # A wall of 2 m at y = 0: OpenSceneGraph turns OBJ to z up. Home is 5 m before it, and W with Shift flies at 7 m/s.
    printf 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n' > "$work/wall.obj"
    start_screen
    "$work/build/osg_one_line" "$work/wall.obj" > "$work/said" 2>&1 &
    viewer=$!
    timeout 60 xdotool search --sync --onlyvisible --name '.*' mousemove 100 100 > /dev/null
    sleep 2
    xdotool keydown shift keydown w
    sleep 5
    xdotool keyup w keyup shift
    sleep 1
    xdotool key Escape
    wait "$viewer" || { cat "$work/said"; exit 1; }
    expect 'the camera was last at 0.00 -0.30 ' cat "$work/said"
    ;;
  osg_paged_scene)
    build osg_paged_scene
    [[ -d ${ROAM_TEST_DATA-}/pit_osgb ]] || { echo "there is no ROAM_TEST_DATA/pit_osgb: not run"; exit 77; }
    start_screen
    export OSG_WINDOW="0 0 800 600"  # the more pixels, the finer the tiles
    root=("$ROAM_TEST_DATA"/pit_osgb/Data/*/Tile_+000_+000.osgb)
    "$work/build/osg_paged_scene" "${root[0]}" > "$work/said" 2>&1 &
    viewer=$!
    timeout 60 xdotool search --sync --onlyvisible --name '.*' mousemove 100 100 > /dev/null
    # To where the pager reads finer tiles.
    xdotool keydown shift keydown w
    sleep 8
    xdotool keyup w keyup shift
    sleep 4
    xdotool key Escape
    wait "$viewer" || { cat "$work/said"; exit 1; }
    cat "$work/said"
    # More than the root: the pager read on, and what it read is in use.
    (($(sed -n 's/^\([0-9]*\) files.*/\1/p' "$work/said") > 1)) || exit 1
    ;;
  osg_intersector)
    build osg_intersector
    expect 'door open 60 degrees: stops at y = 0.639 m, before the face of "leaf"' "$work/build/osg_intersector"
    expect 'door open 90 degrees: stops at y = 2.8' "$work/build/osg_intersector"
    ;;
  package)
    # configure REQUEST [LINES]: a project that asks for nothing else.
    configure() {
      printf 'cmake_minimum_required(VERSION 3.22)\nproject(asks LANGUAGES CXX)\nfind_package(roam %s)\n%s\n' "$1" \
        "${2:-}" > "$work/CMakeLists.txt"
      rm -rf "$work/build"
      cmake -S "$work" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" 2>&1
    }
    # refused TEXT REQUEST: configuring fails and says TEXT, however its lines are broken.
    refused() {
      local said
      if said=$(configure "$2"); then echo "was found: $2"; exit 1; fi
      said=$(tr -s ' \n' ' ' <<< "$said")
      [[ $said == *"$1"* ]] || { echo "$said"; echo "expected: $1"; exit 1; }
    }
    for component in roam files process import generate store ways profile training osgRoam; do
      request=REQUIRED
      [[ $component == roam ]] || request="REQUIRED COMPONENTS $component"
      expect "Generating done" configure "$request" "get_target_property(kind roam::$component TYPE)
        get_target_property(kind roam::roam TYPE)"
    done
    version=$(sed -n 's/^#define ROAM_VERSION_STRING "\(.*\)"$/\1/p' "$prefix/include/roam/version.h")
    numbers=$(sed -n 's/^#define ROAM_VERSION_\(MAJOR\|MINOR\|PATCH\) \(.*\)$/\2/p' "$prefix/include/roam/version.h")
    [[ $version == "$(paste -sd. <<< "$numbers")" ]] || { echo "version.h tells two versions"; exit 1; }
    expect "is $version." configure "$version REQUIRED" 'message(STATUS "it is ${roam_VERSION}.")'
    refused 'roam has no component "wings" here; it has: c, files, generate, import, osgRoam, process, profile, store, '\
'training, ways' 'REQUIRED COMPONENTS files wings'
    refused 'compatible with requested version "99"' '99 REQUIRED'
    expect 'goes without wings' configure 'REQUIRED OPTIONAL_COMPONENTS wings' 'if(NOT roam_wings_FOUND)
      message(STATUS "goes without wings")
    endif()'
    ;;
  readme)
    sed -n '/^```cpp$/,/^```$/p' "$source/README.md" | sed '/^```/d' > "$work/readme.cpp"
    lines=$(grep -c . "$work/readme.cpp")
    ((lines >= 8 && lines <= 12)) || { echo "README.md promises ten lines of C++ and shows $lines"; exit 1; }
    build sweep_a_sphere -DSWEEP_A_SPHERE_SOURCE="$work/readme.cpp"
    expected=$(sed -n 's/^It prints `\(.*\)`\.$/\1/p' "$source/README.md")
    [[ $expected ]] || { echo "README.md does not say what its example prints"; exit 1; }
    expect "$expected" "$work/build/sweep_a_sphere"
    ;;
esac
