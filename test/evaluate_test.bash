#!/usr/bin/env bash
# Copyright (c) 2026, the coarse_map_nav authors
# SPDX-License-Identifier: BSD-3-Clause
# An evaluation comes out the same however it is run: on one thread or two, in shards, under mpirun,
# interrupted and resumed, episode by episode. And it answers bad input. usage: evaluate_test.bash BUILD_DIR
set -euo pipefail
program=$1/devel/lib/coarse_map_nav/cmn_evaluate
worlds=$(cd "$(dirname "${BASH_SOURCE[0]}")/../worlds" && pwd)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

wrong() { echo "FAIL  $*" >&2 && exit 1; }
# All columns but step_ms, the only one that depends on the machine.
rows() { cut -d, -f1-28,30- "$out/$1/episodes.csv"; }
same_as_whole() { diff <(rows whole) <(rows "$1") >&2 || wrong "$1 differs from the whole run"; }
run() { "$program" --world "$worlds/home.yaml" "$worlds/lab.yaml" --method cmn,true_pose --episodes 2 "$@"; }

run --out "$out/whole" >"$out/whole.txt"
[[ $(rows whole | wc -l) == 9 ]] || wrong "not 8 episodes and a header: $(rows whole | wc -l) lines"
[[ $(grep -cE '^RESULT task=CL mpp=0\.40 method=(cmn|true_pose) SR=[01]\.[0-9]{3} SPL=[01]\.[0-9]{3} episodes=4$' \
  "$out/whole.txt") == 2 ]] || wrong "RESULT lines: $(cat "$out/whole.txt")"

run --out "$out/two_threads" --jobs 2 >/dev/null
same_as_whole two_threads

for i in 0 1; do
  run --out "$out/shard$i" --shard "$i/2" >/dev/null
done
"$program" merge "$out/shard0" "$out/shard1" --out "$out/merged" | diff - "$out/whole.txt" >&2 ||
  wrong "merged shards have other results"
same_as_whole merged

if command -v mpirun >/dev/null; then
  # root: in a container. shm: no network is looked for.
  # shellcheck disable=SC2016  # expanded by each process
  OUT=$out OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    mpirun --oversubscribe -n 2 sh -c 'exec "$0" "$@" \
      --shard "$OMPI_COMM_WORLD_RANK/$OMPI_COMM_WORLD_SIZE" --out "$OUT/mpi$OMPI_COMM_WORLD_RANK"' \
    "$program" --world "$worlds/home.yaml" "$worlds/lab.yaml" --method cmn,true_pose --episodes 2 >/dev/null
  "$program" merge "$out"/mpi* --out "$out/mpi" >/dev/null
  same_as_whole mpi
else
  echo "mpirun is absent (Debian: openmpi-bin): that part is left out"
fi

# A line and a half are there when the power goes.
mkdir "$out/resumed"
head -n 2 "$out/whole/episodes.csv" >"$out/resumed/episodes.csv"
printf 'CL,home,0.4,cm' >>"$out/resumed/episodes.csv"
run --out "$out/resumed" --resume >/dev/null
same_as_whole resumed

# Ctrl-C: what is under way is ended and kept.
run --out "$out/interrupted" >/dev/null 2>"$out/interrupted.txt" &
pid=$!
for _ in $(seq 200); do
  [[ -s $out/interrupted/episodes.csv && $(wc -l <"$out/interrupted/episodes.csv") -ge 2 ]] && break
  sleep 0.05
done
kill -INT "$pid"
status=0
wait "$pid" || status=$?
done_before=$(($(rows interrupted | wc -l) - 1))
# The run may have come to its end before the signal.
if [[ $status == 0 ]]; then
  [[ $done_before == 8 ]] || wrong "an interrupted run of $done_before episodes ended with 0"
else
  [[ $status == 130 && $done_before -ge 1 && $(cat "$out/interrupted.txt") == *--resume* ]] ||
    wrong "interrupted: exit $status, $done_before episodes, $(cat "$out/interrupted.txt")"
fi
run --out "$out/interrupted" --resume >/dev/null
same_as_whole interrupted

