#!/usr/bin/env bash
# Whether the documents hold together: links and mentions resolve, lines are short, and there are not too many words.
#   documents.sh SOURCE          fails for each fault in SOURCE
#   documents.sh SOURCE FAULTS   plants faults into small documents and fails where they are not found
#
# Checked are README.md, SECURITY.md, CONTRIBUTING.md, CHANGELOG.md and docs/**/*.md:
#   - a relative link leads to a file or folder, and its #anchor to a heading, by GitHub's rules for anchors;
#   - docs/NAME.md in code, tests and CMake files exists, and so does the heading in: docs/NAME.md, "Heading";
#   - a test that a document names, `Suite.Test` or `Suite.*`, exists;
#   - README.md and docs have at most 34,000 words together, docs/guarantees.md 1,500;
#   - a line has at most 120 columns, without the targets of its links, unless it is code or a table.
set -euo pipefail
export LC_ALL=C  # awk counts bytes then, whichever awk it is
most_words=34000 most_promises=1500

# documents: their names, one a line.
documents() {
  for file in README.md SECURITY.md CONTRIBUTING.md CHANGELOG.md; do [[ ! -e $file ]] || echo "$file"; done
  find docs -name '*.md' | sort
}

# scan FILE...: lines `heading FILE ANCHOR`, `link FILE LINE TARGET` and `long FILE LINE COLUMNS`.
scan() {
  awk '
    FNR == 1 { fenced = 0; blank = 1; indented = 0 }
    /^ *```/ { fenced = !fenced; next }
    fenced { next }
    # Four blanks after an empty line begin code, but in a list they go on with its item.
    { if ($0 !~ /^    / || !(blank || indented) || listed) indented = 0; else indented = 1 }
    /^[^ ]/ { listed = /^([-*]|[0-9]+\.) / }
    { blank = /^ *$/ }
    indented { next }
    {
      text = $0
      gsub(/`[^`]*`/, "", text)
      rest = text
      while (match(rest, /\]\([^) ]+/)) {
        print "link", FILENAME, FNR, substr(rest, RSTART + 2, RLENGTH - 2)
        rest = substr(rest, RSTART + RLENGTH)
      }
      rest = text
      while (match(rest, /(src|href)="[^"]+"/)) {
        target = substr(rest, RSTART, RLENGTH)
        gsub(/^[a-z]+="|"$/, "", target)
        print "link", FILENAME, FNR, target
        rest = substr(rest, RSTART + RLENGTH)
      }
      if (match(text, /^\[[^]]+\]: */)) {
        split(substr(text, RLENGTH + 1), word, " ")
        print "link", FILENAME, FNR, word[1]
      }
    }
    /^#+ / {
      anchor = tolower($0)
      sub(/^#+ +/, "", anchor)
      sub(/ +#* *$/, "", anchor)
      while (match(anchor, /\]\([^)]*\)/)) anchor = substr(anchor, 1, RSTART - 1) substr(anchor, RSTART + RLENGTH)
      gsub(/[^a-z0-9 _\200-\377-]/, "", anchor)
      # Dashes, quotes, arrows and signs beyond ASCII: no letters.
      gsub(/\342[\200-\217][\200-\277]|\302[\240-\277]|\303[\227\267]/, "", anchor)
      gsub(/ /, "-", anchor)
      again = seen[FILENAME, anchor]++
      print "heading", FILENAME, again ? anchor "-" again : anchor
    }
    !/^ *\|/ {
      text = $0
      gsub(/\]\([^)]*\)/, "]", text)
      gsub(/<?https?:[^ )>]*>?/, "", text)
      gsub(/[\200-\277]/, "", text)  # of a letter of several bytes only the first is counted
      if (length(text) > 120) print "long", FILENAME, FNR, length(text)
    }' "$@"
}

# normal PATH: without `.` and `..`.
normal() { realpath --canonicalize-missing --no-symlinks --relative-to=. -- "$1"; }

