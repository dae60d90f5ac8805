#!/usr/bin/env bash
# Copyright (c) 2026, the coarse_map_nav authors
# SPDX-License-Identifier: BSD-3-Clause
# cmn_recorded_runs on a log that is made here: a robot that drives to and fro in a room of 10 m x 6 m.
# And it answers bad input. usage: recorded_runs_test.bash BUILD_DIR
set -euo pipefail
program=$1/devel/lib/coarse_map_nav/cmn_recorded_runs
config=$(cd "$(dirname "${BASH_SOURCE[0]}")/../config" && pwd)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

wrong() { echo "FAIL  $*" >&2 && exit 1; }

mkdir "$out/worlds"
awk 'BEGIN {
  print "P2 104 64 255"
  for (y = 0; y < 64; ++y) for (x = 0; x < 104; ++x)
    print (x < 2 || x > 101 || y < 2 || y > 61 || (x > 30 && x < 40 && y > 40)) ? 0 : 254
}' >"$out/worlds/room.pgm"
printf 'image: room.pgm\nresolution: 0.1\norigin: [-0.2, -0.2, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n' \
  >"$out/worlds/room.yaml"
echo 'room: {yaw_deg: 0, x: 0, y: 0}' >"$out/worlds/log_to_world.yaml"
# 12 m: along x at y = 3, turning round at the ends.
awk 'BEGIN {
  pi = atan2(0, -1); x = 2; way = 1
  for (i = 0; i < 120; ++i) {
    yaw = way > 0 ? 0 : pi
    line = "FLASER 181"
    for (b = -90; b <= 90; ++b) {
      a = yaw + b * pi / 180; c = cos(a); s = sin(a)
      r = 99
      if (c > 1e-9 && (10 - x) / c < r) r = (10 - x) / c
      if (c < -1e-9 && -x / c < r) r = -x / c
      if (s > 1e-9 && 3 / s < r) r = 3 / s
      if (s < -1e-9 && -3 / s < r) r = -3 / s
      line = line sprintf(" %.3f", r)
    }
    printf "%s %.3f 3 %.5f %.3f 3 %.5f %.1f host %.1f\n", line, x, yaw, x, yaw, 0.5 * i, 0.5 * i
    x += 0.1 * way
    if (x > 8 || x < 2) way = -way
  }
}' >"$out/room.log"
run() {
  "$program" "$out/room.log" --worlds "$out/worlds" --preset "$config/navigator.yaml" --find "${find_m:-3}" \
    --hold 2 --runs 4 "$@"
}

run --preset "$config/rolling.yaml" --out "$out/one" >"$out/one.txt"
[[ $(grep -cE '^RESULT building=room method="(navigator|rolling)" found=[01]\.[0-9]{3} low=[01]\.[0-9]{3} high=[01]\.[0-9]{3} runs=4$' \
  "$out/one.txt") == 2 ]] || wrong "RESULT lines: $(cat "$out/one.txt")"
[[ $(wc -l <"$out/one/runs.csv") == 9 ]] || wrong "not 8 runs and a header"
grep -q '</svg>' "$out/one/error.svg" || wrong "no plot"
grep -q '^| room | 4 |' "$out/one/table.md" || wrong "no table"

run --preset "$config/rolling.yaml" --jobs 2 --out "$out/two" >/dev/null
diff "$out/one/runs.csv" "$out/two/runs.csv" >&2 || wrong "two threads give another result"

run --set localization/scaled/headings=12 --turn 30 --out "$out/askew" >"$out/askew.txt"
grep -q 'method="navigator, headings 12"' "$out/askew.txt" || wrong "the setting is not in the name"

answers() { # words that must be in the message, then the options
  local words=$1
  shift
  if run --out "$out/bad" "$@" >/dev/null 2>"$out/bad.txt"; then
    wrong "$* was accepted"
  fi
  grep -qF -- "$words" "$out/bad.txt" || wrong "$*: $(cat "$out/bad.txt")"
}
answers 'headings: 6 is none of the multiples of 4' --set localization/scaled/headings=6
answers 'expected path=value' --set headings
find_m=900 answers 'a run needs'
find_m=-1 answers '--find is not above 0'
answers '--runs and --jobs are at least 1' --jobs 0
answers 'expected off or name=number' --noise slip
answers 'cannot be made coarser' --mpp 0.01
if "$program" "$out/none.log" --worlds "$out/worlds" --preset "$config/navigator.yaml" --out "$out/bad" 2>"$out/bad.txt"; then
  wrong "a log that is not there was accepted"
fi
grep -q none.log "$out/bad.txt" || wrong "the missing log is not named: $(cat "$out/bad.txt")"
cp "$out/room.log" "$out/hall.log"
if "$program" "$out/hall.log" --worlds "$out/worlds" --preset "$config/navigator.yaml" --out "$out/bad" 2>"$out/bad.txt"; then
  wrong "a building without a world was accepted"
fi
grep -q 'no building "hall"' "$out/bad.txt" || wrong "the building is not named: $(cat "$out/bad.txt")"
echo "all well"