run --out "$out/whole" --replay CL-0.40-home-1-cmn CL-0.40-home-1-true_pose >"$out/replay.txt"
[[ $(grep -c '^the same as in episodes.csv$' "$out/replay.txt") == 2 ]] || wrong "$(cat "$out/replay.txt")"
for file in CL-0.40-home-1{,-cmn,-true_pose}.png CL-0.40-home-1-cmn.gif report.md run.yaml success_CL.svg; do
  [[ -s $out/whole/$file ]] || wrong "$file is absent"
done

# Moments taken apart: the parts that a method has, and those alone.
"$program" --world "$worlds/home.yaml" --out "$out/explained" --replay CL-0.40-home-1-ours CL-0.40-home-1-cmn \
  --explain 0,3,999 >"$out/explained.txt"
for part in look range_model likelihood_field one_look belief scales lattice repaired_map; do
  [[ -s $out/explained/CL-0.40-home-1-ours_action_3/$part.png ]] || wrong "$part.png is absent"
done
[[ -s $out/explained/CL-0.40-home-1-ours_action_0.png ]] || wrong "the sheet of action 0 is absent"
[[ -s $out/explained/CL-0.40-home-1-cmn_action_3/belief.png ]] || wrong "belief.png of cmn is absent"
[[ ! -e $out/explained/CL-0.40-home-1-cmn_action_3/scales.png ]] || wrong "cmn has no scales"
[[ $(grep -c 'ended before action 999$' "$out/explained.txt") == 2 ]] || wrong "$(cat "$out/explained.txt")"

"$program" --world house:3-4 --task CG,WL --method true_pose --episodes 1 --out "$out/houses" >/dev/null
[[ $(grep -cE '^(CG|WL),house:[34],' "$out/houses/episodes.csv") == 4 ]] || wrong "$(rows houses)"

# With heights: a furnished house seen by a camera, unless this is a build without the 3D simulator.
furnished() { "$program" --world furnished:7 --task CF --method depth_rolling --episodes 2 "$@"; }
if furnished --out "$out/furnished" >"$out/furnished.txt" 2>&1; then
  grep -qE '^CF,furnished:7,0.4,depth_rolling,1,' "$out/furnished/episodes.csv" || wrong "$(cat "$out/furnished.txt")"
  furnished --out "$out/furnished_two" --jobs 2 >/dev/null 2>&1
  diff <(rows furnished) <(rows furnished_two) >&2 || wrong "a furnished house on two threads has other rows"
  "$program" --world furnished:7 --out "$out/furnished" --replay CF-0.40-furnished:7-1-depth_rolling 2>/dev/null |
    grep -qx 'the same as in episodes.csv' || wrong "a furnished house comes out otherwise when replayed"
else
  grep -q 'left out of this build' "$out/furnished.txt" || wrong "$(cat "$out/furnished.txt")"
fi

# In colour: four looks a stop, if this build has a network to predict from them.
if "$program" --world furnished:1 --task CI --method true_pose --episodes 1 --out "$out/colour" >"$out/colour.txt" 2>&1; then
  grep -qE '^RESULT task=CI mpp=0.40 method=true_pose SR=1.000 .* episodes=1 pivots=[1-9]' "$out/colour.txt" ||
    wrong "$(cat "$out/colour.txt")"
else
  grep -qE 'left out of this build|this build has no networks' "$out/colour.txt" || wrong "$(cat "$out/colour.txt")"
fi

# Variants and a kidnapping, on two threads, and in parts by methods; what went worst.
ablate() { "$program" --world "$worlds/home.yaml" --task CL,CLK --episodes 2 "$@"; }
ablate --method true_pose,true_pose+no_map_repair --out "$out/ablated" --jobs 2 >"$out/ablated.txt"
[[ $(grep -cE '^RESULT task=CLK .* method=true_pose.* recovered=1\.000 median_actions=0$' "$out/ablated.txt") == 2 ]] ||
  wrong "$(cat "$out/ablated.txt")"
ablate --method true_pose --out "$out/whole_method" >/dev/null
ablate --method true_pose+no_map_repair --out "$out/variant" >/dev/null
"$program" merge "$out/whole_method" "$out/variant" --out "$out/both" | diff - "$out/ablated.txt" >&2 ||
  wrong "parts by methods have other results"
diff <(rows ablated) <(rows both) >&2 || wrong "parts by methods have other rows"
for part in "+no_map_repair | planning/map_repair/enabled: false" "One part off at a time" "| kidnapped |"; do
  grep -qF "$part" "$out/ablated/report.md" || wrong "\"$part\" is not in report.md"