check() {
  cd "$1"
  local failed=0 links=0 mentions=0 tests=0 kind file line target path anchor
  fail() { echo "$1"; failed=1; }
  declare -A headings=()
  local -a names
  mapfile -t names < <(documents)
  local scanned
  scanned=$(scan "${names[@]}")
  while read -r kind file anchor; do
    [[ $kind != heading ]] || headings["$file#$anchor"]=1
  done <<< "$scanned"

  while read -r kind file line target; do
    if [[ $kind == long ]]; then
      fail "$file:$line has $target columns, more than 120"
    elif [[ $kind == link && ! $target =~ ^[a-z]+: ]]; then
      links=$((links + 1))
      path=${target%%#*} anchor=
      [[ $target != *"#"* ]] || anchor=${target#*#}
      if [[ -z $path ]]; then path=$file; else path=$(normal "$(dirname "$file")/$path"); fi
      if [[ ! -e $path ]]; then
        fail "$file:$line links to $target: there is no $path"
      elif [[ -n $anchor && -z ${headings["$path#$anchor"]:-} ]]; then
        fail "$file:$line links to $target: $path has no such heading"
      fi
    fi
  done <<< "$scanned"

  # FILE:LINE:docs/NAME.md, with its heading where it is named.
  while IFS=: read -r file line target; do
    mentions=$((mentions + 1))
    path=${target%%,*}
    if [[ ! -e $path ]]; then
      fail "$file:$line mentions $path, which is not there"
    elif [[ $target == *'"'* ]]; then
      anchor=${target#*\"}
      grep -qiE "^#+ (\*\*)?$(sed 's/[][\\.*^$()+?{}|/]/\\&/g' <<< "${anchor%\"}")" "$path" ||
        grep -qF "**${anchor%\"}" "$path" || fail "$file:$line mentions $target: there is no such heading"
    fi
  done < <(find apps bench baseline cmake examples include src tests CMakeLists.txt check demo -type f \
    ! -name documents.sh -exec grep -noHE 'docs/[A-Za-z0-9_/-]+\.md(, "[^"]+")?' {} + 2> /dev/null)

  # Tests, as GoogleTest names them.
  while IFS=: read -r file line target; do
    target=${target//\`/}
    tests=$((tests + 1))
    grep -qrE "^TEST(_F|_P)?\(${target%.*}, *$(sed 's/^\*$/[A-Za-z]*/' <<< "${target##*.}")\)" tests 2> /dev/null ||
      fail "$file:$line names $target, and there is no such test"
  done < <(grep -noHE '`[A-Z][A-Za-z]+\.([A-Z][A-Za-z]+|\*)`' "${names[@]}")

  local words promises
  words=$(find README.md docs -name '*.md' -exec cat {} + | wc -w)
  ((words <= most_words)) || fail "README.md and docs have $words words, more than $most_words"
  if [[ -e docs/guarantees.md ]]; then
    promises=$(wc -w < docs/guarantees.md)
    ((promises <= most_promises)) || fail "docs/guarantees.md has $promises words, more than $most_promises"
  fi
  ((failed == 0)) || return 1
  echo "${#names[@]} documents: $links links, $mentions mentions, $tests tests, $words words"
}

if (($# == 1)); then
  check "$1"
  exit
fi

[[ $2 == FAULTS ]] || { echo "$2: the second argument is FAULTS or left out" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/tree/docs/deep" "$work/tree/src" "$work/tree/tests"
cd "$work/tree"
cat > README.md << 'END'
# A house

[Rooms](docs/rooms.md#the-room-s-own-door), [twice](docs/rooms.md#again-1), [source](src), [here](#a-house),
[there](https://example.org/nowhere.md), ![picture](docs/picture.svg), `[code](nowhere.md)`.

    [code](nowhere.md)

```
[code](nowhere.md) and a line of code that is too long for people who have only a hundred and twenty columns to read it in
```

| [table](docs/rooms.md) | a row of a table that is too long for people who have only a hundred and twenty columns to read |
END
cat > docs/rooms.md << 'END'
# Rooms

## The `room`-s – own *door*

## Again

## Again

- [up](../README.md), [down](deep/cellar.md)
END
sed -i 's/ – / /' docs/rooms.md
echo '# Cellar' > docs/deep/cellar.md
echo '# Guarantees' > docs/guarantees.md
echo '// See docs/rooms.md, "Again", and docs/deep/cellar.md.' > src/house.h
echo 'TEST_F(House, Stands) {' > tests/house.cpp
echo '`House.Stands`, `House.*`, `House.h`' >> docs/deep/cellar.md
touch docs/picture.svg

# planted FILE LINE EXPECTED: the same with one line more must fail, and say EXPECTED.
planted() {
  local said
  cp "$1" "$work/kept"
  echo "$2" >> "$1"
  if said=$(check .); then echo "not found: $2"; exit 1; fi
  [[ $said == *"$3"* ]] || { echo "$said"; echo "expected: $3"; exit 1; }
  [[ $(wc -l <<< "$said") == 1 ]] || { echo "$said"; echo "expected nothing but: $3"; exit 1; }
  cp "$work/kept" "$1"
}
check .
planted README.md '[gone](docs/gone.md)' 'README.md:13 links to docs/gone.md: there is no docs/gone.md'
planted README.md '[gone](docs/rooms.md#gone)' 'docs/rooms.md has no such heading'
planted README.md '[gone](docs/rooms.md#again-2)' 'docs/rooms.md has no such heading'
planted README.md '[gone](#gone)' 'README.md has no such heading'
planted README.md '![gone](docs/gone.svg)' 'there is no docs/gone.svg'
planted README.md '<img src="docs/gone.png">' 'there is no docs/gone.png'
planted README.md '[gone]: docs/gone.md' 'there is no docs/gone.md'
planted docs/rooms.md '[gone](README.md)' 'there is no docs/README.md'
planted docs/deep/cellar.md '[gone](rooms.md)' 'there is no docs/deep/rooms.md'
planted src/house.h '// docs/gone.md' 'src/house.h:2 mentions docs/gone.md, which is not there'
planted src/house.h '// docs/rooms.md, "Gone"' 'there is no such heading'
planted docs/rooms.md '`House.Burns`' 'docs/rooms.md:10 names House.Burns, and there is no such test'
planted docs/rooms.md '`Hous.*`' 'there is no such test'
planted README.md "$(printf 'x%.0s' {1..121})" 'README.md:13 has 121 columns'
planted docs/deep/cellar.md "$(yes word | head -$most_words)" "more than $most_words"
planted docs/guarantees.md "$(yes word | head -$((most_promises - 1)))" "1501 words, more than $most_promises"
# As long as a line may be, with letters of two bytes and a link.
echo "$(printf 'ü%.0s' {1..114}) [up](../README.md)" >> docs/rooms.md
check .
