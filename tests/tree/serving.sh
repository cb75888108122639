#!/usr/bin/env bash
# Whether docs/serving.md leads from a scene to a served store: runs its commands with a real nginx.
#   serving.sh SOURCE WORK ROAM
# Then: who reads while versions are published gets one of them, whole; a walk over the web takes no more memory than
# promised and loads libcurl alone; caches, CORS, and files that are not served. Status 77 if nginx is not here.
set -euo pipefail
source=$1 work=$2 roam=$3
source "$source/tests/support/nginx.sh"
if ! PATH=$PATH:/usr/sbin command -v nginx > /dev/null; then
  echo "skipped: nginx is not here (Debian: nginx-light)"
  exit 77
fi
rm -rf "$work"
mkdir -p "$work"
work=$(realpath "$work")
cd "$work"
export XDG_DATA_HOME=$work/home XDG_CACHE_HOME=$work/cache
unset http_proxy all_proxy
ulimit -c 0
fail() { echo "$1"; exit 1; }

"$roam" make gallery -o gallery.ply --triangles 300k > /dev/null
cp gallery-straight.path tour.path
trap stop_nginx EXIT
if openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj /CN=127.0.0.1 \
  -addext subjectAltName=IP:127.0.0.1 -keyout key -out authority 2> /dev/null; then
  certificate=$work/certificate
  cat key authority > "$certificate"
fi
# The document's commands, each with what stands for it here.
commands=$(awk '/^```sh$/ { inside = 1; next } /^```/ { inside = 0 } inside' "$source/docs/serving.md")
[[ $(grep -c '^roam' <<< "$commands") -ge 7 ]] || fail "docs/serving.md was not understood"
while read -r command; do
  command=${command//Data\//gallery.ply}
  command=${command//http:\/\/localhost:8080\/dam.roam/${web:-}}
  case $command in
    "nginx -s reload")
      start_nginx "$work/nginx" "$work/dam.conf" "${certificate:-}" || fail "nginx does not start"
      web=http://127.0.0.1:$port/dam.roam
      continue
      ;;
    roam\ *) command="'$roam' ${command#roam }" ;;
  esac
  echo "\$ $command"
  bash -c "$command" > said 2>&1 < /dev/null || { cat said nginx/errors; fail "it failed"; }
  [[ ! $command =~ \ (info|walk|verify)\  ]] || tail -3 said
done <<< "$commands"

# The walk is that on the disk.
walk() { "$roam" walk "$@" --path tour.path --mode fly --speed 10 --verify --json; }
figures() { grep -E '"(outcome|length_m|violations|hash)"' "$1"; }
walk dam.roam > disk.json
walk "$web" > web.json
diff <(figures disk.json) <(figures web.json)

# By HTTPS and HTTP/2.
if [[ ${certificate:-} ]]; then
  CURL_CA_BUNDLE=$work/authority walk "https://127.0.0.1:$((port + 1))/dam.roam" > secure.json
  diff <(figures disk.json) <(figures secure.json)
  grep -q 'packs/.* HTTP/2.0" 206' nginx/requests || fail "no HTTP/2"
else
  echo "without HTTPS: there is no openssl"
fi

# What the location serves, and how.
curl() { env -i PATH="$PATH" curl --silent --show-error "$@"; }
if command -v curl > /dev/null; then
  pack=$(basename "$(ls www/dam.roam/packs/* | head -1)")
  head=$(curl --dump-header - --output part --range 8-15 "$web/packs/$pack")
  cmp part <(dd if="www/dam.roam/packs/$pack" bs=8 skip=1 count=1 status=none)
  for line in '206 Partial' 'immutable' 'Access-Control-Allow-Origin: \*' 'Expose-Headers: Content-Range'; do
    grep -q "$line" <<< "$head" || { echo "$head"; fail "no $line"; }
  done
  curl --head "$web/CURRENT" | grep -q 'Cache-Control: no-cache' || fail "CURRENT is kept"
  curl --request OPTIONS --head "$web/CURRENT" | grep -q 'Access-Control-Allow-Headers: Range' || fail "no CORS"
  [[ $(curl --request PUT --data x --output /dev/null --write-out '%{http_code}' "$web/CURRENT") == 403 ]] || fail PUT
  echo secret > www/dam.roam/packs/secret
  ln -s /etc/passwd "www/dam.roam/packs/${pack//[0-9a-f]/a}"
  for file in LOCK packs/ packs/secret ../dam.conf spare/ "packs/${pack//[0-9a-f]/a}"; do
    [[ $(curl --path-as-is --output /dev/null --write-out '%{http_code}' "$web/$file") =~ ^4 ]] || fail "serves $file"
  done
  rm "www/dam.roam/packs/secret" "www/dam.roam/packs/${pack//[0-9a-f]/a}"