done
"$program" --world "$worlds/home.yaml" --task CLK --method true_pose+no_map_repair --gallery 1 --out "$out/ablated" \
  >/dev/null
gallery=$out/ablated/gallery
[[ -s $gallery/true_pose+no_map_repair.png && $(grep -c '^| \[CLK' "$gallery/gallery.md") == 1 ]] ||
  wrong "$(cat "$gallery/gallery.md")"
grep -qE '^version: [0-9]+\.[0-9]+\.[0-9]+(, git [0-9a-z.-]+)?$' "$out/whole/run.yaml" ||
  wrong "$(cat "$out/whole/run.yaml")"

# A closet of 1.8 m has no way of 3 m: it is named, and the rest is played.
{
  printf 'P5\n40 40\n255\n'
  for row in $(seq 40); do
    if ((row <= 2 || row > 38)); then head -c 40 /dev/zero; else
      head -c 2 /dev/zero && head -c 36 /dev/zero | tr '\0' '\377' && head -c 2 /dev/zero
    fi
  done
} >"$out/closet.pgm"
{
  printf 'image: closet.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n'
  printf 'negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n'
} >"$out/closet.yaml"
closet() {
  "$program" --world "$out/closet.yaml" "$worlds/home.yaml" --method true_pose --episodes 2 --out "$out/closet" "$@"
}
closet >"$out/closet.txt"
grep -q 'episodes=2$' "$out/closet.txt" || wrong "$(cat "$out/closet.txt")"
grep -qx -- '- closet, CL, 0.40 m/cell: 0, 1' "$out/closet/report.md" || wrong "the closet is not named in report.md"
[[ $(grep -c '^CL,closet,.*,no route,' "$out/closet/episodes.csv") == 2 ]] || wrong "$(cat "$out/closet/episodes.csv")"
closet --resume | diff - "$out/closet.txt" >&2 || wrong "resumed with a closet: other results"

refused() {  # EXPECTED ARGUMENT...: exit code 1 and a sentence with EXPECTED in it
  local expected=$1 status=0 answer
  shift
  answer=$("$program" "$@" 2>&1) || status=$?
  [[ $status == 1 && $answer == *"$expected"* ]] || wrong "cmn_evaluate $*: exit $status, \"$answer\""
}
home=(--world "$worlds/home.yaml" --out "$out/refused")
refused "at least one --world" --out "$out/refused"
refused "house:4-3 are no houses" --world house:4-3 --out "$out/refused"
refused "furnished:x is no house" --world furnished:x --out "$out/refused"
if [[ -d $out/furnished_two ]]; then
  refused "house:7 has heights for depth_rolling and none for rolling in CF: furnished:7" --world house:7 --task CF \
    --method rolling,depth_rolling --out "$out/refused"
fi
refused "absent.urdf" "${home[@]}" --robot "$out/absent.urdf"
refused "house:x is no house" --world house:x --out "$out/refused"
refused "nowhere.yaml" --world "$out/nowhere.yaml" --out "$out/refused"
refused "another world is called home" "${home[@]}" --world "$worlds/home.yaml"
refused 'method "magic" is none of ours, rolling, depth_rolling, fused, rgb_rolling, cmn' "${home[@]}" --method magic
refused 'variant "none" of ours is none of all, no_belief_policy' "${home[@]}" --method ours+none
refused "ours+no_rolling_map changes nothing" "${home[@]}" --method ours,ours+no_rolling_map
refused "absent.yaml" "${home[@]}" --variants "$out/absent.yaml"
printf 'x: {planing: {policy: path}}\ny: {planning: {policy: none}}\n' >"$out/variants.yaml"
refused "ours+y:" "${home[@]}" --method ours+x,ours+y --variants "$out/variants.yaml"
refused "--gallery 0 is not 1 or more" "${home[@]}" --gallery 0
refused "absent/episodes.csv: cannot be read" --world "$worlds/home.yaml" --out "$out/absent" --gallery 3
refused "has no episode of rmn" --world "$worlds/home.yaml" --out "$out/whole" --method rmn --gallery 3
refused 'task "XX" is none of CG' "${home[@]}" --task XX
refused "--mpp fine is not" "${home[@]}" --mpp fine
refused "--mpp 0 is not" "${home[@]}" --mpp 0
refused "--mpp -0.4 is not" "${home[@]}" --mpp -0.4
refused "--mpp nan is not" "${home[@]}" --mpp nan
refused "--mpp 0.01 is finer than" "${home[@]}" --mpp 0.01,0.4
refused "no start and goal lie 3 m to 20 m apart" --world "$worlds/home.yaml" --out "$out/routeless" --episodes 1 \
  --mpp 20
