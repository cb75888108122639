#!/usr/bin/env bash
# Runs the commands that the documents show, and looks up the options that they mention.
#   commands.sh SOURCE WORK PATH DOCUMENT...   DOCUMENT relative to SOURCE; PATH has the programs; without benchmarks
#                                              if ROAM_NO_BENCH is set
#   commands.sh SOURCE WORK PATH               plants faults into a small document and fails where they are not found
#
# A command is a line of a code block, or a `code span` with a program and an input. It succeeds with exit status 0, or
# 3, the answer "no". Scenes and paths that a document does not make itself have stand-ins; great scenes become small.
# In other code spans, each --option must be one of the program's, and the test that a command of ctest names must exist.
set -euo pipefail
source=$(realpath "$1") work=$2
export PATH=$3:$PATH LIBGL_ALWAYS_SOFTWARE=1
shift 3
verbs='view|walk|probe|sweep|info|train|make|verify|build|publish|cluster|bench'

# code DOCUMENT: lines `block COMMAND` and `span COMMAND`, in their order.
code() {
  awk '
    # Spans of the paragraph that ends here. They may reach over lines.
    function spans(   parts, n, i) {
      n = split(paragraph, parts, "`")
      for (i = 2; i <= n; i += 2) print "span", parts[i]
      paragraph = ""
    }
    /^```/ { spans(); fenced = !fenced; shell = fenced && $0 == "```sh"; next }
    fenced { if (shell && NF) print "block", $0; next }
    /^    / && blank { indented = 1 }
    !/^    / && NF { indented = 0 }
    { blank = !NF }
    indented { if (NF) { sub(/^    /, ""); print "block", $0 }; next }
    !NF { spans(); next }
    { paragraph = paragraph " " $0 }
    END { spans() }' "$1"
}

# with_stand_ins COMMAND: on files that are here, with small scenes, and without a window.
with_stand_ins() {
  local command
  command=$(sed -E "
    s/ +# .*//
    s/ \.\.\.( |$)/ /g; s/\.\.\.//g
    s#(^|[ |])build/roam #\1roam #g
    s#\b(mine\.dae|house\.(obj|glb)|small_house\.glb|[a-z_]+_visual\.dae|pipes\.ply|Data/|SCENE|[a-z_0-9]+_kt2\.ply)( |\$)#room.obj\3#g
    s#\b(STORE|(X|SCENE)\.roam)\b#room.obj.roam#g; s#\bhelp VERB\b#help walk#; s#your/own/gallery\.ive|gallery103\.ply#gallery.ply#g
    s#--from A --to B#--from 1,2,1 --to 8,3,1#; s#--path (P|FILE)\b#--path tour.path#
    s#--wasm-engines( DIR)?|--scratch /big/disk|--submit##; s#\bDIR\b#.#g
    s#\btrain gallery\.ply#train room.obj#;
    s#--unit in --from [^ ]+ --to [^ ]+#--from 1,2,1 --to 8,3,1#; s#--radius R\b#--radius 0.3#
    s#--triangles (600k|2M|100M)#--triangles 50k#; s#--gallery 500000#--gallery 20000#; s#--least 100k#--least 20k#
    s#--quality Q\b#--quality light#; s#--size [0-9]+x[0-9]+#--size 160x120#
    s#--turntable 12#--turntable 1#; s#--fps [0-9]+#--fps 10#; s#--patience (10|30)\b#--patience 0.5#
    s#--queries 10000#--queries 100#; s#(roam bench engines) --picture\$#\1#; s# +# #g; s# \$##" <<< "$1")
  [[ $command != *--record* || $command == *--fps* ]] || command+=" --fps 10"
  case $command in
    "roam make gallery -o gallery.ply") command+=" --triangles 50k" ;;
    "roam bench scale") command+=" --least 20k --triangles 50k" ;;
    "roam bench labels "*.npy) command+=" --count 100" ;;
    "roam bench labels "*) ;;
    bench_osg_intersectors*) command+=" --triangles 50k" ;;
    "roam bench "*)
      [[ $command == *--triangles* || $command == *--scene* ]] || command+=" --triangles 50k"
      [[ $command != "roam bench walkers"* ]] || command+=" --rounds 1 --patience 0.5"
      [[ $command != "roam bench paper"* || $command == *--patience* ]] || command+=" --patience 0.5"
      [[ $command != "roam bench engines"* || $command == *--queries* ]] || command+=" --queries 100 --patience 0.5"
      ;;
    *"roam view "*--screenshot*) ;;
    *"roam view "*--size*) command+=" --headless --screenshot seen.png" ;;
    *"roam view "*) command+=" --headless --size 160x120 --screenshot seen.png" ;;
  esac
  echo "$command"
}

# is_complete COMMAND: it names an input, and can be run.
is_complete() {
  case $1 in
    *" --judge "*) false ;;
    "roam make "*) [[ $1 == *" -o "* ]] ;;
    "roam help "* | "roam --version") true ;;
    "roam bench "* | bench_*" "*) true ;;
    roam\ *) [[ $1 =~ ^roam\ ($verbs)\ ([^-]|-o\ ) ]] ;;
    *) false ;;
  esac
}

# help_of PROGRAM [VERB [KIND]]: each one only once.
declare -A helps=()
help_of() {
  [[ ${helps["$*"]:-} ]] || helps["$*"]=$("$@" --help 2>&1)
  help=${helps["$*"]}
}

