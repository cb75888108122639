#!/usr/bin/env bash
# Whether each public type of C++ is used by an example or a program.
#   public_types.sh SOURCE          fails for each type that none uses
#   public_types.sh SOURCE FAULTS   plants such types into a copy and fails where they are not found
#
# Programs are apps, bench, python, and the rooms that only programs and the C interface have. A type is used if they
# name it, call a function or use a member that results in it, pass it to a function without overloads, or use a type
# that derives from it. Comments do not count. The C interface, roam.h, counts as a program.
set -euo pipefail

rooms=(examples apps bench python src/{c,cli,draw,graphics,scenes,verify,words})

# Used by libraries above the core alone.
exceptions=(
  Floor  # of Space::floor_clearance(): ways and cracks look for floors
)

# bare FILE...: the text without comments and includes.
bare() { sed -E '/^ *#/d; /^ *("""|\*|\/\*)/d; s://.*::' "$@"; }

check() {
  cd "$1"
  local -a headers programs
  mapfile -t headers < <(find include -name '*.h' ! -name roam.h | sort)
  mapfile -t programs < <(find "${rooms[@]}" -type f \( -name '*.h' -o -name '*.cpp' -o -name '*.c' -o -name '*.py' \))
  {
    bare "${programs[@]}" | grep -oE '(\.|->)? *[A-Za-z_][A-Za-z_0-9]* *\(?' | tr -d ' ' | sort -u | sed 's/^/use /'
    # Declarations, one a line.
    for header in "${headers[@]}"; do
      bare "$header" | tr '\n' ' ' | sed -E 's/\[\[[a-z]*\]\]|META_Object\([^)]*\);//g; s/(public|protected|private):/;/g; s/[;{}]/&\n/g' |
        sed "s:^:in $header :"
    done
  } | awk -v exceptions="${exceptions[*]}" '
    $1 == "use" {
      word = $2
      is_call = sub(/\($/, "", word)
      if (sub(/^(\.|->)/, "", word)) member[word] = 1
      if (is_call) called[word] = 1
      named[word] = 1
      next
    }
    {
      header = $2
      $1 = $2 = ""
      if (match($0, /(^| )(struct|class|enum|enum class) [A-Za-z_0-9]+( final)?( :[^{]*)? *{$/)) {
        text = substr($0, RSTART, RLENGTH)
        sub(/ *(enum class|struct|class|enum) /, "", text)
        name = substr(text, 1, match(text, /[^A-Za-z_0-9]/) - 1)
        where[name] = header
        if (text ~ /:/) bases[name] = substr(text, index(text, ":"))
        next
      }
      if (match($0, /(^| )using [A-Za-z_0-9]+ =/)) {
        split(substr($0, RSTART, RLENGTH), part, " ")
        where[part[2]] = header
        next
      }
      if (/ typedef /) {
        match($0, /[A-Za-z_0-9]+;/)
        where[substr($0, RSTART, RLENGTH - 1)] = header
        next
      }
      line[++lines] = $0
    }
    # Every type in `text` is used.
    function use_all(text,   word) {
      while (match(text, /[A-Za-z_0-9]+/)) {
        word = substr(text, RSTART, RLENGTH)
        text = substr(text, RSTART + RLENGTH)
        if (word in where && !(word in used)) { used[word] = 1; again = 1 }
      }
    }
    END {
      for (i = 1; i <= lines; ++i) {
        if (line[i] !~ /\(/) continue
        head[i] = substr(line[i], 1, index(line[i], "(") - 1)
        sub(/ *$/, "", head[i])
        function_name[i] = substr(head[i], match(head[i], /[A-Za-z_0-9]*$/))
        sub(/[A-Za-z_0-9]*$/, "", head[i])
        parameters[i] = substr(line[i], index(line[i], "("))
        name = function_name[i]
        is_copy[i] = parameters[i] ~ "^\\( *(const )?" name " ?&&?" || parameters[i] ~ /= delete/ || head[i] ~ /~$/
        if (!is_copy[i]) ++overloads[name]
      }
      for (type in where) if (type in named) used[type] = 1
      do {
        again = 0
        for (type in bases) if (type in used) use_all(bases[type])
        for (i = 1; i <= lines; ++i) {
          name = function_name[i]
          if (name != "") {
            if (!(name in called) && !(name in where && name in named)) continue
            use_all(head[i])
            if (overloads[name] == 1 && !is_copy[i]) use_all(parameters[i])
          } else {
            text = line[i]
            sub(/ *(=|;|\{).*/, "", text)
            name = substr(text, match(text, /[A-Za-z_0-9]*$/))
            sub(/[A-Za-z_0-9]*$/, "", text)
            if (name in member) use_all(text)
          }
        }
      } while (again)
      split(exceptions, list, " ")
      for (i in list) {
        except[list[i]] = 1
        if (!(list[i] in where) || list[i] in used) { print list[i] " needs no exception"; failed = 1 }
      }
      for (type in where) {
        ++types
        if (!(type in used) && !(type in except)) { print where[type] ": " type " is used by no example and no program"; failed = 1 }
      }
      if (types < 100) { print "include was not understood: " types " types"; failed = 1 }
      if (!failed) print types " public types are used"
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
(cd "$source" && cp -r --parents include "${rooms[@]}" "$work")

# planted HEADER TEXT TYPE: the same with more text must fail, and name the type.
planted() {
  local said
  cp "$work/$1" "$work/kept"
  echo "$2" >> "$work/$1"
  if said=$(check "$work"); then echo "not found: $3"; exit 1; fi
  [[ $said == *"$1: $3 "* ]] || { echo "$said"; echo "expected: $3"; exit 1; }
  mv "$work/kept" "$work/$1"
}
check "$work"
planted include/roam/space.h 'struct Unloved { int a; };' Unloved
planted include/roam/space.h 'enum class Unloved : char { no };' Unloved
planted include/osgRoam/Triangles.h 'class Unloved : public roam::Space { };' Unloved
planted include/roam/math.h 'using Unloved = int; Unloved nobody_calls();' Unloved
planted include/roam/space.h 'struct Unloved { }; void sweep(const Unloved& another);' Unloved
