#!/usr/bin/env bash
# packages.sh SOURCE_FOLDER: what cmake/packages.sh asks of an apt-get that is made up here, and which knows all packages
# but libunknown-dev. Like the real one, it installs nothing where it does not know one of them.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat > "$work/apt-get" <<'FAKE'
#!/bin/bash
[[ " $* " == *" update "* ]] && exit 0
[[ " $* " == *" libunknown-dev "* ]] && exit 100
[[ " $* " == *" libbroken-dev "* && " $* " != *" --simulate "* ]] && exit 100
[[ " $* " == *" --simulate "* ]] || printf '%s\n' "$@" | grep -- '-dev$' >> "$INSTALLED"
exit 0
FAKE
printf '#!/bin/bash\nprintf "installed=libthere-dev not-installed=libgone-dev "\n' > "$work/dpkg-query"
printf '#!/bin/bash\necho "${USER_ID-0}"\n' > "$work/id"
printf '#!/bin/bash\nexec "$@"\n' > "$work/sudo"
chmod +x "$work"/*
export INSTALLED=$work/installed
source "$1/cmake/packages.sh"
PATH=$work:$PATH

# expect WHAT STATUS INSTALLED WORDS COMMAND...: the command's status, what it had installed, and what it said.
expect() {
  local what=$1 status=$2 installed=$3 words=$4 got=0 said
  shift 4
  : > "$INSTALLED"
  said=$("$@" 2>&1) || got=$?
  if [[ $got != "$status" || $(xargs < "$INSTALLED") != "$installed" || $said != *"$words"* ]]; then
    echo "$what: status $got, installed '$(xargs < "$INSTALLED")', said '$said'"
    exit 1
  fi
}

expect "asks only for what is not there" 0 "libgone-dev liba-dev" "" install_missing libthere-dev libgone-dev liba-dev
expect "fails where it needs what nobody has" 1 "" "libunknown-dev" install_missing libunknown-dev liba-dev
expect "installs what is offered, names the rest" 0 "liba-dev" "here: libunknown-dev" \
  install_optional libunknown-dev libthere-dev liba-dev
expect "goes on where that fails" 0 "" "here: libunknown-dev libbroken-dev" \
  install_optional libbroken-dev libunknown-dev
[[ -z $(install_missing libthere-dev 2>&1)$(install_optional libthere-dev 2>&1) ]] || { echo "says what is there"; exit 1; }
rm "$work/sudo"
export USER_ID=1000
if ! command -v sudo > /dev/null; then
  expect "fails without sudo" 1 "" "As root" install_missing liba-dev
  expect "goes on without sudo" 0 "" "here: liba-dev" install_optional liba-dev
fi
