#!/usr/bin/env python3
# Copyright (c) 2026, the coarse_map_nav authors
# SPDX-License-Identifier: BSD-3-Clause
"""Starts rviz on a running simulation and looks for everything it must show in the picture.

usage: screenshot_test.py SCRIPT PICTURE: scripts/screenshot and where the picture is left.
Ends with 77 (skipped) where rviz, Xvfb or ImageMagick is absent.
"""

import collections
import colorsys
import os
import shutil
import subprocess
import sys

WIDTH, HEIGHT = 960, 540
SKIPPED = 77


def is_near(color, wanted, tolerance=14):
    return all(abs(a - b) <= tolerance for a, b in zip(color, wanted))


def is_of_hue(color, low_deg, high_deg):
    hue, saturation, value = colorsys.rgb_to_hsv(*(c / 255 for c in color))
    return low_deg <= 360 * hue <= high_deg and saturation > 0.7 and value > 0.3


def is_heat(color):
    """rviz's costmap colours, from blue (0, 0, 255) to red (255, 0, 0), where nothing shines through."""
    red, green, blue = color
    return green < 12 and abs(red + blue - 255) < 12


# What must be seen, where, and of how many pixels at the least. The map takes the left part of the
# picture, the layers of the belief with their labels the right.
MAP, LAYERS = "left", "right"
WANTED = (
    ("the map's walls", MAP, 30000, lambda c: is_near(c, (48, 48, 48))),
    ("the map's floor", MAP, 30000, lambda c: is_near(c, (252, 252, 252), 3)),
    ("the marginal of the belief", MAP, 300,
     lambda c: is_of_hue(c, 236, 360) or (c[2] > 200 and c[0] < 180 and c[1] < 150)),
    ("the laser scan", MAP, 60, lambda c: is_near(c, (0, 150, 170), 2)),
    ("the hypotheses", MAP, 60, lambda c: is_of_hue(c, 38, 46)),
    ("the goal or the path to it", MAP, 60, lambda c: is_of_hue(c, 140, 156)),
    ("the layers' walls", LAYERS, 8000, lambda c: is_near(c, (112, 137, 134), 6)),
    ("the layers' heat", LAYERS, 60, is_heat),
    ("the layers' labels", LAYERS, 300, lambda c: is_near(c, (50, 50, 50), 25)),
)


def colors_of(picture):
    """How often each colour occurs, left and right of 75 % of the picture's width."""
    raw = subprocess.run(["convert", picture, "-depth", "8", "rgb:-"], check=True,
                         stdout=subprocess.PIPE).stdout
    if len(raw) != 3 * WIDTH * HEIGHT:
        sys.exit(f"the picture is not {WIDTH} x {HEIGHT}: {len(raw)} bytes")
    split = 75 * WIDTH // 100
    counts = {MAP: collections.Counter(), LAYERS: collections.Counter()}
    for row in range(HEIGHT):
        pixels = list(zip(*[iter(raw[3 * WIDTH * row:3 * WIDTH * (row + 1)])] * 3))
        counts[MAP].update(pixels[:split])
        counts[LAYERS].update(pixels[split:])
    return counts


def main():
    script, picture = sys.argv[1:]
    absent = [name for name in ("rviz", "Xvfb", "import", "convert") if not shutil.which(name)]
    if absent:
        print("skipped: there is no " + ", no ".join(absent))
        return SKIPPED
    if os.path.exists(picture):
        os.remove(picture)
    subprocess.run(["timeout", "150", script, "--no-build", "--speed", "4", "--actions", "10",
                    "--size", f"{WIDTH}x{HEIGHT}", "--out", picture], check=True)
    counts = colors_of(picture)
    distinct = len(set(counts[MAP]) | set(counts[LAYERS]))
    print(f"{picture}: {distinct} colours")
    failed = distinct < 500
    for what, where, least, is_it in WANTED:
        found = sum(n for color, n in counts[where].items() if is_it(color))
        failed |= found < least
        print(f"{'ok  ' if found >= least else 'FAIL'}  {what}: {found} pixels, at least {least}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
