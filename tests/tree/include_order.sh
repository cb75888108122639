#!/usr/bin/env bash
# Whether every #include runs down the house that docs/architecture.md draws.
#   include_order.sh SOURCE          fails for each include of src, include, apps, bench, baseline and python that runs up
#   include_order.sh SOURCE FAULTS   plants such includes into a copy and fails where they are not found
#
# The order is that of the picture: a folder may include from folders on lower lines. The table says of each public
# header to which folder it belongs. Above the line of the core only src/store may open the core's own folders; all may include
# src/motion/carrying.h. No other folder than bench includes from tests/made and tests/support.
set -euo pipefail

check() {
  cd "$1"
  {
    sed -n '/^```$/,/^```$/p' docs/architecture.md | sed 's/^/picture /'
    grep '^| `' docs/architecture.md | sed 's/^/table /'
    find apps bench baseline include python src tests -type f -printf 'file %p\n'
    grep -rnE --include='*.h' --include='*.cpp' '^ *#include "' apps bench baseline include python src | sed 's/^/include /'
  } | awk '
    function fail(text) { print text; failed = 1 }
    # The folder of the picture that a file belongs to: the longest that it lies in.
    function room_of(path,   at) {
      sub(/^include\/osgRoam\//, "src/osgroam/", path)
      if (path in room_of_header) return room_of_header[path]
      for (at = path; at != ""; at = at ~ /\// ? substr(at, 1, match(at, /\/[^\/]*$/) - 1) : "")
        if (at in rank) return at
      return path ~ /^tests\// ? "tests" : ""
    }
    function resolved(by, name,   folder, tried) {
      folder = substr(by, 1, match(by, /\/[^\/]*$/))
      tried = folder name
      while (sub(/[^\/]+\/\.\.\//, "", tried)) {}
      if (tried in files) return tried
      if (("include/" name) in files) return "include/" name
      if (("src/" name) in files) return "src/" name
      if (("apps/roam/" name) in files) return "apps/roam/" name
      if (("baseline/" name) in files) return "baseline/" name
      if (("tests/made/" name) in files) return "tests/made/" name
      if (("tests/support/" name) in files) return "tests/support/" name
      return (folder name ".in") in files ? "made" : ""
    }
    function wrong(from, to, what) {
      where[from " " to] = where[from " " to] "\n  " what
    }

    $1 == "picture" {
      if (/roam::roam, the core/) line = NR
      for (i = 2; i <= NF && $i !~ /^[a-z]/; ++i) {}
      if ($i ~ /^(apps|bench|baseline|include|python|src)(\/|$)/) rank[$i] = NR
    }
    $1 == "table" {
      split($0, column, "|")
      split(column[3], word, "`")
      folder = word[2]
      if (!(folder in rank)) folder = "src/" folder
      if (!(folder in rank)) { if (column[2] !~ /\*/) fail("docs/architecture.md draws no folder of" column[2]); next }
      headers = split(column[2], word, "`")
      for (i = 2; i <= headers; i += 2) room_of_header["include/roam/" word[i]] = folder
    }
    $1 == "file" { files[$2] = 1 }
    $1 == "include" {
      split($2, place, ":")
      by = place[1]
      match($0, /#include "[^"]*"/)
      name = substr($0, RSTART + 10, RLENGTH - 11)
      target = resolved(by, name)
      if (target == "made") next
      from = room_of(by)
      to = target == "" ? "" : room_of(target)
      what = by ":" place[2] " includes \"" name "\""
      if (from == "") { if (!(by in told)) fail("docs/architecture.md does not say where " by " belongs"); told[by] = 1; next }
      if (to == "") { fail(what ", which is nowhere"); next }
      if (from == to) next
      ++checked
      if (from == "bench" && target ~ /^tests\/(made|support)\//) next
      if (to == "tests" || rank[to] < rank[from]) wrong(from, to, what)
      else if (target ~ /^src\/(motion|world|index|sweep)\// && rank[from] < line && from !~ /^src\/store/ &&
               target != "src/motion/carrying.h") wrong(from, to, what)
    }
    END {
      if (!line || checked < 500) fail("docs/architecture.md or the sources were not understood: " checked " includes")
      for (pair in where) {
        split(pair, end, " ")
        fail(end[1] " includes what is above it, or inside of the core: " end[2] where[pair])
      }
      if (!failed) print checked " includes from one folder to another run down"
      exit failed
    }'
}

if (($# == 1)); then
  check "$1"
  exit
fi

source=$1
[[ $2 == FAULTS ]] || { echo "$2: the second argument is FAULTS or left out" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$source" && cp -r --parents docs/architecture.md apps bench baseline include python src tests "$work")

# planted FILE INCLUDE: the same with one line more must fail, and name it.
planted() {
  local said
  cp "$work/$1" "$work/kept"
  echo "#include \"$2\"" >> "$work/$1"
  if said=$(check "$work"); then echo "not found: $1 includes $2"; exit 1; fi
  [[ $said == *"$1:"*"$2"* ]] || { echo "$said"; echo "expected: $1 includes $2"; exit 1; }
  mv "$work/kept" "$work/$1"
}
check "$work"
planted src/sweep/sweep.cpp roam/world.h
planted src/ways/lattice/lattice.cpp ways/passage/ends.h
planted src/ways/passage/passage.cpp roam/train.h
planted src/profile/profile.cpp training/layout.h
planted src/cracks/cracks.h roam/train.h
planted apps/roam/walk.cpp motion/move.h
planted bench/judge.cpp verbs.h
planted src/store/store.cpp store_made.h
planted include/roam/space.h roam/walker.h
planted src/osgroam/box_search.cpp sweep/certified.h
