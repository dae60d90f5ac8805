#!/usr/bin/env python3
# Copyright (c) 2026, the coarse_map_nav authors
# SPDX-License-Identifier: BSD-3-Clause
"""The filter of Coarse Map Navigator, sec. IV-C, straight from its equations.

Does again what cg_record wrote down, on the grids that the authors released, and compares the beliefs
of all steps. usage: cg_reference.py CG_RECORD DATA_DIR; $CMN_DATA_DIR comes before DATA_DIR.
Exit code 77: numpy or the grids are absent.
"""
import os
import subprocess
import sys

try:
    import numpy as np
except ImportError:
    print("numpy is absent (Debian: python3-numpy): the reference is left out")
    sys.exit(77)

STEPS = 200
SEEDS = range(1, 6)
TOLERANCE = 1e-6
DIRECTIONS = [(1, 0), (0, 1), (-1, 0), (0, -1)]  # east, north, west, south


def read_grid(path):
    """occupied[y, x], y up. The released arrays have their top row first; 1 is occupied."""
    return np.load(path)[::-1].astype(bool)


def predict(belief, occupied, heading, p):
    """Eq. 1: with p to the next cell, with 1 - p no step. What faces a wall stays."""
    height, width = belief.shape
    dx, dy = DIRECTIONS[heading]
    moved = np.zeros_like(belief)
    for y in range(height):
        for x in range(width):
            ahead_x, ahead_y = x + dx, y + dy
            inside = 0 <= ahead_x < width and 0 <= ahead_y < height
            if inside and not occupied[ahead_y, ahead_x]:
                moved[ahead_y, ahead_x] += p * belief[y, x]
                moved[y, x] += (1 - p) * belief[y, x]
            else:
                moved[y, x] += belief[y, x]
    return moved


def observed_at(occupied, x, y, heading):
    """The 3 x 3 window of the map about (x, y) as a robot of that heading sees it: [left, forward]."""
    height, width = occupied.shape
    forward = DIRECTIONS[heading]
    left = DIRECTIONS[(heading + 1) % 4]
    window = np.ones((3, 3))
    for to_left in (-1, 0, 1):
        for ahead in (-1, 0, 1):
            cell_x = x + ahead * forward[0] + to_left * left[0]
            cell_y = y + ahead * forward[1] + to_left * left[1]
            if 0 <= cell_x < width and 0 <= cell_y < height:
                window[to_left + 1, ahead + 1] = occupied[cell_y, cell_x]
    return window


def correct(belief, occupied, heading, seen):
    """Eq. 2 and 3; the likelihood is squared, as in the authors' released parameters."""
    height, width = belief.shape
    corrected = np.zeros_like(belief)
    for y in range(height):
        for x in range(width):
            if not occupied[y, x]:
                error = np.abs(seen - observed_at(occupied, x, y, heading)).sum() / 9
                corrected[y, x] = (1 - error) ** 2 * belief[y, x]
    return corrected / corrected.sum()


def compare(program, path, seed):
    """The greatest difference between the beliefs of the program and of this file."""
    command = [program, path, str(seed), str(STEPS)]
    lines = subprocess.run(command, check=True, stdout=subprocess.PIPE, universal_newlines=True)
    lines = lines.stdout.splitlines()
    occupied = read_grid(path)
    width, height, heading = map(int, lines[0].split())
    if occupied.shape != (height, width) or len(lines) != STEPS + 2:
        sys.exit("%s: %d x %d cells and %d looks, not as expected"
                 % (path, width, height, len(lines) - 1))
    belief = (~occupied).astype(float)
    belief /= belief.sum()
    worst = 0.0
    for line in lines[1:]:
        action, *numbers = line.split()
        numbers = np.array(numbers, dtype=float)
        p, seen, theirs = numbers[0], numbers[1:10].reshape(3, 3), numbers[10:]
        if action == "forward":
            belief = predict(belief, occupied, heading, p)
        elif action != "none":
            heading = (heading + {"left": 1, "right": -1}[action]) % 4
        belief = correct(belief, occupied, heading, seen)
        worst = max(worst, np.abs(belief - theirs.reshape(belief.shape)).max())
    return worst


def main():
    program, data = sys.argv[1:]
    data = os.environ.get("CMN_DATA_DIR", data)
    grids = [os.path.join(data, "gibson", "Eudora_map_binary_arr_mpp_%s.npy" % mpp)
             for mpp in ("03", "04", "05")]
    for grid in grids:
        if not os.path.exists(grid):
            print(grid + " is absent; set CMN_DATA_DIR to the folder that has it")
            sys.exit(77)
    failed = False
    for grid in grids:
        worst = max(compare(program, grid, seed) for seed in SEEDS)
        failed |= not worst <= TOLERANCE
        print("%s: beliefs of %d x %d steps differ by at most %.1e"
              % (os.path.basename(grid), len(SEEDS), STEPS, worst))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
