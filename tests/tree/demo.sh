#!/usr/bin/env bash
# demo.sh SOURCE FOLDER PROGRAM: runs ./demo with a program that is built already.
# Every walk ends as its text announces, the page shows every picture that it names, and it replaces no other page.
set -euo pipefail
source=$1 folder=$2 program=$3
rm -rf "$folder"
mkdir -p "$folder/cmake" "$folder/build"
cp "$source/demo" "$folder"
ln -s "$program" "$folder/build/roam"
cat > "$folder/cmake/packages.sh" << 'END'
program_packages=
python_packages=
missing_of() { :; }
configure() { :; }
behind_line() { :; }
END
if ! "$folder/demo" > "$folder/log" 2>&1 < /dev/null; then
  cat "$folder/log"
  exit 1
fi
pictures=$(grep -o 'src="[^"]*"' "$folder/demo-out/index.html" | cut -d '"' -f 2)
(($(wc -w <<< "$pictures") >= 12))
for picture in $pictures; do
  [[ -s $folder/demo-out/$picture ]] || { echo "$picture is not there" && exit 1; }
done
echo 'a page of somebody' > "$folder/demo-out/index.html"
if "$folder/demo" > "$folder/log" 2>&1 < /dev/null; then echo "another page was replaced" && exit 1; fi
[[ $(< "$folder/demo-out/index.html") == 'a page of somebody' ]]
rm -rf "$folder/demo-out"
