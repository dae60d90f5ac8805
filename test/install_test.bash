#!/usr/bin/env bash
# Copyright (c) 2026, the coarse_map_nav authors
# SPDX-License-Identifier: BSD-3-Clause
# What is installed runs without the source and build trees: installs the build into a directory of its
# own, and starts the simulation from there until a belief comes out. usage: install_test.bash BUILD_DIR
set -euo pipefail
build=$1
# Outside of the source: roslaunch would find every launch file twice.
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
DESTDIR=$stage cmake --install "$build" >"$build/install_test.log"
prefix=$stage$(sed -n 's/^CMAKE_INSTALL_PREFIX:PATH=//p' "$build/CMakeCache.txt")

for program in "$prefix"/lib/coarse_map_nav/*; do
  if env -u LD_LIBRARY_PATH ldd "$program" | grep 'not found'; then
    echo "$program does not find its libraries" >&2
    exit 1
  fi
done

unset LD_LIBRARY_PATH
export CMAKE_PREFIX_PATH=$prefix ROS_PACKAGE_PATH=$prefix/share
PYTHONPATH=$(dirname "$(find "$prefix/lib" -type d -path '*-packages/coarse_map_nav')")
export PYTHONPATH
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
export ROS_MASTER_URI=http://127.0.0.1:$port
env --default-signal=INT roslaunch -p "$port" coarse_map_nav simulation.launch >>"$build/install_test.log" 2>&1 &
launch=$!
trap 'kill -INT $launch; wait $launch; rm -rf "$stage"' EXIT
# shellcheck disable=SC2016  # expanded by the inner shell
timeout 60 bash -c 'until rostopic list >/dev/null 2>&1; do kill -0 "$1" || exit 1; done' bash $launch
timeout 60 rostopic echo -n 1 /belief/confidence | grep -E '^[0-9]'