refused "--mpp names nothing" "${home[@]}" --mpp ""
refused "--method names cmn twice" "${home[@]}" --method cmn,robb,cmn
refused "--episodes 0 is not 1 or more" "${home[@]}" --episodes 0
refused "'x'" "${home[@]}" --episodes x
refused "--jobs -2 is not 1 or more" "${home[@]}" --jobs -2
refused "--seed is not 0 or more" "${home[@]}" --seed -1
refused "/nowhere" "${home[@]}" --config /nowhere
refused "--shard is i/n" "${home[@]}" --shard 2/2
refused "--resume" --world "$worlds/home.yaml" --out "$out/whole"
refused "another --seed" --world "$worlds/home.yaml" --method cmn --episodes 3 --seed 2 --out "$out/whole" --resume
printf 'least_way_m: 1\n' >"$out/other_judge.yaml"
refused "--resume needs the options" --world "$worlds/home.yaml" --method cmn --episodes 3 --judge "$out/other_judge.yaml" \
  --out "$out/whole" --resume
refused "/proc/refused" --world "$worlds/home.yaml" --out /proc/refused
printf 'P5\n60 60\n255\n' >"$out/full.pgm"
head -c 3600 /dev/zero >>"$out/full.pgm"
printf 'image: full.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n' \
  >"$out/full.yaml"
refused "full.yaml: has no free cell" --world "$out/full.yaml" --out "$out/refused"
# A slit of 0.1 m.
{
  printf 'P5\n60 60\n255\n'
  head -c 1800 /dev/zero
  head -c 120 /dev/zero | tr '\0' '\377'
  head -c 1680 /dev/zero
} >"$out/slit.pgm"
sed 's/full/slit/' "$out/full.yaml" >"$out/slit.yaml"
refused "slit.yaml: the world has no free space for a robot of radius 0.18 m" \
  --world "$out/slit.yaml" --out "$out/refused"
touch "$out/file"
refused "$out/file" --world "$worlds/home.yaml" --out "$out/file"
drawing=(--map "$out/drawing.yaml" --map-to-world "$out/drawing_places.yaml")
"$1/devel/lib/coarse_map_nav/cmn_coarsen" "$worlds/home.yaml" --kind hand_drawn --out "$out/drawing.yaml" >/dev/null
"$program" --world "$worlds/home.yaml" --task HL "${drawing[@]}" --method true_pose --episodes 2 \
  --out "$out/given" >"$out/given.txt"
grep -q 'task=HL mpp=0.40 method=true_pose SR=1.000' "$out/given.txt" || wrong "$(cat "$out/given.txt")"
refused "without --mpp" "${home[@]}" "${drawing[@]}" --mpp 0.4
refused "a single --world" "${home[@]}" --world "$worlds/lab.yaml" "${drawing[@]}"
refused "at least 3 places" "${home[@]}" --map "$out/drawing.yaml"
sed 's/map: \[/map: [1/' "$out/drawing_places.yaml" >"$out/beside.yaml"
refused "with $out/beside.yaml: the " "${home[@]}" --map "$out/drawing.yaml" --map-to-world "$out/beside.yaml"
printf 'least_way_m: 0\nsimulation: {robot: {radius: 0.1}}\n' >"$out/judge.yaml"
refused "judge.yaml:" "${home[@]}" --judge "$out/judge.yaml"
refused "is not the name of an episode" "${home[@]}" --replay 17
refused "--explain goes with --replay" "${home[@]}" --explain 3
refused "--explain 3rd is not the number of an action" "${home[@]}" --replay CL-0.40-home-1-cmn --explain 3rd
refused "needs a --world that is called intel" "${home[@]}" --replay CL-0.40-intel-1-cmn
refused "absent/episodes.csv" merge "$out/shard0" "$out/absent" --out "$out/refused"
