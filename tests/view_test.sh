#!/usr/bin/env bash
# `shadewright view` on a desktop of its own without a screen: it opens, shows, obeys keys, saves, and closes, and the validation
# layer has nothing to say. Usage: view_test.sh SHADEWRIGHT
set -uo pipefail
shadewright=$(realpath "$1")
folder=$(mktemp -d)
cd "$folder"
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

unset DISPLAY WAYLAND_DISPLAY
"$shadewright" view builtin:spheres --quiet 2>stderr
[ $? -eq 1 ] && grep -q 'no desktop' stderr || fail "without a desktop: $(cat stderr)"

Xvfb -displayfd 3 -screen 0 800x600x24 -nolisten tcp 3>display 2>/dev/null &
desktop=$!
view=
trap 'kill $view $desktop 2>/dev/null; wait; rm -rf "$folder"' EXIT
for _ in $(seq 100); do [ -s display ] && break; sleep 0.1; done
[ -s display ] || { fail "Xvfb did not start"; exit 1; }
DISPLAY=:$(cat display)
export DISPLAY

"$shadewright" view builtin:spheres --light nobody 2>stderr
[ $? -eq 2 ] && grep -q 'nobody' stderr || fail "a wrong light: $(cat stderr)"

# saves N: F12 until the N-th picture is there and whole (keys before the window is ready are lost).
saves() {
  local file
  file=$(printf 'shadewright-%04d.png' "$1")
  for _ in $(seq 100); do
    [ -e "$file" ] && return
    kill -0 $view 2>/dev/null || { fail "the window is gone: $(cat stderr)"; exit 1; }
    xdotool key F12
    sleep 0.5
  done
  fail "F12 saved no $file: $(cat stderr)"
}

"$shadewright" view builtin:spheres -t sm@256 -t ray --size 320x240 --validation --quiet 2>stderr &
view=$!
saves 1
rm shadewright-*.png
sleep 1
rm -f shadewright-*.png
saves 1
xdotool keydown w
sleep 1
xdotool keyup w
sleep 1
saves 2
cmp -s shadewright-0001.png shadewright-0002.png && fail "W does not walk"
xdotool key Tab  # the controls would take the wheel
xdotool mousemove 300 200 click 5
sleep 1
saves 3
cmp -s shadewright-0002.png shadewright-0003.png && fail "the wheel does nothing"
xdotool key Escape
for _ in $(seq 100); do kill -0 $view 2>/dev/null || break; sleep 0.1; done
kill -0 $view 2>/dev/null && { fail "Escape does not close it"; exit 1; }
wait $view || fail "it ended with $?: $(cat stderr)"
[ -s stderr ] && fail "it said: $(cat stderr)"

[ $failures -eq 0 ] && echo "all passed"
exit $((failures > 0))
