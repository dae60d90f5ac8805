#!/usr/bin/env python3
# Copyright (c) 2026, the coarse_map_nav authors
# SPDX-License-Identifier: BSD-3-Clause
"""Networks from Python as files of TorchScript, right ones and wrong ones. usage: python_models.py DIR

Exits with 77 where torch is absent.
"""

import sys

try:
    import torch
except ImportError:
    sys.exit(77)


class RedToTheLeft(torch.nn.Module):
    """Occupied to the robot's left as far as the front view is red."""

    def __init__(self):
        super().__init__()
        self.gain = torch.nn.Parameter(torch.ones(1))

    def forward(self, panorama):
        red = panorama[:, 0, 0].mean(dim=[1, 2]) * self.gain
        near = torch.zeros([1, 1, 128, 128])
        near[:, :, 64:] = red.view(1, 1, 1, 1)
        return near


class Pair(RedToTheLeft):
    def forward(self, panorama):
        return torch.full([1, 2, 128, 128], 0.5), torch.full([1, 2, 64, 64], 0.5)


class Triple(RedToTheLeft):
    def forward(self, panorama):
        near = torch.full([1, 2, 128, 128], 0.5)
        return near, near, near


class TwoInputs(RedToTheLeft):
    def forward(self, panorama, goal):
        return panorama + goal


class Small(RedToTheLeft):
    def forward(self, panorama):
        return torch.zeros([1, 1, 64, 64])


class Logits(RedToTheLeft):
    def forward(self, panorama):
        return torch.full([1, 2, 128, 128], -3.0)


class Text(RedToTheLeft):
    def forward(self, panorama):
        return "occupied"


class OtherInput(RedToTheLeft):
    def forward(self, panorama):
        return panorama.view(1, 3, 240, 320)


def main():
    folder = sys.argv[1]
    net = RedToTheLeft().eval()
    torch.jit.script(net).save(f"{folder}/scripted.pt")
    torch.jit.trace(net, torch.rand(1, 4, 3, 80, 80)).save(f"{folder}/traced.pt")
    torch.jit.script(RedToTheLeft().half()).save(f"{folder}/scripted_half.pt")
    for name, wrong in [("pair", Pair()), ("triple", Triple()), ("two_inputs", TwoInputs()),
                        ("small", Small()), ("logits", Logits()), ("text", Text()),
                        ("other_input", OtherInput())]:
        torch.jit.script(wrong).save(f"{folder}/{name}.pt")


if __name__ == "__main__":
    main()
