# Copyright (c) 2026, the coarse_map_nav authors
# SPDX-License-Identifier: BSD-3-Clause
# Where things lie and how they are run; sourced by the scripts beside it, never executed.
# shellcheck shell=bash

CMN_ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
CMN_BUILD=$CMN_ROOT/build

# catkin's modules belong to the system's python: another one (pyenv, conda) first on PATH breaks
# both the configuring and every `#!/usr/bin/env python3` of ROS.
export PATH=/usr/bin:$PATH

# Prints a sentence for the user and ends the script: fail STATUS SENTENCE...
fail() {
  local status=$1
  shift
  printf '%s\n' "$@" >&2
  exit "$status"
}

# Runs a command, its output to a log file, with one progress line on a terminal. When the command
# fails, shows the end of the log and ends the script: quietly LOG WHAT COMMAND...
quietly() {
  local log=$1 what=$2 line status=0 start=$SECONDS
  shift 2
  mkdir -p "$(dirname "$log")"
  if [[ -t 2 ]]; then
    local width
    width=$(($(tput cols 2>/dev/null || echo 80) - ${#what} - 3))
    "$@" 2>&1 | tee "$log" | while IFS= read -r line; do
      printf '\r\033[K%s  %s' "$what" "${line:0:width}" >&2
    done
    status=${PIPESTATUS[0]}
    printf '\r\033[K' >&2
  else
    "$@" >"$log" 2>&1 || status=$?
  fi
  if ((status != 0)); then
    tail -n 30 "$log" >&2
    fail 1 "" "$what failed (exit $status); the whole log: $log"
  fi
  if ((SECONDS - start >= 3)); then
    printf '%s: %d s\n' "$what" $((SECONDS - start)) >&2
  fi
}

# Brings the built package into the environment, as if in a catkin workspace.
use_workspace() {
  set +u
  # shellcheck source=/dev/null
  source "$CMN_BUILD/devel/setup.bash"
  set -u
  export ROS_HOME=${ROS_HOME:-$CMN_BUILD/ros_home}
  export ROSCONSOLE_STDOUT_LINE_BUFFERED=1
  # A host that cannot look up its own name cannot talk to its own ROS master by that name.
  if [[ -z ${ROS_IP:-}${ROS_HOSTNAME:-} ]] && ! getent hosts "$(uname -n)" >/dev/null; then
    export ROS_IP=127.0.0.1
  fi
}
