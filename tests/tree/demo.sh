#!/usr/bin/env bash
# demo.sh SOURCE FOLDER PROGRAM: runs ./demo with a program that is built already.
# Every walk ends as its text announces, the page shows every picture that it names, and it replaces no other page. With a
# scene of one's own it takes the options of scene and body, and its last line is a command that works.
set -euo pipefail
source=$1 folder=$2 program=$3
rm -rf "$folder"
mkdir -p "$folder/cmake" "$folder/build"
cp "$source/demo" "$folder"
ln -s "$program" "$folder/build/roam"
cat > "$folder/cmake/packages.sh" << 'END'
program_packages=
python_packages=
device_packages=
missing_of() { :; }
configure() { :; }
behind_line() { :; }
END
if ! "$folder/demo" > "$folder/log" 2>&1 < /dev/null; then
  cat "$folder/log"
  exit 1
fi
pictures=$(grep -o 'src="[^"]*"' "$folder/demo-out/index.html" | cut -d '"' -f 2)
(($(wc -w <<< "$pictures") >= 13))
[[ $pictures == city-seen.png* ]] || { echo "the page begins with $pictures" && exit 1; }
for picture in $pictures; do
  [[ -s $folder/demo-out/$picture ]] || { echo "$picture is not there" && exit 1; }
done
echo 'a page of somebody' > "$folder/demo-out/index.html"
if "$folder/demo" > "$folder/log" 2>&1 < /dev/null; then echo "another page was replaced" && exit 1; fi
[[ $(< "$folder/demo-out/index.html") == 'a page of somebody' ]]
rm -rf "$folder/demo-out"

# A name with a blank, and an option that `roam info` does not take.
"$program" make gallery -o "$folder/a hall.ply" --triangles 10k > "$folder/log"
cd "$folder"
if ! ./demo 'a hall.ply' --radius 0.2 --up=z > log 2>&1 < /dev/null; then
  cat log
  exit 1
fi
[[ -s 'demo-out/a hall.png' ]]
command=$(tail -n 1 log)
[[ $command == *build/roam\ view*'a\ hall.ply'*0.2* ]]
eval "$command --headless --size 64x36 --screenshot last.png" > /dev/null
[[ -s last.png ]]
# What no verb takes is refused before the build, which this would be.
mv 'a hall.ply' hall.ply
echo 'configure() { touch built; }' >> cmake/packages.sh
for wrong in 'hall.ply --wander 5' 'hall.ply --radius' 'hall.ply --up=z missing.ply' '--up=z hall.ply'; do
  status=0
  ./demo $wrong > log 2>&1 < /dev/null || status=$?
  ((status == 1 || status == 2)) && [[ ! -e built ]] || { echo "$wrong: status $status" && cat log && exit 1; }
done
grep -q 'name the scene first' log
# An address is asked of the program, not of the disk.
./demo http://127.0.0.1:1/dam.roam --cache 64M > log 2>&1 < /dev/null && exit 1
! grep -q 'no file or folder' log || { cat log && exit 1; }
[[ -e built ]]
rm -rf demo-out
