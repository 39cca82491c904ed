#!/usr/bin/env bash
# The command line's contract: exit codes, one sentence for bad input, nothing half-written, the files that are promised.
# Usage: command_line_test.sh SHADEWRIGHT
set -uo pipefail
shadewright=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failures=0

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# refuses CODE 'PATTERN' ARGS...: exits with CODE, says one line on stderr that has PATTERN, and leaves no file.
refuses() {
  local code=$1 pattern=$2
  shift 2
  "$shadewright" "$@" >stdout 2>stderr
  local got=$?
  [ $got -eq "$code" ] || fail "$*: exit $got instead of $code"
  [ "$(wc -l <stderr)" -eq 1 ] || fail "$*: $(wc -l <stderr) lines on stderr: $(cat stderr)"
  grep -q -- "$pattern" stderr || fail "$*: no '$pattern' in: $(cat stderr)"
  rm -f stdout stderr
  [ -z "$(ls -A)" ] || { fail "$*: left $(ls -A)"; rm -rf ./*; }
}

works() { "$shadewright" "$@" >stdout 2>stderr || { fail "$*: exit $?: $(cat stderr)"; return 1; }; }

small=(--size 160x90 --repeat 1 --quiet)

refuses 2 'no technique' render builtin:spheres -t smm -o x.png "${small[@]}"
refuses 2 'no such file' render missing.glb -t sm -o x.png "${small[@]}"
refuses 2 'builtin' render builtin:nowhere -t sm -o x.png "${small[@]}"
refuses 2 'size' render builtin:spheres -t sm -o x.png --size 12 --quiet
refuses 2 'size' render builtin:spheres -t sm -o x.png --size 0x10 --quiet
refuses 2 'points' render builtin:spheres -t sm -o x.png --points many "${small[@]}"
refuses 2 'points' render builtin:spheres -t sm -o x.png --points 0 "${small[@]}"
refuses 2 'points' compare builtin:spheres -t sm -o out --against-triangles "${small[@]}"
refuses 2 '.png' render builtin:spheres -t sm -o x.jpg "${small[@]}"
refuses 2 'camera' render builtin:spheres -t sm -o x.png --camera nobody "${small[@]}"
refuses 2 'light' render builtin:spheres -t sm -o x.png --light nobody "${small[@]}"
refuses 2 '1 to 8' render builtin:spheres -t csm,cascades=0 -o x.png "${small[@]}"
refuses 2 'averages beforehand' render builtin:spheres -t vsm,radius=2 -o x.png "${small[@]}"
refuses 2 'X,Y,Z' render builtin:spheres -t sm -o x.png --eye 1,2 --target 0,0,0 "${small[@]}"
refuses 2 'both' render builtin:spheres -t sm -o x.png --eye 1,2,3 "${small[@]}"
refuses 2 'AZIMUTH' render builtin:spheres -t sm -o x.png --sun high "${small[@]}"
refuses 2 'device' render builtin:spheres -t sm -o x.png --device nosuch "${small[@]}"
refuses 2 'debug' render builtin:spheres -t sm -o x.png --debug nosuch "${small[@]}"
refuses 2 'camera path' compare builtin:spheres -t sm -o out --path main "${small[@]}"
refuses 2 'main' compare builtin:street -t sm -o out --path nosuch "${small[@]}"
refuses 2 'leave one of them out' render builtin:street -t sm -o x.png --path main --camera overview "${small[@]}"
refuses 2 'nothing moves' compare builtin:spheres -t sm -o out --frames 3 "${small[@]}"
refuses 2 'frames' compare builtin:street -t sm -o out --path main --frames 0 "${small[@]}"
refuses 2 'not a sun' compare builtin:chess -t sm -o out --sun-to 10,20 "${small[@]}"
refuses 2 'only one frame' compare builtin:spheres -t sm -o out --every-frame "${small[@]}"
refuses 2 'several images' render builtin:street -t sm -o - --path main --frames 2 "${small[@]}"
refuses 2 'report.json' compare builtin:spheres -t sm -o out --against missing.json "${small[@]}"
refuses 2 'downwards' compare builtin:spheres -t sm@1024..512 -o out "${small[@]}"
refuses 2 'leave tessellation out' render builtin:spheres -t rectilinear/moments/hard,tessellation=off -o x.png "${small[@]}"
refuses 2 'analysis_scale=1' render builtin:spheres -t rmsm,analysis_scale=2,uniquify=none -o x.png "${small[@]}"
refuses 2 'one of auto, none' render builtin:spheres -t rmsm,uniquify=some -o x.png "${small[@]}"
refuses 2 'SCENE' view
refuses 2 'at most two' view builtin:spheres -t sm -t psm -t ray
refuses 2 'no technique' view builtin:spheres -t smm
refuses 2 'shadewright render --help' render
refuses 2 "'nonsense' is not a verb; see shadewright --help" nonsense
refuses 2 'no verb is given; see shadewright --help'
refuses 2 "'--nonsense' is not a verb" --nonsense
refuses 2 "folder 'no/such/folder' does not exist" render builtin:spheres -t sm -o no/such/folder/x.png "${small[@]}"
refuses 2 'does not exist' render builtin:spheres -t sm -o x.png --mask no/x.png "${small[@]}"
refuses 2 'does not exist' bake builtin:spheres -r 64 -o x.cpvs --json no/x.json --quiet
refuses 2 'does not exist' scenes spheres -o no/x.glb
refuses 2 'goes there too' render builtin:spheres -t sm -o x.png --mask ./x.png "${small[@]}"
refuses 2 'goes there too' render builtin:spheres -t sm -o - --json - "${small[@]}"
refuses 2 'from 1 to 160' render builtin:spheres -t sm -o x.png --fov nan "${small[@]}"
refuses 2 'from 1 to 160' compare builtin:spheres -t sm -o out --fov 0 "${small[@]}"
refuses 2 'memory' bake builtin:spheres -r 64 -o x.cpvs --memory nan --quiet
refuses 2 'leave one of them out' compare builtin:street -t sm -o out --path main --target 1,2,3 "${small[@]}"
refuses 2 'debug' render builtin:spheres -t ray -o x.png --debug shadow-map "${small[@]}"
refuses 2 'debug' compare builtin:spheres -t sm -t ray -o out --debug cascades "${small[@]}"
refuses 2 'missing.cpvs' compare builtin:spheres -t sm@256 -t cpvs,file=missing.cpvs -o out "${small[@]}"
refuses 2 "'asm' sets" render builtin:spheres -t asm,refine=none -o x.png "${small[@]}"

# Standard output that is full.
for arguments in "--help" "scenes" "render builtin:spheres -t sm@256 --size 16x16 --quiet -o -"; do
  "$shadewright" $arguments >/dev/full 2>stderr
  [ $? -eq 1 ] && grep -q 'standard output' stderr || fail "$arguments to a full disk: exit $? $(cat stderr)"
done
rm -f stderr

works devices && grep -q '^\*' stdout || fail "devices marks none"
works scenes && grep -q sandbox stdout || fail "scenes lists no sandbox"
works scenes spheres -o spheres.glb
works render spheres.glb -t sm@512 -o file.png --mask mask.png --json figures.json --debug shadow-map "${small[@]}"
for file in file.png mask.png figures.json file-shadow-map.png; do [ -s "$file" ] || fail "render wrote no $file"; done
works render builtin:spheres -t sm@512 -o builtin.png --mask builtin-mask.png "${small[@]}"
cmp -s mask.png builtin-mask.png || fail "a scene written out and loaded back has another mask"
works render builtin:spheres -t pcf -o image.exr "${small[@]}" && [ -s image.exr ] || fail "no EXR"
works render builtin:spheres -t ray -o ray.png "${small[@]}"
works render builtin:spheres -t sm@256 -o - "${small[@]}" && head -c 4 stdout | grep -q PNG || fail "no PNG on stdout"
works render builtin:spheres -t sm@256 -o points.png --points auto --size 160x90 && grep -q 'drawn as' stderr ||
  fail "points are drawn without a word"
works compare builtin:spheres -t sm@256 -o points --points auto --against-triangles --size 160x90 --repeat 0 &&
  grep -q 'Against triangles' points/report.json || fail "what points cost is not told"
works render builtin:city -t csm@256,splits=sdsm,stable=1 -o csm.png --debug cascades --debug shadow-map "${small[@]}"
[ -s csm-cascades.png ] && [ -s csm-shadow-map.png ] || fail "no debug picture of the cascades"
works render builtin:city -t asm@4096,uniquify=compact,analysis=cpu,draw=superpages -o pages.png --debug pages --debug page-use "${small[@]}"
[ -s pages-pages.png ] && [ -s pages-page-use.png ] || fail "no debug picture of the pages"
works compare builtin:chess -t cascaded@256,cascades=8 -t vsm@256,blur=2,bleeding=0.2 -t cascaded/moments/hard@256 -o three \
  --size 160x90 --repeat 1 --validation
works render --help-spec
works render builtin:spheres -t sm -o x.png --debug list && grep -q shadow-map stdout || fail "--debug list names no shadow-map"
works compare builtin:spheres -t sm@256..512 -t pcf@256 -o out --size 160x90 --repeat 1 --validation
for file in index.html report.json report.csv reference.png; do [ -s "out/$file" ] || fail "compare wrote no $file"; done
grep -q '"schema": "shadewright.compare/1"' out/report.json || fail "report.json has no schema"
[ "$(grep -c '"technique"' out/report.json)" -eq 3 ] || fail "the sweep has not three results"
cp out/report.json out/reference.png .
"$shadewright" compare builtin:spheres -t sm@256 -t cpvs,file=missing.cpvs -o out "${small[@]}" 2>stderr
[ $? -eq 2 ] && cmp -s report.json out/report.json && cmp -s reference.png out/reference.png && [ ! -e out/out.part ] ||
  fail "a comparison that was refused changed an earlier one"
"$shadewright" compare builtin:spheres -t sm@256 -o report.json "${small[@]}" 2>stderr
[ $? -eq 2 ] && grep -q 'folder' stderr || fail "a file as a folder: $(cat stderr)"
timeout --preserve-status -s INT 2 "$shadewright" compare builtin:landscape -t sm@256 -t cpvs@131072 -o stopped --size 160x90 \
  --repeat 1 --quiet >stdout 2>stderr
[ $? -eq 130 ] && grep -q 'nothing was written' stderr || fail "an interrupted comparison says: $(cat stderr)"
[ -z "$(ls | grep stopped)" ] || fail "an interrupted comparison left $(ls | grep stopped)"
works compare -t sm@256 builtin:spheres -t csm@256 -t ray -o debug --debug cascades --debug shadow-map "${small[@]}"
[ -s debug/csm-256-cascades.png ] && [ -s debug/sm-256-shadow-map.png ] && [ ! -e debug/sm-256-cascades.png ] ||
  fail "compare --debug wrote $(ls debug)"
grep -q '"csm-256-cascades.png"' debug/report.json && [ "$(grep -c '"debug"' debug/report.json)" -eq 2 ] ||
  fail "report.json does not name the debug images"
works compare builtin:street --frames 2 -t csm@256 -o debug-path --debug cascades "${small[@]}"
[ -s debug-path/csm-256-cascades.png ] || fail "no debug image along a path"
works compare builtin:spheres -t sm -t ray -o x --debug list && grep -q '^sm: .*shadow-map' stdout ||
  fail "compare --debug list: $(cat stdout)"
works render builtin:spheres -t ray -o x.png --debug list && [ ! -s stdout ] || fail "ray has debug images: $(cat stdout)"
printf 'v -5 0 -5\nv 5 0 -5\nv 5 0 5\nv -5 0 5\nf 4 3 2 1\n' >floor.obj
works compare floor.obj -t sm@256 -o dark --sun 0,-60 --eye 0,9,0 --target 0,0,0.1 --size 32x32 --repeat 0 &&
  grep -q 'nothing was compared' stderr && grep -q 'nothing was compared' dark/report.json || fail "nothing to compare, not a word"
works compare builtin:spheres -t sm@512 -o again --against out/report.json --size 160x90 --repeat 1
grep -q 'against' stdout || fail "compare --against says nothing"
grep -qE '(src|href|url)[=(]"?https?:' out/index.html && fail "index.html refers to the network"

works compare builtin:street --path main --frames 3 -t sm@256 -t ray -o path --every-frame --size 160x90 --validation
grep -q 'flicker' stdout || fail "compare along a path tells no flicker"
for file in report.json sm-256.png sm-256-frames/0002.png reference-frames/0000.png; do
  [ -s "path/$file" ] || fail "compare along a path wrote no $file"
done
grep -q '"frames": 3' path/report.json && ! grep -q '"flicker": null' path/report.json || fail "report.json tells no flicker"
works render builtin:street --frames 2 -t sm@256 -o frame.png --mask frame-mask.png --json frame.json "${small[@]}"
for file in frame_0000.png frame_0001.png frame-mask_0001.png frame.json; do [ -s "$file" ] || fail "render wrote no $file"; done
cmp -s frame-mask_0000.png frame-mask_0001.png && fail "the street's animation does not run"
works compare builtin:spheres --sun 35,45 --sun-to 60,30 --frames 2 -t sm@256 -o turning "${small[@]}"
grep -q '"light_moves": true' turning/report.json || fail "--sun-to does not move the light"

works bake builtin:spheres -r 512 -o sun.cpvs --json bake.json --quiet
[ -s sun.cpvs ] && grep -q '"dag_bytes"' bake.json || fail "bake wrote no file or no figures"
works bake builtin:spheres -r 512 -o again.cpvs --threads 1 --quiet
cmp -s sun.cpvs again.cpvs || fail "another number of threads bakes other bytes"
works info sun.cpvs && grep -q '512x512x512' stdout || fail "info does not tell the resolution"
printf '0 100 0\n0 100 0 0 1 0\n' | "$shadewright" query sun.cpvs --filter 9 >answers 2>stderr || fail "query: $(cat stderr)"
[ "$(cat answers)" = "$(printf '1\n1')" ] || fail "points above everything are not lit: $(cat answers)"
coproc talk { "$shadewright" query sun.cpvs 2>talk-errors; }
talker=$talk_PID
for i in 1 2; do
  echo '0 100 0' >&"${talk[1]}"
  read -r -t 20 answer <&"${talk[0]}" && [ "$answer" = 1 ] || fail "query does not answer line by line: $answer"
done
exec {talk[1]}>&-
wait "$talker" || fail "query: $(cat talk-errors)"
seq 200000 | sed 's/.*/0 100 0/' | "$shadewright" query sun.cpvs | sort | uniq -c | grep -q '^ *200000 1$' ||
  fail "query loses lines"
"$shadewright" query sun.cpvs <<<'0 100 0' >/dev/full 2>stderr
[ $? -eq 1 ] && grep -q 'standard output' stderr || fail "query to a full disk: $(cat stderr)"
printf '0 100 0\n1 2\n' >points.txt
"$shadewright" query sun.cpvs <points.txt >answers 2>stderr
[ $? -eq 2 ] && grep -q 'line 2' stderr || fail "query does not name the bad line: $(cat stderr)"
[ ! -s answers ] || fail "lines that wait together are not answered together"
cat >far.obj <<'END'
v 4499950 0 499950
v 4500050 0 499950
v 4500050 0 500050
v 4499950 0 500050
v 4499990 10 499990
v 4500010 10 499990
v 4500010 10 500010
v 4499990 10 500010
f 4 3 2 1
f 8 7 6 5
END
works bake far.obj -r 2048 --sun 0,90 -o far.cpvs --quiet
printf '%s 0 500000.1 0 1 0\n' 4500009.7 4500010.3 4499989.7 4499990.3 | "$shadewright" query far.cpvs >answers 2>stderr
[ "$(tr '\n' ' ' <answers)" = "0 1 1 0 " ] || fail "points far from zero: $(cat answers stderr)"
works compare far.obj -t sm@256 -o far --sun 20,50 "${small[@]}"
eye=$(tr -d ' \n' <far/report.json | sed 's/.*"eye":\[\([^]]*\)\],"target":\[\([^]]*\)\].*/\1/')
target=$(tr -d ' \n' <far/report.json | sed 's/.*"eye":\[\([^]]*\)\],"target":\[\([^]]*\)\].*/\2/')
case $eye in 4[45]*) ;; *) fail "report.json's eye is not in the file's coordinates: $eye" ;; esac
works compare far.obj -t sm@256 -o far-again --sun 20,50 --eye "$eye" --target "$target" "${small[@]}"
cmp -s far/reference-mask.png far-again/reference-mask.png || fail "report.json's camera, typed back, sees something else"
works bake builtin:spheres -r 64 -o x.cpvs --verbose && grep -q ' s  ' stderr || fail "bake --verbose tells no stages"
head -c 1000 sun.cpvs >cut.cpvs
"$shadewright" info cut.cpvs >stdout 2>stderr
[ $? -eq 2 ] && grep -q 'cut.cpvs' stderr || fail "info of a truncated file: $(cat stderr)"
timeout --preserve-status -s INT 1 "$shadewright" bake builtin:landscape -r 262144 -o stopped.cpvs --quiet >stdout 2>stderr
[ $? -eq 130 ] && grep -q 'interrupted' stderr || fail "an interrupted bake says: $(cat stderr)"
[ -z "$(ls | grep stopped)" ] || fail "an interrupted bake left $(ls | grep stopped)"

[ $failures -eq 0 ] && echo "all passed"
exit $((failures > 0))
