# What roam is built from, as Debian and Ubuntu name it, and how what is missing gets installed.
# Sourced by ./demo and ./check; docs/dependencies.md says what each package is for.

program_packages="g++ cmake ninja-build ccache pkg-config
  libglm-dev libtbb-dev libhwy-dev
  libopenscenegraph-dev libassimp-dev libdraco-dev libmeshoptimizer-dev zlib1g-dev libminizip-dev libfast-float-dev libtinyxml2-dev libtinyobjloader-dev libxxhash-dev
  libcli11-dev libfmt-dev nlohmann-json3-dev libcairo2-dev libzstd-dev libssl-dev libcurl4-openssl-dev libseccomp-dev
  libegl-dev libgl-dev libx11-dev libfontconfig-dev libgl1-mesa-dri fonts-dejavu-core"
device_packages="libsdl2-dev libspnav-dev"  # gamepads and SpaceMice: roam is built without those that are not there
test_packages="libgtest-dev valgrind xvfb xdotool ffmpeg locales strace gltfpack nginx-light"
python_packages="python3-numpy"  # what `import roam` needs, and nothing else
# Checks of man pages, completion, packages, batch engines and the examples in other languages, fuzzing (libFuzzer) and
# properties (RapidCheck): tests without them are skipped.
tool_packages="dpkg-dev lintian mandoc man-db zsh fish bash-completion desktop-file-utils shared-mime-info libglib2.0-bin
  mono-mcs mkdocs mkdocs-material python3-matplotlib python3-build python3-venv python3-setuptools python3-wheel
  slurmctld slurmd slurm-client parallel libclang-rt-dev librapidcheck-dev"
bench_packages="libbullet-dev libembree-dev libfcl-dev libogre-1.12-dev"  # benchmarks do without those that are not there

# missing_of PACKAGE...: those that are not installed.
missing_of() {
  local installed package
  installed=" $(dpkg-query --show --showformat='${db:Status-Status}=${Package} ' 2> /dev/null)"
  for package in "$@"; do
    [[ $installed == *" installed=$package "* ]] || echo "$package"
  done
}

# install_missing PACKAGE...: asks apt only for packages that are not there, and is silent when all of them are.
install_missing() {
  if ! command -v dpkg-query > /dev/null; then
    echo "This is no Debian or Ubuntu: roam needs what these packages hold, from wherever you get them:" >&2
    echo "  $*" >&2
    return 0
  fi
  local missing as_root=()
  mapfile -t missing < <(missing_of "$@")
  ((${#missing[@]})) || return 0

  if (($(id -u) != 0)); then
    if ! command -v sudo > /dev/null; then
      echo "These packages are missing, and there is no sudo here to install them with. As root:" >&2
      echo "  apt-get install ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "Installing with apt-get: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq < /dev/null &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -qq --no-install-recommends "${missing[@]}" < /dev/null && return 0
  echo "apt-get could not install all of: ${missing[*]}" >&2
  echo "Install them by hand and start again; docs/dependencies.md says what each one is for." >&2
  return 1
}

# install_optional PACKAGE...: the same for packages that may be left out. Those that cannot be had are named.
install_optional() {
  local package offered=() left_out=()
  if ! command -v dpkg-query > /dev/null; then
    left_out=("$@")
  else
    for package in $(missing_of "$@"); do
      # One by one: apt-get installs none of several packages when it does not know one of them.
      if apt-get install --simulate -qq --no-install-recommends "$package" &> /dev/null < /dev/null; then
        offered+=("$package")
      else
        left_out+=("$package")
      fi
    done
    if ((${#offered[@]})) && ! install_missing "${offered[@]}"; then left_out+=("${offered[@]}"); fi
  fi
  ((${#left_out[@]} == 0)) || echo "Going on without what apt-get does not offer or install here: ${left_out[*]}" >&2
}

# configure PRESET [ARGUMENTS...]: quiet when it succeeds, the whole log when it does not.
configure() {
  local log
  if log=$(cmake --preset "$@" 2>&1 < /dev/null); then
    return 0
  fi
  echo "$log" >&2
  echo "Configuring failed. A build directory that another compiler or clone has left behind can cause this:" >&2
  echo "remove it and start again." >&2
  return 1
}

# behind_line TITLE LOG COMMAND...: runs the command, appends its output to the file LOG, and shows one line that says how
# far it is. If it fails, shows the end of LOG.
behind_line() {
  local - title=$1 log=$2
  set -o pipefail
  shift 2
  if "$@" 2>&1 < /dev/null | tee -a "$log" | one_line "$title"; then
    [[ ! -t 1 ]] || printf '\r\e[K%s: done\n' "$title"
    return 0
  fi
  [[ ! -t 1 ]] || echo
  echo "$title: failed. The end of $log:" >&2
  tail -n 40 "$log" >&2
  return 1
}

# one_line TITLE: reads the output of ninja or apt-get and shows the progress: on a terminal in one line that changes,
# else in a line for each tenth.
one_line() {
  local title=$1 begin=$SECONDS line shown='' text tenth last=-1 done all
  while IFS= read -r line; do
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
      done=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
      text="$((100 * done / all)) %"
      tenth=$((10 * done / all))
      if ((SECONDS - begin >= 10)); then
        text+=", $(((SECONDS - begin) * (all - done) / done / 60 + 1)) min left"
      fi
    elif [[ $line =~ ^(Unpacking|Setting\ up)\ ([^ ]+) ]]; then
      text=${BASH_REMATCH[0]}
      tenth=$last
    else
      continue
    fi
    if [[ -t 1 ]]; then
      [[ $text == "$shown" ]] || printf '\r\e[K%s: %s' "$title" "$text"
    elif ((tenth > last)); then
      echo "$title: $text"
    fi
    shown=$text last=$tenth
  done
}