# options_of COMMAND: fails for one that its program does not have.
options_of() {
  local -a words
  read -ra words <<< "$1"
  local -a program=("${words[0]}")
  [[ ${words[1]:-} =~ ^($verbs)$ ]] && program+=("${words[1]}")
  [[ ${words[1]:-} =~ ^(bench|make|cluster)$ && ${words[2]:-} =~ ^[a-z]+$ ]] && program+=("${words[2]}")
  [[ ${program[*]} == roam\ bench ]] && return
  help_of "${program[@]}"
  local option
  for option in $(grep -oE -- '(^| )--[a-z][a-z-]*' <<< "$1" || true); do
    grep -qE -- "(^|[ ,])$option\b" <<< "$help" || { echo "${program[*]} has no $option"; return 1; }
  done
}

# has_option OPTION: some program's.
all_helps=
has_option() {
  local verb
  if [[ ! $all_helps ]]; then
    for verb in ${verbs//|/ }; do help_of roam "$verb"; all_helps+=$help; done
    for verb in gallery terrain city; do help_of roam make "$verb"; all_helps+=$help; done
    help_of roam cluster slurm; all_helps+=$help
    [[ ${ROAM_NO_BENCH:-} ]] || for verb in engines labels paper scale walkers; do help_of roam bench "$verb"; all_helps+=$help; done
  fi
  grep -qE -- "(^|[ ,])$1\b" <<< "$all_helps"
}

# run COMMAND: once.
declare -A succeeded=()
run() {
  local status=0
  [[ ! ${succeeded[$1]:-} ]] || return 0
  echo "\$ $1"
  bash -c "set -o pipefail; $1" > said 2>&1 < /dev/null || status=$?
  ((status != 0 && status != 3)) || { succeeded[$1]=yes; return 0; }
  cat said
  echo "exit status $status"
  return 1
}

# check DOCUMENT
check() {
  local kind text command test failed=0
  local -i ran=0 looked_up=0
  fail() { echo "$1: $2"; failed=1; }
  while read -r kind text; do
    case $text in
      *http://* | *https://* | *localhost*) continue ;;  # tests/tree/serving.sh runs those of docs/serving.md
      ./demo* | ./check* | cmake\ * | ctest\ * | ROAM_* | git\ *)
        [[ $text =~ ctest.*-R\ ([a-z_]+) ]] || continue
        test=${BASH_REMATCH[1]}
        [[ -e $source/tests/${test/_//alone/}.cpp || -d $source/tests/$test ]] ||
          grep -q "roam_test_script($test\." "$source/tests/CMakeLists.txt" || fail "$1" "no test $test: $text"
        ;;
      bench_* | roam\ bench*) [[ ! ${ROAM_NO_BENCH:-} ]] || continue ;;&
      roam\ * | build/roam\ * | bench_*)
        command=$(with_stand_ins "$text")
        if ! options_of "$command"; then
          fail "$1" "$text"
        elif is_complete "$command"; then
          ran+=1
          run "$command" || fail "$1" "$text"
        fi
        ;;
      --[a-z]*)
        looked_up+=1
        has_option "${text%%[ =]*}" || fail "$1" "no program has ${text%%[ =]*}"
        ;;
    esac
  done < <(code "$source/$1")
  ((failed == 0)) || return 1
  echo "$1: $ran commands ran, $looked_up options exist"
}

rm -rf "$work"
mkdir -p "$work"
cd "$work"
cp -r "$source/docs" docs  # for its paths; pictures of it are drawn again
cat > room.obj << 'END'
v -12 -12 0
v 12 -12 0
v 12 12 0
v -12 12 0
v -12 -12 4
v 12 -12 4
v 12 12 4
v -12 12 4
f 1 2 3 4
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
END
printf '%s\n' '1 2 1' '8 3 1' > tour.path
roam make gallery -o gallery.ply --triangles 50k > made.log
roam build room.obj > made.log 2>&1

if (($# > 0)); then
  failed=0
  for document in "$@"; do check "$document" || failed=1; done
  exit "$failed"
fi

# planted LINE... EXPECTED: a document of these lines must fail, and say EXPECTED.
planted() {
  local said
  printf '%s\n' "${@:1:$#-1}" > "$work/source/planted.md"
  if said=$(source=$work/source check planted.md); then echo "not found: $*"; exit 1; fi
  [[ $said == *"${!#}"* ]] || { echo "$said"; echo "expected: ${!#}"; exit 1; }
}
mkdir -p source/tests
touch source/tests/CMakeLists.txt
planted '```sh' 'roam walk nowhere.ply --path tour.path' '```' 'there is no such file'
planted '' '    roam walk room.obj --path nowhere.path' 'exit status 1'
planted 'It is `roam walk room.obj' '--path nowhere.path`.' 'exit status 1'
planted '`roam walk --nowhere`' 'roam walk has no --nowhere'
planted '`--nowhere 3`' 'no program has --nowhere'
planted '`roam info room.obj | grep nowhere`' 'exit status 1'
planted '' '    ctest -R nowhere' 'no test nowhere'
printf '%s\n' '`roam info room.obj`, `roam walk --path`, `--radius 3`' > source/planted.md
[[ $(source=$work/source check planted.md) == *'1 commands ran, 1 options exist' ]] || { echo 'not run'; exit 1; }
