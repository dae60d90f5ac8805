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
rows() { cut -d, -f1-24,26- "$out/$1/episodes.csv"; }
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

run --out "$out/whole" --replay CL-0.40-home-1-cmn CL-0.40-home-1-true_pose >"$out/replay.txt"
[[ $(grep -c '^the same as in episodes.csv$' "$out/replay.txt") == 2 ]] || wrong "$(cat "$out/replay.txt")"
for file in CL-0.40-home-1{,-cmn,-true_pose}.png CL-0.40-home-1-cmn.gif report.md run.yaml success_CL.svg; do
  [[ -s $out/whole/$file ]] || wrong "$file is absent"
done

"$program" --world house:3-4 --task CG,WL --method true_pose --episodes 1 --out "$out/houses" >/dev/null
[[ $(grep -cE '^(CG|WL),house:[34],' "$out/houses/episodes.csv") == 4 ]] || wrong "$(rows houses)"

refused() {  # EXPECTED ARGUMENT...: exit code 1 and a sentence with EXPECTED in it
  local expected=$1 status=0 answer
  shift
  answer=$("$program" "$@" 2>&1) || status=$?
  [[ $status == 1 && $answer == *"$expected"* ]] || wrong "cmn_evaluate $*: exit $status, \"$answer\""
}
home=(--world "$worlds/home.yaml" --out "$out/refused")
refused "at least one --world" --out "$out/refused"
refused "house:4-3 are no houses" --world house:4-3 --out "$out/refused"
refused "house:x is no house" --world house:x --out "$out/refused"
refused "nowhere.yaml" --world "$out/nowhere.yaml" --out "$out/refused"
refused "another world is called home" "${home[@]}" --world "$worlds/home.yaml"
refused 'method "magic" is none of ours, cmn' "${home[@]}" --method magic
refused 'task "XX" is none of CG' "${home[@]}" --task XX
refused "--mpp fine is not" "${home[@]}" --mpp fine
refused "--shard is i/n" "${home[@]}" --shard 2/2
refused "--resume" --world "$worlds/home.yaml" --out "$out/whole"
refused "another --seed" --world "$worlds/home.yaml" --method cmn --episodes 3 --seed 2 --out "$out/whole" --resume
refused "/proc/refused" --world "$worlds/home.yaml" --out /proc/refused
refused "is not the name of an episode" "${home[@]}" --replay 17
refused "needs a --world that is called intel" "${home[@]}" --replay CL-0.40-intel-1-cmn
refused "absent/episodes.csv" merge "$out/shard0" "$out/absent" --out "$out/refused"