fi

# Readers while versions are published: each gets one version, whole.
"$roam" make gallery -o other.ply --triangles 200k > /dev/null
"$roam" build other.ply -o other.roam > /dev/null 2>&1
hashes=$(for store in dam.roam other.roam; do "$roam" info $store --json | grep '"hash"'; done)
(
  for ((i = 0; i < 200; ++i)); do
    ((i < 6)) || [[ ! -e seen_both ]] || break
    "$roam" publish other.roam www/dam.roam > /dev/null 2>&1
    "$roam" publish dam.roam www/dam.roam > /dev/null 2>&1
  done
) &
: > seen
while kill -0 $! 2> /dev/null; do
  found=$("$roam" info "$web" --json | grep '"hash"') || fail "a reader found no store"
  grep -qF "$found" <<< "$hashes" || fail "a reader found a mixture: $found"
  echo "$found" >> seen
  (($(wc -l < seen) < 10 || $(sort -u seen | wc -l) < 2)) || touch seen_both
done
wait $!
[[ -e seen_both ]] || fail "the readers did not see both versions: $(sort seen | uniq -c)"
"$roam" verify "$web" > /dev/null || fail "the published store is damaged"

# A cache: the second walk requests nothing but CURRENT. Its size is its limit.
walk "$web" --cache 64M > /dev/null
: > nginx/requests
walk "$web" --cache 64M > cached.json
diff <(figures disk.json) <(figures cached.json)
! grep -v /CURRENT nginx/requests || fail "requests in spite of the cache"
[[ $(stat -c %s cache/roam/web.cache) == $((64 << 20)) ]] || fail "the cache has another size"

# A query is part of every request, and of nothing that is said.
: > nginx/requests
walk "$web?Signature=Geheim" > said 2>&1
! grep -q Geheim said || fail "the query is said"
! grep -v 'Signature=Geheim HTTP' nginx/requests || fail "a request without the query"

# A truncated pack is solid and named.
pack=www/dam.roam/packs/$(ls dam.roam/packs | head -1)
truncate -s 100000 "$pack"
if "$roam" verify "$web" > said; then fail "a truncated pack is whole"; fi
grep -q 'shorter than the manifest says' said || { cat said; fail "not named"; }
"$roam" publish dam.roam www/dam.roam > /dev/null

# Memory: 8 MiB more than promised for the disk; libcurl and its libraries take some 4 MiB.
peak() { /usr/bin/python3 -c '
import resource, subprocess, sys
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=True)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss >> 10)' "$@"; }
way=(--path tour.path --mode fly --speed 10 --memory 16M)
disk=$(peak "$roam" walk dam.roam "${way[@]}") net=$(peak "$roam" walk "$web" "${way[@]}")
echo "a walk with --memory 16M takes $disk MiB from the disk, $net MiB over the web"
# A sanitizer takes memory of its own.
grep -qE '__[at]san_init' "$roam" || ((net <= 16 + 32)) || fail "too much memory"

# The libraries of a walk on the disk.
if [[ -x /usr/bin/strace ]]; then
  opens() {
    /usr/bin/strace -f -e trace=openat -o opens "$@" > /dev/null 2>&1
    grep -c 'libcurl.*= [0-9]' opens || true
  }
  (($(opens "$roam" info dam.roam) == 0)) || fail "a store on the disk loads libcurl"
  (($(opens "$roam" info "$web") > 0)) || fail "this test does not see libraries"
fi
echo "as the document says"
